// What errors are measured against: projected Newton with a tolerance far below those compared, and a
// second one with another projection and another linear solver. How far the two are apart tells how much
// of an error is to be believed.
#pragma once

#include <memory>

#include "framework/compare/trial.hpp"

namespace tack {

struct Reference {
  std::unique_ptr<Trial> trial;
  double tolerance = 0;     // reached [m/s]; 0: none, and there is no reference
  std::string status;       // of the last try
  double disagreement = 0;  // between the two, largest vertex [m]; NaN if the second failed
  // What errors below mean nothing: the error (RMS [m]) that the second would be given if it were compared. NaN if it failed.
  double floor = 0;
  bool other_branch = false;  // they are two different solutions

  bool found() const { return tolerance > 0; }
};

// Tries the tolerance, then ten times more, and so on up to the largest, since round-off may be in the way.
Reference make_reference(const CompareCase& what, double step_size, double tolerance, double largest);

// The solution that x belongs to.
struct Branch {
  enum class Kind {
    same,     // the reference's
    equal,    // another point of the same potential: what moves freely in a quasi-static step
    another,  // another minimum
  };
  Kind kind = Kind::same;
  VecX x;  // it, as accurate as the reference (3n)
};
// Of a single step: what x becomes when it is refined as far as the reference. Of a run, only its
// distance from the reference's end tells.
Branch branch_of(const CompareCase& what, const Reference& reference, double step_size, const VecX& x);

// Of the vertices that move [m].
double largest_distance(const World& world, const VecX& a, const VecX& b);
double rms_distance(const World& world, const VecX& a, const VecX& b);

}  // namespace tack
