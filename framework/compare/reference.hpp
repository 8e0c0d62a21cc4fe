// Reference solutions of error measurements: projected Newton with a tolerance far below those
// compared, and a second reference with another projection and another linear solver. The distance
// of the two is the smallest error that can be resolved.
#pragma once

#include <memory>

#include "framework/compare/trial.hpp"

namespace tack {

struct Reference {
  std::unique_ptr<Trial> trial;
  double tolerance = 0;     // reached [m/s]; 0: no reference was found
  std::string status;       // of the last attempt
  double disagreement = 0;  // between the two, largest vertex [m]; NaN if the second failed
  // Error (RMS [m]) of the second reference, measured like that of a compared solver; smaller
  // errors are noise. NaN if the second reference failed.
  double floor = 0;
  bool other_branch = false;  // the two are different solutions

  bool exists() const { return tolerance > 0; }
};

// Tries `tolerance`, then tenfold tolerances up to `largest`, since round-off may prevent
// convergence.
Reference make_reference(const CompareCase& compare_case, double step_size, double tolerance,
                         double largest);

// The solution that x belongs to, relative to the reference.
struct Branch {
  enum class Kind {
    same,  // the reference's
    // Another point of the same potential: unconstrained displacement in a quasi-static step.
    equal,
    another,  // another minimum
  };
  Kind kind = Kind::same;
  VecX x;  // the solution, as accurate as the reference (3n)
};
// Classifies the end x of a solve. For a single step, refines x as far as the reference. For a run,
// judges by the distance from the end of the reference.
Branch branch_of(const CompareCase& compare_case, const Reference& reference, double step_size,
                 const VecX& x);

// Returns the distance of the moving vertices [m].
double largest_distance(const World& world, const VecX& a, const VecX& b);
double rms_distance(const World& world, const VecX& a, const VecX& b);

}  // namespace tack
