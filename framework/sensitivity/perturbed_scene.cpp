#include "framework/sensitivity/perturbed_scene.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "framework/config/bind.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/sensitivity/history_jumps.hpp"
#include "framework/sensitivity/scene_parameter.hpp"
#include "framework/stepping/lagged_impulses.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double relative_step = 1e-6;
constexpr double accuracy = 1e-6;             // relative to the displacement from the run's end
constexpr double position_round_off = 1e-15;  // relative
// Relative: smaller residual corrections are not reported.
constexpr double solve_round_off = 1e-13;
// Relative to the change of the gradient by the parameter:
// - rounding_of_forces: rounding errors, which would make unconstrained bodies drift forever
// - unstable_rest: residual that is accepted where it does not decrease, for bodies in unstable
//   equilibrium
constexpr double force_round_off = 1e-6, unstable_residual = 1e-4;
constexpr int correction_max = 12;
constexpr double initial_rate = 0.1;
constexpr double slow_rate = 0.05;  // a slower convergence rate makes a new Hessian worthwhile

// Names in stored states.
const std::string prefix = "gradients/", history_prefix = "history/";
constexpr std::pair<const char*, VecX State::*> vectors[] = {
    {"x", &State::x}, {"v", &State::v}, {"a", &State::a}, {"anchor", &State::x_motion_start}, {"x_before", &State::x_before},
    {"v_before", &State::v_before}, {"contact", &State::contact}, {"contact_before", &State::contact_before}};

double largest(const VecX& v) {
  if (!v.allFinite()) return std::numeric_limits<double>::infinity();
  return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0;
}

}  // namespace

PerturbedScene::PerturbedScene(const BuiltExperiment& run, const GradientConfig& config) : name_(config.name()) {
  const double value = scene_parameter(run, config.key);
  if (value == 0 && !config.step)
    throw InputError(fmt::format("output.gradients: '{}' is zero, so that its increment cannot be relative; give the increment (step)", config.key));
  difference_ = config.step.value_or(relative_step * std::abs(value));
  try {
    built_ = built_with(run, config.key, value + difference_);
  } catch (const InputError&) {  // the parameter is at its upper bound
    difference_ = -difference_;
    built_ = built_with(run, config.key, value + difference_);
  }
  solver_ = instance_of(*built_->experiment().solver);
  probes_.emplace(probes_of(*built_));
  for (const auto& probe : run.experiment().probes) needs_dissipation_ = needs_dissipation_ || probe->needs_dissipation();
}

std::vector<double> PerturbedScene::derivatives(const std::vector<double>& of_run) {
  std::vector<double> derivatives = probes_->sample(built_->world(), stepper_->state());
  for (size_t i = 0; i < derivatives.size(); ++i) derivatives[i] = (derivatives[i] - of_run[i]) / difference_;
  return derivatives;
}

void PerturbedScene::begin() {
  const Experiment& e = built_->experiment();
  World& world = built_->world();
  stepper_.reset();
  world.participants.clear_caches();
  stepper_.emplace(world, e, e.time, *solver_, built_->clock());
  stepper_->keep_account(needs_dissipation_);
  rate_ = 1;
  last_.resize(0), before_.resize(0);
}

void PerturbedScene::start() {
  begin();
  built_->world().participants.move_to(stepper_->state().x);
}

void PerturbedScene::solve(const SolvedStep& step, const VecX& gradient, TangentSystem& system) {
  stepper_->use_fallback_integrator(step.damped);
  unknowns_ = step.unknowns;
  h_ = step.h;
  extrapolate(gradient.size(), system.nearly_singular());
  const Step own = stepper_->open(step.h);
  World& world = built_->world();
  if (world.dofs.size() != gradient.size())
    throw InputError(fmt::format("output.gradients: a small change of '{}' changes which vertices are fixed at t = {:.6g} s", name_, step.start.time));
  // Lagged quantities that the run re-evaluated at the end of a solve are re-evaluated here at the
  // corresponding end.
  bool converged = true;
  for (const SolveResult::LaggedSolve& before : step.result.earlier_solves) {
    system.begin_solve();
    converged = converge(own, before, system) && converged;
    const VecX& x = own.potential.configuration();
    if (own.impulses) own.impulses->update_start_up(world.friction->lagged_at(x));
    else world.participants.lag(x);
  }
  if (!step.result.earlier_solves.empty()) system.begin_solve();
  unconverged_ += !(converge(own, {step.result.x, gradient}, system) && converged);
  end_ = own.potential.configuration();
  if (own.impulses) own.impulses->update_start_up(world.friction->lagged_at(end_));
}

