// Report of one exchange of an object's tets.
#pragma once

#include <string>

namespace tack {

struct Remeshing {
  std::string object;
  int step = 0;          // after which
  double time = 0;       // s
  double before = 0, after = 0;  // the lowest mean ratio of its tets
  int tets_before = 0, tets_after = 0;
  double lost = 0;  // energy that was stored, of all objects exchanged after the step together [J]
  bool operator==(const Remeshing&) const = default;
};

}  // namespace tack
