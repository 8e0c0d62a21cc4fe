// Length units of mesh files, which do not state the unit of their numbers.
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct LengthUnits {
  std::string from = "m", to = "m";

  std::string problem() const;  // "" or the error in one of them
  double factor() const;        // from numbers in one unit to numbers in the other
  bool trivial() const { return from == to; }
};

// Returns the note of a scaled mesh: "scaled by 0.001: now 0.1 x 0.02 x 0.02 m".
std::string scaled_note(const Mesh& scaled, double factor, const std::string& unit = "m");

}  // namespace tack
