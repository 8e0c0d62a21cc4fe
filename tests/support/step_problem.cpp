#include "tests/support/step_problem.hpp"

#include "framework/contact/friction_term.hpp"

namespace tack {

StepProblem::StepProblem(const std::string& yaml)
    : TestScene(yaml),
      potential(world->terms, world->dofs, world->mass, clock,
                [this](const VecX& x) { world->participants.move_to(x); }) {
  const State& start = world->start;
  const double h = config.time.step;
  filters = attached_filters({world->contact.get(), world->tets, clock});
  world->participants.begin_step({start.x, start.time, h});
  prediction = config.time.integrator->predict(start, h);
  potential.begin_step(start.x, prediction.x, prediction.scales(), prediction.inertia);
  world->dofs.gather(start.x, q);
}

StepProblem::~StepProblem() = default;

VecX StepProblem::configuration(const VecX& unknowns) const {
  VecX x = world->start.x;
  world->dofs.scatter(unknowns, x);
  return x;
}

double StepProblem::feasible_step(const VecX& from, const VecX& p) {
  if (path.empty() || path.back() != from) path.push_back(from);
  VecX way = VecX::Zero(world->start.x.size());
  world->dofs.scatter(p, way);
  double t = 1;
  for (const auto& filter : filters) t = filter->largest_step(configuration(from), way, t);
  return t;
}

Convergence StepProblem::convergence(const Minimizer& minimizer) {
  Convergence convergence(*world, minimizer);
  convergence.begin_step(potential, config.time.step, prediction.inertia);
  return convergence;
}

MinimizerResult StepProblem::minimize(Minimizer& minimizer, MinimizerProblem::Observer observer) {
  Convergence judge = convergence(minimizer);
  MinimizerProblem problem{
      potential, [this](const VecX& from, const VecX& p) { return feasible_step(from, p); }, {}, clock};
  problem.observer = std::move(observer);
  judge.judge(problem);
  path.clear();
  const MinimizerResult result = minimizer.minimize(problem, q);
  path.push_back(q);
  return result;
}

}  // namespace tack
