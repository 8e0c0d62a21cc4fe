// Summary of the laws between two objects, barrier and adhesion together.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace tack {

struct AdhesionSummary {
  std::array<std::string, 2> between;     // the first two objects with these laws
  double pairs = 1;                       // number of pairs of objects with these laws
  std::vector<std::array<int, 2>> kinds;  // two objects of each pair of classes (ObjectClasses)
  int region_pair = -1;                   // of these two objects (PairTable::region_pair)
  double work_of_adhesion = 0;            // of the adhesion alone [J/m^2]
  double effective = 0;      // work from the rest gap to infinity, less the barrier's [J/m^2]
  double rest_gap = 0;       // where the traction vanishes [m]
  double peak_traction = 0;  // Pa

  // Returns the names as text: "'tape' - 'desk' and 3 more pairs".
  std::string names() const {
    const std::string first =
        "'" + between[0] + "' - '" + between[1] + "'" + (region_pair < 0 ? "" : " (parts)");
    return pairs < 2 ? first
                     : first + " and " + std::to_string(static_cast<long>(pairs) - 1) +
                           " more pair" + (pairs > 2 ? "s" : "");
  }
  // Returns the fraction of the work that the barrier takes; above tolerated_loss it is reported.
  double loss() const { return 1 - effective / work_of_adhesion; }
  static constexpr double tolerated_loss = 0.1;
};

}  // namespace tack
