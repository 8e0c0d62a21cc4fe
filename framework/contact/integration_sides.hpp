// Which side of each pair of objects carries the pressure in a step. Where the scene leaves it open, it is the
// one whose points capture more area: those that lie opposite the other surface. A cube on a wide ground is
// integrated on the cube: all of its points see the ground, whereas of the ground's some lie beyond the
// cube's rim. Where both capture about as much, it is the one with the finer surface there. The side of the step
// before is kept while it captures nearly as much: with the side, the contact energy changes by a little that
// nobody did.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "framework/contact/pair_table.hpp"

namespace tack {

// How far beyond the rim of the other surface a point may lie to count as opposite to it, relative to the root of
// the area that it stands for.
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
  // What the points of a capture of b.
  Capture& capture(int a, int b) {
    auto& both = captures_[std::minmax(a, b)];
    return a < b ? both.first : both.second;
  }
  void clear() { captures_.clear(); }
  // From the captures, and the sides of the step before, for the pairs that are left open.
  void choose();
  // Of the pairs that are left open, those whose coarser side integrates (PairTable::finer). To go on from, empty: from
  // none.
  const Pairs& turned() const { return turned_; }
  void set_before(std::optional<Pairs> before) { before_ = std::move(before); }
  // These keep their sides, whatever they capture: what their areas have become lasts longer than a step (framework/bond).
  void hold(Pairs pairs) { held_ = std::move(pairs); }
  // Whether the points of a do, against b.
  bool integrates(int a, int b) const {
    if (!pairs_.point(a, b).automatic) return pairs_.presses(a, b);
    return pairs_.finer(a, b) != holds(turned_, std::minmax(a, b));
  }

 private:
  using Both = std::pair<Capture, Capture>;  // of the first object, and of the second
  static bool holds(const Pairs& all, std::pair<int, int> pair) { return !all.empty() && std::binary_search(all.begin(), all.end(), pair); }
  bool first_integrates(std::pair<int, int> pair, const Both& captures) const;

  const PairTable& pairs_;
  std::map<std::pair<int, int>, Both> captures_;  // of pairs that are close; the others capture nothing
  Pairs turned_;
  std::optional<Pairs> before_;
  Pairs held_;
};

}  // namespace tack
