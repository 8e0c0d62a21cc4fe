// The first step of a scene as the time loop opens it, with everything that a minimiser is told and
// asks for in the open.
#pragma once

#include "framework/stepping/convergence.hpp"
#include "framework/stepping/feasible_steps.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "tests/support/scene.hpp"

namespace tack {

struct StepProblem : TestScene {
  explicit StepProblem(const std::string& yaml);
  ~StepProblem();

  VecX configuration(const VecX& unknowns) const;
  double feasible_step(const VecX& from, const VecX& p);
  // Convergence test of this minimiser for the step.
  Convergence convergence(const Minimizer& minimizer);
  // From the start; q is where it ends, and `path` the points from which steps were tried and those
  // after an iteration.
  MinimizerResult minimize(Minimizer& minimizer, MinimizerProblem::Observer observer = {});

  TimeStepper stepper;
  const Step step;
  StepPotential& potential;
  FeasibleSteps steps;
  VecX q;
  std::vector<VecX> path;
};

}  // namespace tack
