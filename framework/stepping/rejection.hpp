// Reasons why the time loop repeats a step. step_size.hpp says what follows from each.
#pragma once

#include <array>

namespace tack {

enum class Rejection {
  solve,           // the solve failed
  inversion,       // an element is inverted
  intersection,    // surfaces intersect
  tunnelling,      // a body passed through another one
  debonding,       // a body debonds faster than the step resolves
  error,           // the error of an adaptive step is too large
  energy_contact,  // numerical energy gain or loss in contact
  energy_free,     // numerical energy gain or loss without contact
};
/// Names of the reasons, in their order: columns `rejected_NAME` of steps.csv.
inline constexpr std::array rejection_names = {"solve",          "inversion",  "intersection",
                                               "tunnelling",     "debonding",  "error",
                                               "energy_contact", "energy_free"};

/// Numbers of rejected tries of a step, by reason.
struct RejectionCounts {
  std::array<int, rejection_names.size()> counts{};

  int& operator[](Rejection reason) { return counts[static_cast<size_t>(reason)]; }
  int operator[](Rejection reason) const { return counts[static_cast<size_t>(reason)]; }
  // Returns the number of tries whose result was faulty.
  int cutbacks() const {
    return (*this)[Rejection::solve] + (*this)[Rejection::inversion] +
           (*this)[Rejection::intersection] + (*this)[Rejection::tunnelling] +
           (*this)[Rejection::debonding];
  }
  int of_energy() const {
    return (*this)[Rejection::energy_contact] + (*this)[Rejection::energy_free];
  }
};

}  // namespace tack
