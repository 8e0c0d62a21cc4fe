// Integration side of each pair of objects in a step: the side that carries the pressure. Where the
// scene leaves it open, it is
//  1. the side with the larger overlap area: a cube on a wide ground is integrated on the cube, as
//     all of its points are opposite the ground, whereas some of the ground's lie past the cube's
//     boundary;
//  2. if the areas are about equal, the side with the finer surface there.
// The side of the last step is kept while its overlap is nearly as large: a change of side changes
// the contact energy a little, without any work.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "framework/contact/pair_table.hpp"

namespace tack {

// Largest distance past the boundary of the other surface at which a point still counts as
// opposite, relative to the root of the area that it stands for.
inline constexpr double rim_slack = 0.02;

class IntegrationSides {
 public:
  // Objects a < b, ascending.
  using Pairs = std::vector<std::pair<int, int>>;

  explicit IntegrationSides(const PairTable& pairs) : pairs_(pairs) {}

  struct Capture {
    double area = 0;  // m^2
    int triangles = 0;
  };
  // Overlap of the points of a with object b.
  Capture& capture(int a, int b) {
    auto& both = captures_[std::minmax(a, b)];
    return a < b ? both.first : both.second;
  }
  void clear() { captures_.clear(); }
  // From the captures, and the sides of the step before, for the pairs that are left open.
  void choose();
  // Pairs left open by the scene whose coarser side integrates (PairTable::finer). Without a step
  // before to continue from, there are none.
  const Pairs& turned() const { return turned_; }
  void set_before(std::optional<Pairs> before) { before_ = std::move(before); }
  // These keep their sides, whatever they capture: what their areas have become lasts longer than a
  // step (framework/bond).
  void hold(Pairs pairs) { held_ = std::move(pairs); }
  // Returns whether the points of a integrate against b.
  bool integrates(int a, int b) const {
    if (!pairs_.point(a, b).by_overlap) return pairs_.may_carry_pressure(a, b);
    return pairs_.finer(a, b) != holds(turned_, std::minmax(a, b));
  }

 private:
  using Both = std::pair<Capture, Capture>;  // of the first object, and of the second
  static bool holds(const Pairs& all, std::pair<int, int> pair) {
    return !all.empty() && std::binary_search(all.begin(), all.end(), pair);
  }
  bool first_integrates(std::pair<int, int> pair, const Both& captures) const;

  const PairTable& pairs_;
  // Pairs of objects that are close; all other pairs have no overlap.
  std::map<std::pair<int, int>, Both> captures_;
  Pairs turned_;
  std::optional<Pairs> before_;
  Pairs held_;
};

}  // namespace tack
