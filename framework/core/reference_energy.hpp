// Reference energy: the largest amount of energy that a run has moved so far. The energy balance
// compares numerical losses with it.
#pragma once

#include <algorithm>
#include <array>

namespace tack {

/// Extremes of the energies of a run.
struct ReferenceEnergy {
  using Range = std::array<double, 3>;  // change since the start, its minimum and its maximum [J]

  double kinetic = 0, dissipated = 0;     // largest values so far [J]
  Range elastic{}, contact{}, gravity{};  // gravity: of the vertices free in each step
  Range work{};                           // of loads and prescribed motion

  static void move(Range& range, double by) {
    range[0] += by;
    range[1] = std::min(range[1], range[0]);
    range[2] = std::max(range[2], range[0]);
  }
  bool operator==(const ReferenceEnergy&) const = default;
  /// Returns the largest of all amounts [J].
  double largest() const {
    double largest = std::max(kinetic, dissipated);
    for (const Range* range : {&elastic, &contact, &gravity, &work})
      largest = std::max(largest, (*range)[2] - (*range)[1]);
    return largest;
  }
};

}  // namespace tack
