// A point p against a triangulated surface, counted once. For a law phi that vanishes at its range,
//     sum_T phi(d_T) - sum_E (n_E - 1) phi(d_E) + sum_V c_V phi(d_V),
// over the triangles T, edges E (n_E triangles each) and vertices V, c_V = 1 - n_T(V) +
// sum_{E at V} (n_E - 1), is phi(d(p, surface)) wherever the part of the surface within reach is
// one piece, and the sum over the pieces otherwise: the coefficients make every point of the
// surface count once (Euler characteristic), whatever the mesh. It is as smooth as phi(d_T).
// Each d reduces to the closest feature (face, edge or vertex); features that meet again are
// merged, so on flat and convex surfaces one feature with multiplicity 1 remains.
// Triangles with shares s_T of the point, of which those that meet in E or V are one surface by
// k_TU (codimensional_view.hpp), have the sums
//     sum_T s_T phi(d_T) - sum_E j_E phi(d_E) + sum_V (sum_{E at V} j_E - j_V) phi(d_V),
// j the weight of the heaviest tree over the triangles at E or V, edges of which weigh min(s_T,
// s_U) k_TU: with shares and k of one or none the same as above, of those with one; and continuous
// in all of them. Source: the inclusion-exclusion of Li et al. 2023, Convergent Incremental
// Potential Contact.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "framework/contact/codimensional_view.hpp"
#include "geometry/types.hpp"

namespace tack {

struct PointFeature {
  std::array<int, 3> vertices;  // of the face, edge (third is -1) or vertex (second too), ascending
  double multiplicity;

  int count() const { return 1 + (vertices[1] >= 0) + (vertices[2] >= 0); }
};

// Scratch memory for one thread.
class PointFeatures {
 public:
  // The surface near p [m]: triangles, edges of no triangle, vertices of no edge (all indices
  // global). Keeps what is closer than range. With plain sums, triangles and such edges and
  // vertices simply add up.
  const std::vector<PointFeature>& reduce(const VecX& x, const Vec3& p,
                                          std::span<const Triangle> triangles,
                                          std::span<const Edge> edges,
                                          std::span<const int> vertices, double range,
                                          bool plain_sums);
  // Triangles alone, with their shares.
  const std::vector<PointFeature>& reduce(const VecX& x, const Vec3& p,
                                          std::span<const Triangle> triangles,
                                          std::span<const TriangleWeight> shares, double range);

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
    int triangle;           // of the list
  };
  bool add_triangle(const VecX& x, const Vec3& p, const Triangle& t, double range_squared);
  void add_edge(const VecX& x, const Vec3& p, const Edge& e, double multiplicity,
                double range_squared);
  void subtract_shared(const VecX& x, const Vec3& p, double range_squared);
  void merge();
  double heaviest_tree(std::span<const CornerUse> uses, std::span<const TriangleWeight> shares);

  std::vector<PointFeature> features_;
  std::vector<EdgeUse> edge_uses_;
  std::vector<VertexUse> vertex_uses_;
  std::vector<CornerUse> uses_;
  std::vector<std::pair<int, double>> joined_;  // a vertex, j of an edge there
  std::vector<double> tie_;                     // of triangles to the tree
};

}  // namespace tack
