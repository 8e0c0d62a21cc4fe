// Embedding of points in an object at rest: attached vertices and attachment points of interactions
// follow a host element of the object.
#pragma once

#include <utility>
#include <vector>

#include "framework/world/world.hpp"

namespace tack {

class Embedding {
 public:
  // Distance over size() below which a point touches the object.
  static constexpr double touching = 1e-9;

  Embedding(const World& world, int body);
  double size() const { return size_; }  // diagonal of the bounding box of the object [m]

  struct Attachment {
    // Vertices and weights; empty without tets and triangles.
    std::vector<std::pair<int, double>> on;
    double distance = 0;  // from the point to the object [m]
    double error = 0;     // from the point to the weighted sum of `on` [m]
  };
  // Returns the host element of a point: the frame of an affine body; the tet that contains the
  // point or has the closest face; the triangle that it lies on, of an object without tets.
  Attachment of(const Vec3& point) const;

 private:
  Vec3 at(int v) const { return vertex(world_.rest, v); }
  std::vector<std::pair<int, double>> on_tets(const Vec3& point, const Triangle* closest) const;
  std::vector<std::pair<int, double>> on_triangle(const Triangle& t, const Vec3& point) const;

  const World& world_;
  const Body& body_;
  double size_;
};

}  // namespace tack
