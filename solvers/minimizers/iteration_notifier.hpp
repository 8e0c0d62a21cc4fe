// Notifies the observer of a problem, if it has one, of iterations.
#pragma once

#include <chrono>

#include "framework/core/minimizer.hpp"

namespace tack {

class IterationNotifier {
 public:
  explicit IterationNotifier(const MinimizerProblem& problem) : problem_(problem) {}
  // Notifies after an iteration, with the objective at the new point.
  void operator()(const MinimizerResult& result) const {
    if (!problem_.observer) return;
    const std::chrono::duration<double> seconds = Clock::now() - started_;
    problem_.observer(result.iterations, result.residual, problem_.objective.value(),
                      seconds.count());
  }

 private:
  using Clock = std::chrono::steady_clock;

  const MinimizerProblem& problem_;
  Clock::time_point started_ = Clock::now();
};

}  // namespace tack
