// The minimisation of the first step of a scene, with everything that a minimiser is told and asks for
// in the open.
#pragma once

#include <limits>

#include "framework/core/incremental_potential.hpp"
#include "framework/core/step_filter.hpp"
#include "tests/support/scene.hpp"

namespace tack {

struct StepProblem : TestScene {
  explicit StepProblem(const std::string& yaml)
      : TestScene(yaml),
        potential(world->terms, world->dofs, world->mass, clock,
                  [this](const VecX& x) { if (world->contact) world->contact->move_to(x); }) {
    const State& start = world->start;
    const double h = config.time.step;
    for (const std::string& name : Registry<StepFilter>::kind().names()) {
      auto filter = Registry<StepFilter>::make(name);
      if (filter->attach({world->contact.get(), world->tets, clock})) filters.push_back(std::move(filter));
    }
    if (world->contact) world->contact->begin_step(start.x);
    if (world->friction) {
      world->contact->move_to(start.x);
      world->friction->begin_step(start.x, h);
    }
    VecX weight(start.x.size());
    for (int v = 0; v < start.x.size() / 3; ++v) vertex(weight, v) = world->mass(v) * world->gravity;
    world->gravity_term.set(weight, start.x);
    prediction = config.time.integrator->predict(start, h);
    potential.begin_step(start.x, prediction.x, prediction.scale, prediction.inertia);
    world->dofs.gather(start.x, q);
  }

  VecX configuration(const VecX& unknowns) const {
    VecX x = world->start.x;
    world->dofs.scatter(unknowns, x);
    return x;
  }

  double feasible_step(const VecX& from, const VecX& p) {
    if (path.empty() || path.back() != from) path.push_back(from);
    VecX way = VecX::Zero(world->start.x.size());
    world->dofs.scatter(p, way);
    double t = 1;
    for (const auto& filter : filters) t = filter->largest_step(configuration(from), way, t);
    return t;
  }

  // From the start; q is where it ends, and `path` the points from which steps were tried, and the end.
  MinimizerResult minimize(Minimizer& minimizer) {
    const MinimizerProblem problem{
        potential, [this](const VecX& from, const VecX& p) { return feasible_step(from, p); },
        [&](const VecX& p, const VecX&) {
          return p.lpNorm<Eigen::Infinity>() / config.time.step / minimizer.velocity_tolerance();
        },
        clock, true};
    path.clear();
    const MinimizerResult result = minimizer.minimize(problem, q);
    path.push_back(q);
    return result;
  }

  IncrementalPotential potential;
  std::vector<std::unique_ptr<StepFilter>> filters;
  TimeIntegrator::Prediction prediction;
  VecX q;
  std::vector<VecX> path;
};

}  // namespace tack
