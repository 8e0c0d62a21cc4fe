#include "tests/support/tet_body.hpp"

#include <Eigen/Geometry>

#include "geometry/mesh/surface.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/tets/divide_tets.hpp"

namespace tack {

TetBody::TetBody(const Vec3& size, const std::array<int, 3>& cells, Elements elements) : volume(size.prod()) {
  const Mesh box = box_tets(size, cells), mesh = elements == Elements::composite ? divide_tets(box) : box;
  body.elements = elements;
  body.name = "box";
  body.vertex_count = static_cast<int>(mesh.vertices.size());
  body.tets = mesh.tets;
  body.triangles = extract_surface(mesh).triangles;
  rest.resize(3 * body.vertex_count);
  for (int v = 0; v < body.vertex_count; ++v) vertex(rest, v) = mesh.vertices[v];
}

VecX TetBody::deformed(const Mat3& f) const {
  VecX x(rest.size());
  for (int v = 0; v < body.vertex_count; ++v) vertex(x, v) = f * vertex(rest, v);
  return x;
}

double RandomMotions::uniform(double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(generator_);
}

Vec3 RandomMotions::vector() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }

VecX RandomMotions::vectors(Eigen::Index size) {
  return VecX::NullaryExpr(size, [this] { return uniform(-1, 1); });
}

Mat3 RandomMotions::rotation() {
  return Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(0.1, 1))
      .normalized()
      .toRotationMatrix();
}

}  // namespace tack
