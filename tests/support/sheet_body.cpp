#include "tests/support/sheet_body.hpp"

namespace tack {

SheetBody::SheetBody(const Vec2& size, const std::array<int, 2>& cells, double thickness, double jitter, Diagonals diagonals)
    : volume(size.prod() * thickness) {
  const Mesh mesh = grid(size, cells, diagonals, jitter);
  body.name = "sheet";
  body.vertex_count = static_cast<int>(mesh.vertices.size());
  body.triangles = body.sheet = mesh.triangles;
  body.thickness = thickness;
  rest.resize(3 * body.vertex_count);
  for (int v = 0; v < body.vertex_count; ++v) vertex(rest, v) = mesh.vertices[v];
}

VecX SheetBody::mapped(const std::function<Vec3(const Vec3&)>& map) const {
  VecX x(rest.size());
  for (int v = 0; v < body.vertex_count; ++v) vertex(x, v) = map(vertex(rest, v));
  return x;
}

}  // namespace tack
