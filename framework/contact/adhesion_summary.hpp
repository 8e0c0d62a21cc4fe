// Summary of the laws between two objects, barrier and adhesion together.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace tack {

struct AdhesionSummary {
  std::array<std::string, 2> between;     // the first two objects of which this is true
  double pairs = 1;                       // how many there are
  std::vector<std::array<int, 2>> kinds;  // two objects of each pair of classes (ObjectClasses)
  int part = -1;                          // of theirs (PairTable::part)
  double work_of_adhesion = 0;  // of the adhesion alone [J/m^2]
  double effective = 0;         // from the rest gap to infinity, against the barrier [J/m^2]
  double rest_gap = 0;          // where the traction vanishes [m]
  double peak_traction = 0;     // Pa

  // "'tape' - 'desk' and 3 more pairs"
  std::string names() const {
    const std::string first =
        "'" + between[0] + "' - '" + between[1] + "'" + (part < 0 ? "" : " (parts)");
    return pairs < 2 ? first
                     : first + " and " + std::to_string(static_cast<long>(pairs) - 1) +
                           " more pair" + (pairs > 2 ? "s" : "");
  }
  // The share of the work that the barrier takes; a warning is due above tolerated_loss.
  double loss() const { return 1 - effective / work_of_adhesion; }
  static constexpr double tolerated_loss = 0.1;
};

}  // namespace tack
