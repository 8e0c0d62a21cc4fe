#include "framework/export/obj_text.hpp"

#include <iterator>

namespace tack {
namespace {

template <class... Arguments>
void add(fmt::memory_buffer& text, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Arguments>(arguments)...);
}

void append_faces(fmt::memory_buffer& text, const ExportedObject& object) {
  size_t corner = 0;
  int material = -1;
  for (size_t f = 0; f < object.face_sizes.size(); ++f) {
    if (object.face_material[f] != material) add(text, "usemtl {}\n", object.materials[material = object.face_material[f]].name);
    add(text, "f");
    for (int c = 0; c < object.face_sizes[f]; ++c, ++corner) {
      if (object.corner_uvs.empty()) add(text, " {}", object.corners[corner] + 1);
      else add(text, " {}/{}", object.corners[corner] + 1, object.corner_uvs[corner] + 1);
    }
    add(text, "\n");
  }
}

}  // namespace

void append_obj(fmt::memory_buffer& text, const ExportedObject& object, const std::vector<Vec3>& x, double scale, const std::string& library) {
  if (object.has_faces()) add(text, "mtllib {}\n", library);
  add(text, "o {}\n", object.file_name);
  for (const Vec3& p : x) add(text, "v {:.9g} {:.9g} {:.9g}\n", scale * p[0], scale * p[1], scale * p[2]);
  for (const Vec2& uv : object.uvs) add(text, "vt {:.9g} {:.9g}\n", uv[0], uv[1]);
  append_faces(text, object);
  for (const Edge& e : object.edges) add(text, "l {} {}\n", e[0] + 1, e[1] + 1);
  for (const int v : object.points) add(text, "p {}\n", v + 1);
}

std::string mtl_text(const ExportedObject& object) {
  fmt::memory_buffer text;
  for (const ExportedMaterial& m : object.materials) add(text, "newmtl {}\nKd {:.6g} {:.6g} {:.6g}\n", m.name, m.colour[0], m.colour[1], m.colour[2]);
  return fmt::to_string(text);
}

}  // namespace tack
