#include "geometry/shapes/solids.hpp"

#include <cmath>
#include <numbers>

#include "geometry/shapes/checks.hpp"
#include "geometry/shapes/cube_to_ball.hpp"
#include "geometry/shapes/kuhn.hpp"

namespace tack {

Mesh box_tets(const Vec3& size, const std::array<int, 3>& cells) {
  for (double length : size) require_positive("box", "size", length);
  Mesh mesh = kuhn_cube("box", cells, {false, false, false});
  std::size_t v = 0;
  for (int k = 0; k <= cells[2]; ++k) {
    for (int j = 0; j <= cells[1]; ++j) {
      for (int i = 0; i <= cells[0]; ++i) {
        // Computed from the node indices with the fewest roundings, so that faces are exactly at
        // size/2.
        const Vec3 at(double(i) / cells[0], double(j) / cells[1], double(k) / cells[2]);
        mesh.vertices[v++] = -0.5 * size + size.cwiseProduct(at);
      }
    }
  }
  return mesh;
}

Mesh sphere(double radius, int cells) {
  require_positive("sphere", "radius", radius);
  Mesh mesh = kuhn_cube("sphere", {cells, cells, cells}, {true, true, true});
  for (Vec3& x : mesh.vertices) x = radius * cube_to_ball<3>(x);
  return mesh;
}

Mesh cylinder(double radius, double height, int cells_across, int cells_along) {
  require_positive("cylinder", "radius", radius);
  require_positive("cylinder", "height", height);
  Mesh mesh = kuhn_cube("cylinder", {cells_across, cells_along, cells_across}, {true, false, true});
  for (Vec3& x : mesh.vertices) {
    const Vec2 disc = radius * cube_to_ball<2>(Vec2(x.x(), x.z()));
    x = Vec3(disc.x(), 0.5 * height * x.y(), disc.y());
  }
  return mesh;
}

Mesh voussoir(const Voussoir& stone, const std::array<int, 3>& cells) {
  require_positive("voussoir", "inner_radius", stone.inner_radius);
  require_positive("voussoir", "outer_radius - inner_radius", stone.outer_radius - stone.inner_radius);
  require_positive("voussoir", "angle", stone.angle);
  require_positive("voussoir", "pi - angle", std::numbers::pi - stone.angle);
  require_positive("voussoir", "depth", stone.depth);
  const double sine = std::sin(stone.angle / 2), cosine = std::cos(stone.angle / 2);
  require_positive("voussoir", "its width beside the joints",
                   2 * stone.inner_radius * sine - stone.joint * cosine);
  Mesh mesh = kuhn_cube("voussoir", cells, {false, false, false});
  for (Vec3& x : mesh.vertices) {
    const double out = (1 + x.y()) / 2;
    const double radius = (1 - out) * stone.inner_radius + out * stone.outer_radius;
    x = Vec3(x.x() * (radius * sine - stone.joint / 2 * cosine),
             radius * cosine + stone.joint / 2 * sine, x.z() * stone.depth / 2);
  }
  return mesh;
}

}  // namespace tack
