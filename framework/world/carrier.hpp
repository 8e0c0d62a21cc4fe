// An object at rest as what carries points that follow it: attached vertices, the anchors of interactions.
#pragma once

#include <utility>
#include <vector>

#include "framework/world/world.hpp"

namespace tack {

class Carrier {
 public:
  static constexpr double touching = 1e-9;  // of the size

  Carrier(const World& world, int body);
  double size() const { return size_; }  // the diagonal of its box [m]

  struct Place {
    std::vector<std::pair<int, double>> on;  // vertices and weights; empty: it has neither tets nor triangles
    double distance = 0;  // of the point from the object [m]
    double off = 0;       // from where `on` puts it [m]
  };
  // A point follows the frame of an affine body; the tet that it is in, or that has the closest face; or the triangle that it lies on, of an
  // object without tets.
  Place of(const Vec3& point) const;

 private:
  Vec3 at(int v) const { return vertex(world_.rest, v); }
  std::vector<std::pair<int, double>> on_tets(const Vec3& point, const Triangle* closest) const;
  std::vector<std::pair<int, double>> on_triangle(const Triangle& t, const Vec3& point) const;

  const World& world_;
  const Body& body_;
  double size_;
};

}  // namespace tack