// The displacement of unconstrained bodies is not corrected, and must not diverge.
void PerturbedScene::extrapolate(Eigen::Index unknowns, bool nearly_singular) {
  const bool continues = last_.size() == unknowns && unknowns_ == unknowns_last_, even = h_ == h_last_ && !nearly_singular;
  if (!continues) displacement_ = VecX::Zero(unknowns);
  else if (even && older_.size() == unknowns) displacement_ = 3 * (last_ - before_) + older_;
  else if (even && before_.size() == unknowns) displacement_ = 2 * last_ - before_;
  else displacement_ = last_;
}

// Corrects the displacement; returns false if it did not converge.
bool PerturbedScene::converge(const Step& own, const SolveResult::LaggedSolve& run, TangentSystem& system) {
  VecX end, d;
  built_->world().dofs.gather(run.x, end);
  const VecX extrapolated = displacement_;
  const double noise = position_round_off * largest(end);
  const auto residual = [&](const VecX& displacement) -> VecX {
    own.potential.move_to(end + displacement);
    return run.gradient - own.potential.gradient();
  };
  double last = 0, residual_before = 0;
  VecX before;
  bool converged = false;
  rate_ = std::min(1.0, 1.5 * rate_);
  for (int i = 0; i < correction_max && !converged; ++i) {
    const VecX r = residual(displacement_);
    if (!system.has_factor()) system.refresh(own.potential);
    const double now = r.norm();
    if (i > 0 && system.is_current() && (system.nearly_singular() || now > 0.5 * residual_before)) {
      const double forces = residual(VecX::Zero(end.size())).norm(), least = std::min(now, residual_before);
      converged = least <= force_round_off * forces || (system.nearly_singular() && now > 0.1 * residual_before && least <= unstable_residual * forces);
      if (converged && least < now) displacement_ = before;
      if (converged) break;
    }
    residual_before = now;
    before = displacement_;
    system.solve(r, d);
    displacement_ += d;
    const double size = largest(d), all = largest(displacement_);
    if (last > 0) rate_ = size / last;
    last = size;
    // An accurate guess means that the step met no kink, so that a slightly older Hessian will do.
    converged = size <= noise || size * std::clamp(rate_, i == 0 ? initial_rate : 0.0, 1.0) <= accuracy * all;
    if (!converged && i > 0 && !(rate_ <= slow_rate) && !system.is_current()) {
      residual(displacement_ = extrapolated);
      system.refresh(own.potential);
      rate_ = 1;
      last = 0;
      i = 0;
    }
  }
  // A correction that does not come close is rejected: the displacement stays that of the last
  // step.
  const bool lost = !displacement_.allFinite() || (!converged && last > 0.1 * largest(displacement_));
  if (lost) displacement_ = last_.size() == end.size() ? last_ : VecX::Zero(end.size());
  own.potential.move_to(end + displacement_);
  return converged || last <= solve_round_off * largest(end);
}

void PerturbedScene::accept(const State& run) {
  stepper_->commit_solution(end_, h_);
  const bool continues = h_ == h_last_ && unknowns_ == unknowns_last_;
  older_ = continues ? std::move(before_) : VecX();
  before_ = continues ? std::move(last_) : VecX();
  last_ = displacement_;
  h_last_ = h_;
  unknowns_last_ = unknowns_;
  State state = stepper_->state();
  const int jumps = replace_jumps(run.history, state.history);
  if (jumps == 0) return;
  jumps_ += jumps;
  stepper_->set_state(std::move(state));
}

void PerturbedScene::store(History& history) const {
  const State& s = stepper_->state();
  const std::string own = prefix + name_ + "/";
  for (const auto& [what, field] : vectors) {
    const VecX& v = s.*field;
    history[own + what] = {1, {v.begin(), v.end()}, {}};
  }
  for (const auto& [name, amount] : s.energy.dissipated) history[own + name] = {1, {amount}, {}};
  for (const auto& [name, array] : s.history) history[own + history_prefix + name] = array;
}

void PerturbedScene::start_from(const State& run, const History& history) {
  const std::string own = prefix + name_ + "/";
  State& s = built_->world().start = run;
  s.history.clear();
  for (const auto& [name, array] : history)
    if (name.starts_with(own + history_prefix)) s.history[name.substr(own.size() + history_prefix.size())] = array;
  const auto values_of = [&](const std::string& what) -> const std::vector<double>& {
    const auto found = history.find(own + what);
    if (found == history.end()) throw InputError(fmt::format("the resumed state has no sensitivities to '{}': start again without --resume", name_));
    return found->second.values;
  };
  for (const auto& [what, field] : vectors) {
    const std::vector<double>& values = values_of(what);
    s.*field = VecX::Map(values.data(), static_cast<Eigen::Index>(values.size()));
  }
  // The perturbed scene has its own dissipation, stored only if a probe needs it.
  std::erase_if(s.energy.dissipated, [&](const auto& entry) { return !history.contains(own + entry.first); });
  for (auto& [name, amount] : s.energy.dissipated) amount = values_of(name)[0];
  begin();
}

}  // namespace tack
