// Features of a point over triangles with weights: the sum of point_features.hpp, made continuous
// in the weights.
//
// With weights s_T of the point, and affinities k_TU of triangles that meet in E or V
// (codimensional_weights.hpp), the sum is
//     sum_T s_T phi(d_T) - sum_E j_E phi(d_E) + sum_V (sum_{E at V} j_E - j_V) phi(d_V),
// where j is the weight of the maximum spanning tree over the triangles at E or V, whose edges
// weigh min(s_T, s_U) k_TU. If all s and k are 0 or 1, it is the sum above over the triangles with
// s_T = 1. It is continuous in all s and k.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "framework/contact/area_integral/codimensional_weights.hpp"
#include "framework/contact/stencils/point_features.hpp"

namespace tack {

// Reduction to features, with the buffers of one thread.
class WeightedFeatures : public PointFeatures {
 public:
  using PointFeatures::reduce;
  // Returns the features closer than range [m] of triangles with weights.
  const std::vector<PointFeature>& reduce(const VecX& x, const Vec3& p,
                                          std::span<const Triangle> triangles,
                                          std::span<const TriangleWeight> weights, double range);

 private:
  struct CornerUse {
    std::array<int, 2> at;  // an edge, or a vertex and -1
    int triangle;           // index in the list
  };
  double spanning_tree_weight(std::span<const CornerUse> uses,
                              std::span<const TriangleWeight> weights);

  std::vector<CornerUse> uses_;
  std::vector<std::pair<int, double>> joined_;  // vertex, j_E of an edge at it
  std::vector<double> tie_;                     // per triangle: its heaviest edge to the tree
};

}  // namespace tack
