// Secondary (integration) side of each pair of objects in a step: the side whose points carry
// contact pressure. Where the scene leaves it open, it is
//  1. the side with the larger overlap area. Example: a cube on a wide ground is integrated on the
//     cube, as all of its points are opposite the ground, whereas some points of the ground lie
//     past the boundary of the cube;
//  2. if the areas are about equal, the side with the finer surface in the overlap.
// The side of the last step is kept while its overlap is nearly as large, because a change of side
// changes the contact energy a little, without any work.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "framework/contact/area_integral/integration_rules.hpp"

namespace tack {

// Largest overshoot past the boundary of the other surface at which a point still counts as
// opposite, relative to the square root of its tributary area.
inline constexpr double overshoot_per_size_max = 0.02;

class IntegrationSides {
 public:
  // Pairs of objects a < b, ascending.
  using Pairs = std::vector<std::pair<int, int>>;

  IntegrationSides(const PairTable& pairs, const IntegrationRules& rules)
      : pairs_(pairs), rules_(rules) {}

  struct Overlap {
    double area = 0;  // m^2
    int triangles = 0;
  };
  // Returns the overlap of object a with object b, to be filled before choose().
  Overlap& overlap(int a, int b) {
    auto& both = overlaps_[std::minmax(a, b)];
    return a < b ? both.first : both.second;
  }
  void clear() { overlaps_.clear(); }
  // Chooses the sides of the pairs left open, from their overlaps and the sides of the last step.
  void choose();
  // Returns the pairs left open by the scene whose coarser side is the secondary side
  // (PairTable::finer).
  const Pairs& coarse_pairs() const { return coarse_pairs_; }
  void set_previous(std::optional<Pairs> previous) { previous_ = std::move(previous); }
  // Keeps the sides of these pairs, whatever their overlaps: bonds use their areas over many steps
  // (framework/bond).
  void keep(Pairs pairs) { kept_ = std::move(pairs); }
  // Returns whether a is the secondary side towards b.
  bool integrates(int a, int b) const {
    if (!rules_.of(a, b).by_overlap) return rules_.may_carry_pressure(a, b, pairs_);
    return pairs_.finer(a, b) != contains(coarse_pairs_, std::minmax(a, b));
  }

 private:
  using Both = std::pair<Overlap, Overlap>;  // of the first object, and of the second
  static bool contains(const Pairs& all, std::pair<int, int> pair) {
    return !all.empty() && std::binary_search(all.begin(), all.end(), pair);
  }
  bool first_integrates(std::pair<int, int> pair, const Both& overlaps) const;

  const PairTable& pairs_;
  const IntegrationRules& rules_;
  // Pairs of objects that are close; all other pairs have no overlap.
  std::map<std::pair<int, int>, Both> overlaps_;
  Pairs coarse_pairs_;
  std::optional<Pairs> previous_;
  Pairs kept_;
};

}  // namespace tack
