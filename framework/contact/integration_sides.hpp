// Which side of each pair of objects carries the pressure in a step. Where the scene leaves it open, it is the
// one whose points capture more area: those that lie opposite the other surface. A cube on a wide ground is
// integrated on the cube: all of its points see the ground, whereas of the ground's some lie beyond the
// cube's rim. Where both capture about as much, it is the one with the finer surface there. The side of the step
// before is kept while it captures nearly as much: with the side, the contact energy changes by a little that
// nobody did.
#pragma once

#include <vector>

#include "framework/contact/pair_table.hpp"

namespace tack {

// How far beyond the rim of the other surface a point may lie to count as opposite to it, relative to the root of
// the area that it stands for.
inline constexpr double rim_slack = 0.02;

class IntegrationSides {
 public:
  explicit IntegrationSides(const PairTable& pairs);

  struct Capture {
    double area = 0;  // m^2
    int triangles = 0;
  };
  // What the points of a capture of b.
  Capture& capture(int a, int b) { return captures_[a * objects_ + b]; }
  void clear();
  // From the captures, and the sides of the step before, for the pairs that are left open.
  void choose();
  // Per pair of objects (a, b) of a * objects + b: whether the points of a integrate. To go on from, empty: from none.
  const std::vector<char>& sides() const { return integrates_; }
  void set_before(std::vector<char> before) {
    before_ = before.size() == integrates_.size() ? std::move(before) : std::vector<char>();
  }
  bool integrates(int a, int b) const { return integrates_[a * objects_ + b] != 0; }

 private:
  bool first_integrates(int a, int b) const;

  const PairTable& pairs_;
  int objects_;
  std::vector<Capture> captures_;
  std::vector<char> integrates_, before_;
};

}  // namespace tack
