#include "framework/contact/area_integral/weighted_features.hpp"

#include <algorithm>
#include <cmath>

namespace tack {

// Returns the weight of the maximum spanning tree over triangles that meet in an edge or a vertex,
// by Prim's algorithm.
double WeightedFeatures::spanning_tree_weight(std::span<const CornerUse> uses, std::span<const TriangleWeight> weights) {
  const auto tie = [&](const CornerUse& a, const CornerUse& b) {
    const TriangleWeight &s = weights[a.triangle], &t = weights[b.triangle];
    return std::min(s.weight, t.weight) * patch_affinity(s, t);
  };
  if (uses.size() < 2) return 0;
  if (uses.size() == 2) return tie(uses[0], uses[1]);
  tie_.assign(uses.size(), 0);
  for (size_t i = 1; i < uses.size(); ++i) tie_[i] = tie(uses[0], uses[i]);
  tie_[0] = -1;  // in the tree
  double sum = 0;
  for (size_t k = 1; k < uses.size(); ++k) {
    const size_t next = std::max_element(tie_.begin(), tie_.end()) - tie_.begin();
    sum += tie_[next];
    tie_[next] = -1;
    for (size_t i = 0; i < uses.size(); ++i)
      if (tie_[i] >= 0) tie_[i] = std::max(tie_[i], tie(uses[next], uses[i]));
  }
  return sum;
}

const std::vector<PointFeature>& WeightedFeatures::reduce(const VecX& x, const Vec3& p, std::span<const Triangle> triangles,
                                                       std::span<const TriangleWeight> weights, double range) {
  features_.clear();
  uses_.clear();
  joined_.clear();
  const double range_squared = range * range;
  for (int i = 0; i < static_cast<int>(triangles.size()); ++i) {
    if (!add_triangle(x, p, triangles[i], range_squared)) continue;
    features_.back().multiplicity = weights[i].weight;
    for (int side = 0; side < 3; ++side) {
      const auto [a, b] = std::minmax(triangles[i][side], triangles[i][(side + 1) % 3]);
      uses_.push_back({{a, b}, i});
      uses_.push_back({{triangles[i][side], -1}, i});
    }
  }
  if (features_.size() < 2) return features_;
  std::sort(uses_.begin(), uses_.end(), [](const CornerUse& a, const CornerUse& b) {
    return std::pair(a.at, a.triangle) < std::pair(b.at, b.triangle);
  });
  const auto for_each_shared_feature = [&](bool edges, const auto& act) {
    for (auto first = uses_.begin(), last = first; first != uses_.end(); first = last) {
      last = std::find_if(first, uses_.end(), [&](const CornerUse& use) { return use.at != first->at; });
      if ((first->at[1] >= 0) == edges && last - first > 1) act(first->at, spanning_tree_weight({first, last}, weights));
    }
  };
  for_each_shared_feature(true, [&](const std::array<int, 2>& edge, double tree) {
    add_edge(x, p, edge, -tree, range_squared);
    for (const int v : edge) joined_.emplace_back(v, tree);
  });
  std::sort(joined_.begin(), joined_.end());
  for_each_shared_feature(false, [&](const std::array<int, 2>& at, double tree) {
    double coefficient = -tree;
    const auto first = std::lower_bound(joined_.begin(), joined_.end(), std::pair(at[0], -1.0));
    for (auto j = first; j != joined_.end() && j->first == at[0]; ++j) coefficient += j->second;
    if (std::abs(coefficient) > multiplicity_rounding && (p - vertex(x, at[0])).squaredNorm() < range_squared)
      features_.push_back({{at[0], -1, -1}, coefficient});
  });
  merge();
  return features_;
}

}  // namespace tack
