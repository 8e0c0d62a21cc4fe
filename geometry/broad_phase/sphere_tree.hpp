// Bounding-sphere tree of a surface, to test whether rigid placements of meshes are farther from
// each other than a distance. Exact: it compares points, edges and triangles, not samples. Lengths
// in metres.
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

  // Returns whether the surfaces of a and b, placed by at_a and at_b, are nowhere closer than
  // `distance` > 0. A surface that lies inside the other without touching it counts by its
  // distance.
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
    // a leaf's primitives; else count is 0, and first the first of two children.
    int first = 0, count = 0;
  };
  void divide(int node, int begin, int end);
  static bool primitives_farther_than(const Primitive& a, const Primitive& b, double distance);

  std::vector<Primitive> primitives_;
  std::vector<Node> nodes_;
};

}  // namespace tack
