#include "framework/sensitivity/gradients.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"

namespace tack {
namespace {

const std::string asked_by = "output.gradients: ";

void require_minimised_steps(const Experiment& e) {
  if (e.time.adaptive)
    throw InputError("output.gradients: sizes of steps that adapt (time.adaptive) jump with the numbers, and what is shown with them; take steps of one "
                     "size, or the gradients out");
  if (e.time.stepper->type() == "incremental_potential") return;
  throw InputError(fmt::format("output.gradients: steps of time.stepper: {} end at no least of a potential, which derivatives are found from; "
                               "take incremental_potential, or the gradients out", e.time.stepper->type()));
}

}  // namespace

Gradients::Gradients(BuiltExperiment& run) : run_(run), system_(run.clock()) {
  if (!run.experiment().output.gradients.empty()) require_minimised_steps(run.experiment());
  for (const GradientConfig& config : run.experiment().output.gradients) neighbours_.push_back(std::make_unique<Neighbour>(run, config));
}

std::string Gradients::reason_without(const BuiltExperiment& run, const GradientConfig& config) {
  try {
    require_minimised_steps(run.experiment());
    Neighbour(run, config);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.starts_with(asked_by) ? what.substr(asked_by.size()) : what;
  }
  return "";
}

std::vector<std::string> Gradients::columns(const std::vector<std::string>& probes) const {
  std::vector<std::string> columns;
  for (const auto& n : neighbours_)
    for (const std::string& probe : probes) columns.push_back(fmt::format("d({})/d({})", probe, n->name()));
  return columns;
}

void Gradients::start() {
  for (const auto& n : neighbours_) n->start();
}

// The potential of a solved step is usually still at the end of the step.
void Gradients::solved(const SolvedStep& step) {
  if (step.potential.configuration() != step.result.x) {
    VecX q;
    run_.world().dofs.gather(step.result.x, q);
    step.potential.move_to(q);
  }
  system_.begin(step);
  for (const auto& n : neighbours_) n->solve(step, step.potential.gradient(), system_);
}

void Gradients::kept(const State& state) {
  ++steps_;
  for (const auto& n : neighbours_) n->keep(state);
}

std::vector<double> Gradients::values(const std::vector<double>& probes) {
  std::vector<double> values;
  for (const auto& n : neighbours_) {
    const std::vector<double> more = n->derivatives(probes);
    values.insert(values.end(), more.begin(), more.end());
  }
  return values;
}

void Gradients::store(History& history) const {
  for (const auto& n : neighbours_) n->store(history);
}

void Gradients::start_from(State& state) {
  const History all = state.history;
  std::erase_if(state.history, [](const auto& entry) { return entry.first.starts_with("gradients/"); });
  for (const auto& n : neighbours_) n->start_from(state, all);
  system_.forget();
}

std::vector<Warning> Gradients::doubts() const {
  std::vector<Warning> doubts;
  for (const auto& n : neighbours_) {
    if (n->unsettled() > 0)
      doubts.push_back(fmt::format("gradients.csv: in {} of {} steps the derivatives by '{}' were not found to a millionth: there the end of the "
                                   "step is far from linear in it, as where something snaps; a smaller time.step may help", n->unsettled(), steps_, n->name()));
    if (n->jumps() > 0)
      doubts.push_back(fmt::format("gradients.csv: with a little more of '{}' other things happened in {} places (bonds made or lost, sides changed), which "
                                   "have no derivative and are left out of it", n->name(), n->jumps()));
  }
  if (system_.indefinite() > 0)
    doubts.push_back(fmt::format("gradients.csv: {} of {} Hessians were not positive definite: steps ended where nothing is stable, or were not solved "
                                 "well enough (solver.tolerance)", system_.indefinite(), system_.factors()));
  return doubts;
}

}  // namespace tack
