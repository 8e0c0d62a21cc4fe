// Failures of a minimiser that no status names. The stepper makes a failed solve of them, after
// which substeps may follow.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "framework/core/minimizer.hpp"

namespace tack {

/// Thrown by a minimiser. done: its work until then.
struct MinimizerFailure : std::runtime_error {
  static constexpr const char* remedy =
      "correct the method, or choose another solver.type (tack list minimizer)";

  MinimizerFailure(const std::string& what, const MinimizerResult& done)
      : std::runtime_error(what), work(done) {}

  MinimizerResult work;
};

/// A search direction that is not finite, or along which the objective does not decrease to first
/// order. minimizer: its registered name, or "". fault: what its direction is.
struct FaultyDirection : MinimizerFailure {
  FaultyDirection(std::string_view minimizer, const std::string& fault, const MinimizerResult& done)
      : MinimizerFailure("the direction of " +
                             (minimizer.empty() ? "the minimizer"
                                                : "minimizer '" + std::string(minimizer) + "'") +
                             " is " + fault,
                         done) {}
};

}  // namespace tack
