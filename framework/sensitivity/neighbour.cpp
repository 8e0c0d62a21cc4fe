#include "framework/sensitivity/neighbour.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "framework/config/bind.hpp"
#include "framework/contact/friction_term.hpp"
#include "framework/sensitivity/history_jumps.hpp"
#include "framework/sensitivity/scene_number.hpp"
#include "framework/stepping/lagged_impulses.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double relative_step = 1e-6;
constexpr double accuracy = 1e-6;     // relative to the displacement from the run's end
constexpr double round_off = 1e-15;   // of positions, relative
// Relative: smaller residual corrections are not reported.
constexpr double rounding_of_solves = 1e-13;
// Relative to the change of the gradient by the number:
// - rounding_of_forces: rounding errors, which would make unconstrained bodies drift forever
// - unstable_rest: residual that is accepted where it does not decrease, for bodies in unstable
//   equilibrium
constexpr double rounding_of_forces = 1e-6, unstable_rest = 1e-4;
constexpr int most_corrections = 12;
constexpr double usual_rate = 0.1;
constexpr double slow = 0.05;         // a slower convergence rate makes a new Hessian worthwhile

// Names in stored states.
const std::string prefix = "gradients/", remembered_as = "history/";
constexpr std::pair<const char*, VecX State::*> vectors[] = {
    {"x", &State::x}, {"v", &State::v}, {"a", &State::a}, {"anchor", &State::anchor}, {"x_before", &State::x_before},
    {"v_before", &State::v_before}, {"contact", &State::contact}, {"contact_before", &State::contact_before}};

double largest(const VecX& v) {
  if (!v.allFinite()) return std::numeric_limits<double>::infinity();
  return v.size() > 0 ? v.lpNorm<Eigen::Infinity>() : 0;
}

}  // namespace

Neighbour::Neighbour(const BuiltExperiment& run, const GradientConfig& config) : name_(config.name()) {
  const double value = scene_number(run, config.key);
  if (value == 0 && !config.step)
    throw InputError(fmt::format("output.gradients: '{}' is zero, so that a millionth of it is nothing; say how much it is changed by (step)", config.key));
  difference_ = config.step.value_or(relative_step * std::abs(value));
  try {
    built_ = built_with(run, config.key, value + difference_);
  } catch (const InputError&) {  // at an upper bound of the number
    difference_ = -difference_;
    built_ = built_with(run, config.key, value + difference_);
  }
  solver_ = instance_of(*built_->experiment().solver);
  probes_.emplace(probes_of(*built_));
  for (const auto& probe : run.experiment().probes) accounts_ = accounts_ || probe->asks_for_losses();
}

std::vector<double> Neighbour::derivatives(const std::vector<double>& of_run) {
  std::vector<double> derivatives = probes_->sample(built_->world(), stepper_->state());
  for (size_t i = 0; i < derivatives.size(); ++i) derivatives[i] = (derivatives[i] - of_run[i]) / difference_;
  return derivatives;
}

void Neighbour::begin() {
  const Experiment& e = built_->experiment();
  World& world = built_->world();
  stepper_.reset();
  world.participants.clear_caches();
  stepper_.emplace(world, e, e.time, *solver_, built_->clock(), [](const Warning&) {});
  stepper_->keep_account(accounts_);
  rate_ = 1;
  last_.resize(0), before_.resize(0);
}

void Neighbour::start() {
  begin();
  if (built_->world().contact) built_->world().contact->move_to(stepper_->state().x);
}

void Neighbour::solve(const SolvedStep& step, const VecX& gradient, TangentSystem& system) {
  stepper_->use_fallback_integrator(step.damped);
  unknowns_ = step.unknowns;
  h_ = step.h;
  guess(gradient.size(), system.loose());
  const Step own = stepper_->open(step.h);
  World& world = built_->world();
  if (world.dofs.size() != gradient.size())
    throw InputError(fmt::format("output.gradients: with a little more of '{}', other vertices are held at t = {:.6g} s", name_, step.start.time));
  // Lagged quantities that the run re-evaluated at the end of a solve are re-evaluated here at the
  // corresponding end.
  bool settled = true;
  for (const SolveResult::LaggedSolve& before : step.result.earlier_solves) {
    system.begin_solve();
    settled = settle(own, before, system) && settled;
    const VecX& x = own.potential.configuration();
    if (own.impulses) own.impulses->settle(world.friction->lagged_at(x));
    else world.participants.lag(x);
  }
  if (!step.result.earlier_solves.empty()) system.begin_solve();
  unsettled_ += !(settle(own, {step.result.x, gradient}, system) && settled);
  end_ = own.potential.configuration();
  if (own.impulses) own.impulses->settle(world.friction->lagged_at(end_));
}

