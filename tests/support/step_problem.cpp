#include "tests/support/step_problem.hpp"

namespace tack {

StepProblem::StepProblem(const std::string& yaml)
    : TestScene(yaml), stepper(*world, config, config.time, *solver, clock, [](const std::string&) {}),
      step(stepper.open(config.time.step)), potential(step.potential), steps(*world, clock) {
  world->dofs.gather(step.state.x, q);
}

StepProblem::~StepProblem() = default;

VecX StepProblem::configuration(const VecX& unknowns) const {
  VecX x = step.targets;
  world->dofs.scatter(unknowns, x);
  return x;
}

double StepProblem::feasible_step(const VecX& from, const VecX& p) {
  if (path.empty() || path.back() != from) path.push_back(from);
  return steps.largest_requested(potential, from, p);
}

Convergence StepProblem::convergence(const Minimizer& minimizer) {
  Convergence convergence(*world, minimizer, config.time.step);
  convergence.begin_step(potential, step.h, step.prediction.inertia);
  return convergence;
}

MinimizerResult StepProblem::minimize(Minimizer& minimizer, MinimizerProblem::Observer observer) {
  Convergence judge = convergence(minimizer);
  MinimizerProblem problem{
      potential, [this](const VecX& from, const VecX& p) { return feasible_step(from, p); }, {}, clock};
  steps.set_feasibility(potential, problem);
  problem.feasible_step = [this](const VecX& from, const VecX& p) { return feasible_step(from, p); };
  problem.observer = [this, told = std::move(observer)](int iteration, double residual, double value, double seconds) {
    VecX reached;
    world->dofs.gather(potential.configuration(), reached);
    if (path.empty() || path.back() != reached) path.push_back(std::move(reached));
    if (told) told(iteration, residual, value, seconds);
  };
  judge.set_criteria(problem);
  path.clear();
  const MinimizerResult result = minimizer.minimize(problem, q);
  path.push_back(q);
  return result;
}

}  // namespace tack
