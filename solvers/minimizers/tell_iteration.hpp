// Tells the observer of a problem, if there is one, of iterations.
#pragma once

#include <chrono>

#include "framework/core/minimizer.hpp"

namespace tack {

class TellIteration {
 public:
  explicit TellIteration(const MinimizerProblem& problem) : problem_(problem) {}
  // After an iteration, with the objective where it led.
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
