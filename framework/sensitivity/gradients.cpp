#include "framework/sensitivity/gradients.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"

namespace tack {
namespace {

const std::string message_prefix = "output.gradients: ";

void require_minimised_steps(const Experiment& e) {
  if (e.time.adaptive)
    throw InputError("output.gradients: results with adaptive steps (time.adaptive) are not differentiable; use steps of fixed size, or remove the gradients");
  if (e.time.integrator->stages().size() > 1)
    throw InputError(fmt::format("output.gradients: sensitivities need an integrator of one stage, and time.integrator: {} has {}; take another one, or remove the gradients",
                                 e.time.integrator->type(), e.time.integrator->stages().size()));
  if (e.time.stepper->type() == "incremental_potential") return;
  throw InputError(fmt::format("output.gradients: sensitivities need steps that minimise a potential, and time.stepper: {} does not; "
                               "use incremental_potential, or remove the gradients", e.time.stepper->type()));
}

}  // namespace

Gradients::Gradients(BuiltExperiment& run) : run_(run), system_(run.clock()) {
  if (!run.experiment().output.gradients.empty()) require_minimised_steps(run.experiment());
  for (const GradientConfig& config : run.experiment().output.gradients) perturbed_scenes_.push_back(std::make_unique<PerturbedScene>(run, config));
}

std::string Gradients::reason_without(const BuiltExperiment& run, const GradientConfig& config) {
  try {
    require_minimised_steps(run.experiment());
    PerturbedScene(run, config);
  } catch (const InputError& error) {
    const std::string what = error.what();
    return what.starts_with(message_prefix) ? what.substr(message_prefix.size()) : what;
  }
  return "";
}

std::vector<std::string> Gradients::columns(const std::vector<std::string>& probes) const {
  std::vector<std::string> columns;
  for (const auto& n : perturbed_scenes_)
    for (const std::string& probe : probes) columns.push_back(fmt::format("d({})/d({})", probe, n->name()));
  return columns;
}

void Gradients::start() {
  for (const auto& n : perturbed_scenes_) n->start();
}

// The potential of a solved step is usually still at the end of the step.
void Gradients::follow_solve(const SolvedStep& step) {
  if (step.potential.configuration() != step.result.x) {
    VecX q;
    run_.world().dofs.gather(step.result.x, q);
    step.potential.move_to(q);
  }
  system_.begin(step);
  for (const auto& n : perturbed_scenes_) n->solve(step, step.potential.gradient(), system_);
}

void Gradients::accept(const State& state) {
  ++steps_;
  for (const auto& n : perturbed_scenes_) n->accept(state);
}

std::vector<double> Gradients::values(const std::vector<double>& probes) {
  std::vector<double> values;
  for (const auto& n : perturbed_scenes_) {
    const std::vector<double> more = n->derivatives(probes);
    values.insert(values.end(), more.begin(), more.end());
  }
  return values;
}

void Gradients::store(History& history) const {
  for (const auto& n : perturbed_scenes_) n->store(history);
}

void Gradients::start_from(State& state) {
  const History all = state.history;
  std::erase_if(state.history, [](const auto& entry) { return entry.first.starts_with("gradients/"); });
  for (const auto& n : perturbed_scenes_) n->start_from(state, all);
  system_.forget();
}

std::vector<Warning> Gradients::warnings() const {
  std::vector<Warning> warnings;
  for (const auto& n : perturbed_scenes_) {
    if (n->unconverged() > 0)
      warnings.emplace_back(WarningKind::gradient_not_converged, fmt::format("gradients.csv: in {} of {} steps the sensitivities to '{}' did not converge to 1e-6: the end of the "
                                   "step is strongly nonlinear in it, as at a snap-through; a smaller time.step may help", n->unconverged(), steps_, n->name()));
    if (n->jumps() > 0)
      warnings.emplace_back(WarningKind::gradient_jump, fmt::format("gradients.csv: a small change of '{}' causes {} other discrete events (bonds formed or broken, sides switched), which "
                                   "have no derivative and are omitted", n->name(), n->jumps()));
  }
  if (system_.indefinite() > 0)
    warnings.emplace_back(WarningKind::indefinite_hessian, fmt::format("gradients.csv: {} of {} Hessians were not positive definite: steps ended in an unstable equilibrium, or were not solved "
                                 "accurately enough (solver.tolerance)", system_.indefinite(), system_.factors()));
  return warnings;
}

}  // namespace tack
