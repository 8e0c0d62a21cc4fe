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
// Source: inclusion-exclusion of Li et al. 2023, Convergent Incremental Potential Contact.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// How the features of a surface count.
enum class FeatureCount {
  inclusion_exclusion,  // the sum above
  each                  // every triangle, edge and vertex of the lists by itself
};

// Multiplicities below this are round-off of sums.
inline constexpr double multiplicity_rounding = 1e-9;

struct PointFeature {
  std::array<int, 3> vertices;  // ascending; of an edge the third is -1, of a vertex the second too
  double multiplicity;

  int count() const { return 1 + (vertices[1] >= 0) + (vertices[2] >= 0); }
};

// Returns the closest feature of a triangle to a point p [m].
PointFeature closest_feature(const VecX& x, const Vec3& p, const Triangle& t);

// Reduction to features, with the buffers of one thread.
class PointFeatures {
 public:
  // Returns the features closer than range [m] of the surface near p [m]: triangles, edges of no
  // triangle and vertices of no edge (global vertices).
  const std::vector<PointFeature>& reduce(const VecX& x, const Vec3& p,
                                          std::span<const Triangle> triangles,
                                          std::span<const Edge> edges,
                                          std::span<const int> vertices, double range,
                                          FeatureCount count);

 protected:
  bool add_triangle(const VecX& x, const Vec3& p, const Triangle& t, double range_squared);
  void add_edge(const VecX& x, const Vec3& p, const Edge& e, double multiplicity,
                double range_squared);
  void merge();

  std::vector<PointFeature> features_;

 private:
  struct EdgeUse {
    Edge edge;
    int triangles;
  };
  struct VertexUse {
    int vertex;
    int coefficient;
  };
  void subtract_shared(const VecX& x, const Vec3& p, double range_squared);

  std::vector<EdgeUse> edge_uses_;
  std::vector<VertexUse> vertex_uses_;
};

}  // namespace tack
