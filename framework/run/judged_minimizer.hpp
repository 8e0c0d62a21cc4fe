// A minimiser whose results are judged by another one: the stopping norm of the clamped Newton
// direction at the result, in the problem of the minimisation itself (with its lagged forces).
#pragma once

#include <memory>
#include <optional>

#include "framework/core/minimizer.hpp"

namespace tack {

/// Findings of the judge.
struct Judgement {
  // Stopping norm after the last minimisation, in tolerances; nothing if the Newton system has no
  // solution, or after an interrupt.
  std::optional<double> residual;
  double cpu_seconds = 0, wall_seconds = 0;  // of all judgements
};

/// Returns a minimiser that does as `inner` does and then judges. `inner` has the criteria.
/// judgement lives longer than the minimiser.
std::unique_ptr<Minimizer> judged(std::unique_ptr<Minimizer> inner, Judgement& judgement);

}  // namespace tack
