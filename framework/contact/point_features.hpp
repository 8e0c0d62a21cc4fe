// Features of a point p over a triangulated surface, so that the surface counts once. For a law phi
// that vanishes at its range,
//     sum_T phi(d_T) - sum_E (n_E - 1) phi(d_E) + sum_V c_V phi(d_V),
// over the triangles T, edges E (n_E triangles each) and vertices V, with
//     c_V = 1 - n_T(V) + sum_{E at V} (n_E - 1),
// is phi(d(p, surface)) where the surface within range is one piece, and the sum over the pieces
// otherwise: by the coefficients, every point of the surface counts once (Euler characteristic),
// whatever the mesh. The sum is as smooth as phi(d_T). Each d reduces to the closest feature (face,
// edge or vertex). Equal features are merged, so that on flat and convex surfaces one feature of
// multiplicity 1 remains.
//
// With weights s_T of the point, and affinities k_TU of triangles that meet in E or V
// (codimensional_weights.hpp), the sum is
//     sum_T s_T phi(d_T) - sum_E j_E phi(d_E) + sum_V (sum_{E at V} j_E - j_V) phi(d_V),
// where j is the weight of the maximum spanning tree over the triangles at E or V, whose edges
// weigh min(s_T, s_U) k_TU. If all s and k are 0 or 1, it is the sum above over the triangles with
// s_T = 1. It is continuous in all s and k.
// Source: inclusion-exclusion of Li et al. 2023, Convergent Incremental Potential Contact.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "framework/contact/area_integral/codimensional_weights.hpp"
#include "geometry/types.hpp"

namespace tack {

struct PointFeature {
  std::array<int, 3> vertices;  // ascending; of an edge the third is -1, of a vertex the second too
  double multiplicity;

  int count() const { return 1 + (vertices[1] >= 0) + (vertices[2] >= 0); }
};

// Reduction to features, with the buffers of one thread.
class PointFeatures {
 public:
  // Returns the features closer than range [m] of the surface near p [m]: triangles, edges of no
  // triangle and vertices of no edge (global vertices). With plain sums, all count, without
  // inclusion-exclusion.
  const std::vector<PointFeature>& reduce(const VecX& x, const Vec3& p,
                                          std::span<const Triangle> triangles,
                                          std::span<const Edge> edges,
                                          std::span<const int> vertices, double range,
                                          bool plain_sums);
  // Returns the features of triangles with weights.
  const std::vector<PointFeature>& reduce(const VecX& x, const Vec3& p,
                                          std::span<const Triangle> triangles,
                                          std::span<const TriangleWeight> weights, double range);

 private:
  struct EdgeUse {
    Edge edge;
    int triangles;
  };
  struct VertexUse {
    int vertex;
    int coefficient;
  };
  struct CornerUse {
    std::array<int, 2> at;  // an edge, or a vertex and -1
    int triangle;           // index in the list
  };
  bool add_triangle(const VecX& x, const Vec3& p, const Triangle& t, double range_squared);
  void add_edge(const VecX& x, const Vec3& p, const Edge& e, double multiplicity,
                double range_squared);
  void subtract_shared(const VecX& x, const Vec3& p, double range_squared);
  void merge();
  double spanning_tree_weight(std::span<const CornerUse> uses,
                              std::span<const TriangleWeight> weights);

  std::vector<PointFeature> features_;
  std::vector<EdgeUse> edge_uses_;
  std::vector<VertexUse> vertex_uses_;
  std::vector<CornerUse> uses_;
  std::vector<std::pair<int, double>> joined_;  // vertex, j_E of an edge at it
  std::vector<double> tie_;                     // per triangle: its heaviest edge to the tree
};

}  // namespace tack
