// Whether copies of meshes, turned and moved, keep a distance from each other. Exact: points, edges and triangles of the
// surfaces themselves, not samples. Lengths in metres.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Balls around the parts of a surface, one in another: they turn with it.
class SphereTree {
 public:
  explicit SphereTree(const Mesh& mesh);

  // Around all of it.
  const Vec3& centre() const { return nodes_.front().centre; }
  double radius() const { return nodes_.front().radius; }

  // Whether the surfaces of two, each in its place, are nowhere closer than `distance` > 0. One inside of the other, and
  // touching nowhere, is apart.
  friend bool apart(const SphereTree& a, const Eigen::Isometry3d& at_a, const SphereTree& b, const Eigen::Isometry3d& at_b, double distance);

 private:
  // A point, an edge or a triangle: the first `corners` of its vertices.
  struct Part {
    std::array<Vec3, 3> at;
    int corners = 0;
  };
  struct Node {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
    int first = 0, count = 0;  // parts, of a leaf; else count is 0 and first the first of two children
  };
  void divide(int node, int begin, int end);
  static bool parts_apart(const Part& a, const Part& b, double distance);

  std::vector<Part> parts_;
  std::vector<Node> nodes_;
};

}  // namespace tack
