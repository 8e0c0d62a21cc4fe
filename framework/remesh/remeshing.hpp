// Report of one exchange of an object's tets.
#pragma once

#include <string>

namespace tack {

struct Remeshing {
  std::string object;
  int step = 0;                  // the step before it
  double time = 0;               // s
  double before = 0, after = 0;  // lowest mean ratio of its tets
  int tets_before = 0, tets_after = 0;
  // Loss of stored energy of all objects remeshed after the step together [J].
  double lost = 0;
  bool operator==(const Remeshing&) const = default;
};

}  // namespace tack
