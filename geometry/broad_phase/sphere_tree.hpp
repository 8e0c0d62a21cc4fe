// Sphere tree of a surface: tests whether rigid placements of meshes are farther from each other
// than a distance. The test is exact: it compares points, edges and triangles. Lengths in metres.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Spheres are in the frame of the mesh, so that the tree serves every rigid placement.
class SphereTree {
 public:
  explicit SphereTree(const Mesh& mesh);

  // The root sphere.
  const Vec3& centre() const { return nodes_.front().centre; }
  double radius() const { return nodes_.front().radius; }

  // Returns whether the surfaces of a and b, placed by at_a and at_b, are farther apart than
  // `distance` > 0. For a surface inside the other, the distance of the surfaces counts.
  friend bool farther_than(const SphereTree& a, const Eigen::Isometry3d& at_a, const SphereTree& b,
                           const Eigen::Isometry3d& at_b, double distance);

 private:
  // A point, an edge or a triangle: the first `corners` of its vertices.
  struct Primitive {
    std::array<Vec3, 3> at;
    int corners = 0;
  };
  struct Node {
    Vec3 centre = Vec3::Zero();
    double radius = 0;
    // Primitives of a leaf; of an inner node count is 0, and first is the first of two children.
    int first = 0, count = 0;
  };
  void divide(int node, int begin, int end);
  static bool primitives_farther_than(const Primitive& a, const Primitive& b, double distance);

  std::vector<Primitive> primitives_;
  std::vector<Node> nodes_;
};

}  // namespace tack
