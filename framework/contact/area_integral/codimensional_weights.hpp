// Weights of a vertex of a rod, or of a particle, towards each triangle of another surface:
// fractions of its tributary area, lagged from the start of the step. They are continuous in all
// positions: the law acts with the weighted sum of point_features.hpp, so that nothing jumps when
// another triangle becomes the nearest one or is no longer visible. Between steps they are relaxed
// (weight_relaxation.hpp).
//
// A triangle j with the point in front of it is a seed triangle, of the strength
//     L_j = A(n_j) / A  g(o_j)  f(c_j):
//   A       tributary area, A(n_j) towards the normal of j (lagged_surface.hpp);
//   g(o_j)  of the overshoot past a crease or boundary: falls from 1 at 0 to 0 at half a width;
//   f(c_j)  of c_j = height / distance: rises from 0 at 0 to 1 at 0.5; on the point's own object
//           from 0 at 0.15 to 1 at 0.65: neighbours on a slightly hollow surface are not opposite.
// A triangle i has the weight
//     s_i = max_j k_ij L_j psi(e_ij / min_j e_ij),   e_ij = d_j / (k_ij f(c_j) z(d_j)),
// over its seeds j: the nearest one, and those that are hardly farther:
//   d_j     distance of j;
//   psi     falls from 1 at 1 to 0 at 1.3;
//   z       falls to 0 at the end of the range;
//   k_ij    membership of i in the patch of seed j: the largest value, over all paths along edges
//           from j by triangles within range, of the least k on the path; k falls with the angle
//           between the normals from 1 at 30 degrees to 0 at 70.
// Triangles beyond the range at the start of the step take the seeds whose normals are close to
// theirs, and are their own seeds if there is none.
#pragma once

#include <span>
#include <vector>

#include "framework/contact/surface/lagged_surface.hpp"

namespace tack {

// Weight of a point towards a triangle.
struct TriangleWeight {
  double weight;  // s_i: fraction of the tributary area of the point
  Vec3 normal, centre;
  bool two_sided;
  double distance;  // from the point [m]
};

// Returns the degree, 0 to 1, to which two adjacent triangles are one patch. The faces of a hollow
// are two patches, as a point in it is in front of each by itself.
double patch_affinity(const TriangleWeight& a, const TriangleWeight& b);

class CodimensionalWeights {
 public:
  CodimensionalWeights(const CollisionMesh& mesh, const LaggedSurface& lagged)
      : mesh_(mesh), lagged_(lagged) {}

  // Returns the weights of a vertex towards triangles of one object. range: of the law [m].
  std::vector<TriangleWeight>& find(int vertex_index, std::span<const int> triangles, double range);

 private:
  struct Seed {
    // L_j, d_j [m], z, d_j / (f z) [m]: infinite for a triangle that is no seed.
    double strength, distance, fade, scaled_distance;
  };
  // Closest feature of a triangle: one of three vertices, three edges, or the face.
  struct Foot {
    int triangle, feature;
    double distance, lateral;  // m; lateral: component of the distance in the triangle's plane
  };
  // Triangle at a corner: the largest sharpness of an edge on the path from the first triangle.
  struct FanTriangle {
    int triangle;
    Vec3 normal;
    double sharpness;
  };
  struct FanEdge {
    int from, to;
    double sharpness;
  };
  Seed seed_of(int vertex_index, int triangle, double range);
  Foot foot(const Vec3& p, int triangle) const;
  std::pair<Foot, double> descend(const Vec3& p, const Foot& from);
  double overshoot(const Vec3& p, Foot at);
  double overshoot_at_corner(const Vec3& p, const Foot& at);
  void find_fan(int triangle, int corner);
  int neighbour_across(int triangle, int side) const;
  Vec3 normal_along(int triangle, const Vec3& normal) const;
  double sharpness(int triangle, int side, const Vec3& normal, const Vec3& neighbour_normal) const;
  void find_neighbours(std::span<const int> triangles, double range);
  void grow_patch(int seed, double range, double* membership);

  const CollisionMesh& mesh_;
  const LaggedSurface& lagged_;
  double half_width_ = 0;  // m
  std::vector<FanTriangle> fan_;
  std::vector<FanEdge> fan_edges_;
  std::vector<Seed> seeds_;
  std::vector<int> seed_order_;
  std::vector<std::array<int, 3>> uses_;        // edge (two vertices), index of the triangle
  std::vector<std::array<int, 2>> neighbours_;  // indices of triangles, sorted by the first
  std::vector<int> neighbour_start_;
  std::vector<std::pair<double, int>> open_;
  std::vector<double> memberships_;  // k_ij of all triangles i, seed by seed
  std::vector<double> nearest_;      // min_j e_ij [m]
  std::vector<TriangleWeight> weights_;
};

}  // namespace tack
