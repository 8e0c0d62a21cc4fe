// A point p against a triangulated surface, counted once. For a law phi that vanishes at its range,
//     sum_T phi(d_T) - sum_E (n_E - 1) phi(d_E) + sum_V c_V phi(d_V),
// over the triangles T, edges E (n_E triangles each) and vertices V, c_V = 1 - n_T(V) +
// sum_{E at V} (n_E - 1), is phi(d(p, surface)) wherever the part of the surface within reach is one
// piece, and the sum over the pieces otherwise: the coefficients make every point of the surface
// count once (Euler characteristic), whatever the mesh. It is as smooth as phi(d_T).
// Each d reduces to the closest feature (face, edge or vertex); features that meet again are merged,
// so on flat and convex surfaces one feature with multiplicity 1 remains.
// Source: the inclusion-exclusion of Li et al. 2023, Convergent Incremental Potential Contact.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct PointFeature {
  std::array<int, 3> vertices;  // of the face, edge (third is -1) or vertex (second too), ascending
  int multiplicity;

  int count() const { return 1 + (vertices[1] >= 0) + (vertices[2] >= 0); }
};

// Scratch memory for one thread.
class PointFeatures {
 public:
  // The surface near p [m]: triangles, edges of no triangle, vertices of no edge (all indices
  // global). Keeps what is closer than range. With plain sums, triangles and such edges and vertices
  // simply add up.
  const std::vector<PointFeature>& reduce(const VecX& x, const Vec3& p, std::span<const Triangle> triangles,
                                          std::span<const Edge> edges, std::span<const int> vertices,
                                          double range, bool plain_sums);

 private:
  struct EdgeUse {
    Edge edge;
    int triangles;
  };
  struct VertexUse {
    int vertex;
    int coefficient;
  };
  bool add_triangle(const VecX& x, const Vec3& p, const Triangle& t, double range_squared);
  void add_edge(const VecX& x, const Vec3& p, const Edge& e, int multiplicity, double range_squared);
  void subtract_shared(const VecX& x, const Vec3& p, double range_squared);
  void merge();

  std::vector<PointFeature> features_;
  std::vector<EdgeUse> edge_uses_;
  std::vector<VertexUse> vertex_uses_;
};

}  // namespace tack
