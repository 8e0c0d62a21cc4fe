// How much energy a run has moved so far: what losses are to be compared with.
#pragma once

#include <algorithm>
#include <array>

namespace tack {

struct EnergyAtPlay {
  using Range = std::array<double, 3>;  // what has changed since the start, its lowest and its highest value [J]

  double kinetic = 0, dissipated = 0;     // the largest so far [J]
  Range elastic{}, contact{}, gravity{};  // gravity: of what was free in each step
  Range work{};                           // of loads and script

  static void move(Range& range, double by) {
    range[0] += by;
    range[1] = std::min(range[1], range[0]);
    range[2] = std::max(range[2], range[0]);
  }
  bool operator==(const EnergyAtPlay&) const = default;
  // The largest of all [J].
  double most() const {
    double most = std::max(kinetic, dissipated);
    for (const Range* range : {&elastic, &contact, &gravity, &work}) most = std::max(most, (*range)[2] - (*range)[1]);
    return most;
  }
};

}  // namespace tack
