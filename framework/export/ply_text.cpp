#include "framework/export/ply_text.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>

namespace tack {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class Number>
void add(fmt::memory_buffer& content, Number number) {
  const char* bytes = reinterpret_cast<const char*>(&number);
  content.append(bytes, bytes + sizeof(Number));
}

}  // namespace

void append_ply(fmt::memory_buffer& content, const ExportedObject& object, const std::vector<Vec3>& x, double scale) {
  const bool wide = std::any_of(object.face_sizes.begin(), object.face_sizes.end(), [](int size) { return 2 * size > 255; });
  const char* count = wide ? "int" : "uchar";
  const auto add_count = [&](int size) {
    if (wide) add(content, static_cast<std::int32_t>(size));
    else add(content, static_cast<std::uint8_t>(size));
  };
  auto out = std::back_inserter(content);
  fmt::format_to(out, "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n", x.size());
  if (object.has_faces()) fmt::format_to(out, "element face {}\nproperty list {} int vertex_indices\n", object.face_sizes.size(), count);
  if (!object.corner_uvs.empty()) fmt::format_to(out, "property list {} float texcoord\n", count);
  if (!object.edges.empty()) fmt::format_to(out, "element edge {}\nproperty int vertex1\nproperty int vertex2\n", object.edges.size());
  fmt::format_to(out, "end_header\n");
  for (const Vec3& p : x)
    for (const double c : p) add(content, scale * c);
  size_t first = 0;
  for (const int size : object.face_sizes) {
    add_count(size);
    for (int c = 0; c < size; ++c) add(content, static_cast<std::int32_t>(object.corners[first + c]));
    if (!object.corner_uvs.empty()) {
      add_count(2 * size);
      for (int c = 0; c < size; ++c)
        for (const double t : object.uvs[object.corner_uvs[first + c]]) add(content, static_cast<float>(t));
    }
    first += size;
  }
  for (const Edge& e : object.edges)
    for (const int v : e) add(content, static_cast<std::int32_t>(v));
}

}  // namespace tack