// The displacement of unconstrained bodies is not corrected, and must not diverge.
void Neighbour::guess(Eigen::Index unknowns, bool loose) {
  const bool goes_on = last_.size() == unknowns && unknowns_ == unknowns_last_, even = h_ == h_last_ && !loose;
  if (!goes_on) way_ = VecX::Zero(unknowns);
  else if (even && older_.size() == unknowns) way_ = 3 * (last_ - before_) + older_;
  else if (even && before_.size() == unknowns) way_ = 2 * last_ - before_;
  else way_ = last_;
}

// Corrects the displacement; returns false if it did not converge.
bool Neighbour::settle(const Step& own, const SolveResult::LaggedSolve& run, TangentSystem& system) {
  VecX end, d;
  built_->world().dofs.gather(run.x, end);
  const VecX guessed = way_;
  const double noise = round_off * largest(end);
  const auto left = [&](const VecX& way) -> VecX {
    own.potential.move_to(end + way);
    return run.gradient - own.potential.gradient();
  };
  double last = 0, left_before = 0;
  VecX before;
  bool settled = false;
  rate_ = std::min(1.0, 1.5 * rate_);
  for (int i = 0; i < most_corrections && !settled; ++i) {
    const VecX r = left(way_);
    if (!system.known()) system.refresh(own.potential);
    const double now = r.norm();
    if (i > 0 && system.present() && (system.loose() || now > 0.5 * left_before)) {
      const double forces = left(VecX::Zero(end.size())).norm(), least = std::min(now, left_before);
      settled = least <= rounding_of_forces * forces || (system.loose() && now > 0.1 * left_before && least <= unstable_rest * forces);
      if (settled && least < now) way_ = before;
      if (settled) break;
    }
    left_before = now;
    before = way_;
    system.solve(r, d);
    way_ += d;
    const double size = largest(d), all = largest(way_);
    if (last > 0) rate_ = size / last;
    last = size;
    // An accurate guess means that the step met no kink, so that a slightly older Hessian will do.
    settled = size <= noise || size * std::clamp(rate_, i == 0 ? usual_rate : 0.0, 1.0) <= accuracy * all;
    if (!settled && i > 0 && !(rate_ <= slow) && !system.present()) {
      left(way_ = guessed);
      system.refresh(own.potential);
      rate_ = 1;
      last = 0;
      i = 0;
    }
  }
  // A correction that does not come close is rejected: the displacement stays that of the last
  // step.
  const bool lost = !way_.allFinite() || (!settled && last > 0.1 * largest(way_));
  if (lost) way_ = last_.size() == end.size() ? last_ : VecX::Zero(end.size());
  own.potential.move_to(end + way_);
  return settled || last <= rounding_of_solves * largest(end);
}

void Neighbour::keep(const State& run) {
  stepper_->commit_solution(end_, h_);
  const bool goes_on = h_ == h_last_ && unknowns_ == unknowns_last_;
  older_ = goes_on ? std::move(before_) : VecX();
  before_ = goes_on ? std::move(last_) : VecX();
  last_ = way_;
  h_last_ = h_;
  unknowns_last_ = unknowns_;
  State state = stepper_->state();
  const int jumps = take_jumps_from(run.history, state.history);
  if (jumps == 0) return;
  jumps_ += jumps;
  stepper_->set_state(std::move(state));
}

void Neighbour::store(History& history) const {
  const State& s = stepper_->state();
  const std::string own = prefix + name_ + "/";
  for (const auto& [what, field] : vectors) {
    const VecX& v = s.*field;
    history[own + what] = {1, {v.begin(), v.end()}, {}};
  }
  for (const auto& [name, amount] : s.energy.dissipated) history[own + name] = {1, {amount}, {}};
  for (const auto& [name, array] : s.history) history[own + remembered_as + name] = array;
}

void Neighbour::start_from(const State& run, const History& history) {
  const std::string own = prefix + name_ + "/";
  State& s = built_->world().start = run;
  s.history.clear();
  for (const auto& [name, array] : history)
    if (name.starts_with(own + remembered_as)) s.history[name.substr(own.size() + remembered_as.size())] = array;
  const auto values_of = [&](const std::string& what) -> const std::vector<double>& {
    const auto found = history.find(own + what);
    if (found == history.end()) throw InputError(fmt::format("the state that is gone on from has no derivatives by '{}': start anew without --resume", name_));
    return found->second.values;
  };
  for (const auto& [what, field] : vectors) {
    const std::vector<double>& values = values_of(what);
    s.*field = VecX::Map(values.data(), static_cast<Eigen::Index>(values.size()));
  }
  // Dissipation is the neighbour's own, and is stored only where a probe asks for it.
  std::erase_if(s.energy.dissipated, [&](const auto& entry) { return !history.contains(own + entry.first); });
  for (auto& [name, amount] : s.energy.dissipated) amount = values_of(name)[0];
  begin();
}

}  // namespace tack
