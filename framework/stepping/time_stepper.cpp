#include "framework/stepping/time_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/scene/scene_config.hpp"
#include "geometry/errors.hpp"

namespace tack {

TimeStepper::TimeStepper(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver, PhaseClock& clock, WarningFunction warn)
    : StepStages(world, scene, time, solver, clock), contact_distance_(scene.contact ? scene.contact->contact_distance : 0),
      sizes_(time, state_, time.adaptive ? abrupt_times(world, time.duration) : std::vector<double>()), reporter_(world, scene, time, clock, std::move(warn)) {
  if (time.adaptive) errors_.emplace(world, time.adaptive->error);
}

void TimeStepper::follow(StepEvents& events) {
  events_ = &events;
  world_.participants.move_to(state_.x);
  events.start(state_);
  world_.participants.load_history(state_.history);
  sizes_.end_at([this](double t) { return std::min(events_->next_stop(t), time_.duration); });
}

StepReport TimeStepper::advance() {
  reporter_.begin();
  sizes_.begin();
  check_wall_limit("");
  if (events_) events_->begin_step(state_.time);
  for (;;) {
    const double h = sizes_.next();
    if (events_) events_->begin_try(h);
    const auto [result, validation] = solve_stages(h);
    interrupted_ = result.minimizer.status == MinimizerStatus::interrupted;
    if (interrupted_) return {};
    if (!validation.fault.empty() && rejects(validation, h)) continue;
    const ErrorRatio error = error_of(result.x, h);
    if (error.ratio > 1 && rejects_error(error)) continue;
    std::optional<State> start;
    const bool for_energy = repeats_for_energy();
    if (for_energy || events_) start = step_start();
    StepReport report = commit_with_report(result, h);
    if (for_energy && (events_ ? rejects_energy(report, *start) : rejects_energy(report, *std::move(start)))) continue;
    if (events_ && repeats_for_event(report, h, *start)) continue;
    sizes_.accept(error);
    if (events_) accept_event();
    end(report, validation, error);
    return report;
  }
}

// Solves a step of size h stage by stage and commits all stages but the last. Returns the solve of the last stage with the work of all, or that of
// the first stage that failed; then the state is again that of the start of the step.
TimeStepper::Attempt TimeStepper::solve_stages(double h) try {
  Attempt all;
  for (;;) {
    Attempt now{solve(h), {}};
    now.result.minimizer.add_work(all.result.minimizer);
    now.result.lag_iterations += all.result.lag_iterations;
    now.result.lag_converged = now.result.lag_converged && all.result.lag_converged;
    const bool interrupted = now.result.minimizer.status == MinimizerStatus::interrupted;
    if (!interrupted) {
      now.validation = validate(now.result);
      reporter_.add(now.validation);
    }
    const bool fault = !now.validation.fault.empty();
    const bool failed = interrupted || (fault && !(now.validation.tolerable && sizes_.at_smallest(now.validation.reason)));
    if (failed) restore_step_start();
    else if (!fault && !all.validation.fault.empty()) now.validation = all.validation;
    if (failed || at_last_stage()) return now;
    commit_stage(now.result.x, h);
    all = std::move(now);
  }
} catch (...) {
  restore_step_start();
  throw;
}

// Rejects a step whose error is too large. Returns false if no smaller step is allowed.
bool TimeStepper::rejects_error(const ErrorRatio& error) {
  if (sizes_.at_smallest(Rejection::error)) return false;
  restore_step_start();
  return sizes_.reject(Rejection::error, sizes_.error_factor(error));
}

// Rejects a faulty result of a step of size h. Returns false if it is accepted, with a warning, because no smaller step is allowed.
bool TimeStepper::rejects(const Validation& validation, double h) {
  check_wall_limit(validation.fault);
  if (!sizes_.reject(validation.reason, 1.0 / validation.substeps)) {
    if (validation.tolerable) return false;
    throw SimulationError(fmt::format("step {} at t = {:.6g} s failed with h = {} s ({}); {}", state_.step + 1, state_.time, h, validation.fault, validation.remedy));
  }
  if (validation.reason == Rejection::debonding) return true;  // asked for
  const double next = state_.step_size.h_next;
  reporter_.warn(WarningKind::step_cutback, state_.step + 1, state_.time,
                 fmt::format("{}; rolled back, h halved to {:.6g} s (1/{} of the step)", validation.fault, next, std::lround(sizes_.whole() / next)));
  return true;
}

// Returns the error of a solved step of size h to x; zero in constant steps.
ErrorRatio TimeStepper::error_of(const VecX& x, double h) const {
  return errors_ ? errors_->measure(integrator_->local_error(stage(h), x, accelerations_.by_dynamic_terms(x))) : ErrorRatio();
}

// Returns whether a step with numerical energy gain or loss is repeated. Its fallback integrator is final.
bool TimeStepper::repeats_for_energy() const {
  if (uses_fallback_integrator()) return false;
  return time_.energy_repeats == EnergyRepeats::always || (time_.energy_repeats == EnergyRepeats::automatic && integrator_->fallback());
}

StepReport TimeStepper::commit_with_report(const SolveResult& result, double h) {
  const DeadlineSuspension suspension(clock_, time_);
  if (solved_) solved_({state_, h, *integrator_, uses_fallback_integrator(), result, *potential_, unknowns_});
  balance_.end(result.x);
  commit(result.x, h);
  StepReport report = reporter_.report(state_, result, h);
  world_.step_metrics = result.metrics;
  report.flows = with_stages(close_account(report.energies));
  return report;
}

// Undoes a committed step with numerical energy gain or loss, to be repeated from `start`: in smaller steps, or, for a gain, with the
// fallback integrator. Smaller steps help without contact, and where the smallest ones resolve the impact: the fastest vertex crosses the
// contact range in at least two of them. Returns false if the step is accepted.
bool TimeStepper::rejects_energy(const StepReport& report, State start) {
  const Rejection reason = report.contacts == 0 ? Rejection::energy_free : Rejection::energy_contact;
  const double fastest = (state_.x - state_.x_before).lpNorm<Eigen::Infinity>();
  const bool finer = !sizes_.at_smallest(reason) && (reason == Rejection::energy_free || 2 * fastest * sizes_.smallest(reason) / state_.h_before <= contact_distance_);
  if (!finer && !(report.flows.gained && integrator_->fallback())) return false;
  if (!report.flows.gained && !report.flows.lost) return false;
  set_state(std::move(start));
  use_fallback_integrator(!finer);
  return sizes_.reject(reason, finer ? 0.5 : 1);
}

// Undoes a committed step of size h that does not end where an event is. Returns false if the step is accepted.
bool TimeStepper::repeats_for_event(StepReport& report, double h, State& start) {
  for (const StepMetric& metric : events_->metrics()) report.metrics.push_back(metric);
  world_.step_metrics = report.metrics;
  const std::optional<double> size = events_->repetition(state_, h);
  if (!size) return false;
  start.step_size = state_.step_size;
  set_state(std::move(start));
  use_fallback_integrator(false);
  sizes_.retry(*size);
  return true;
}

void TimeStepper::accept_event() {
  events_->accept(state_);
  world_.participants.load_history(state_.history);
}

// Completes the report of an accepted step.
void TimeStepper::end(StepReport& report, const Validation& validation, const ErrorRatio& error) {
  if (errors_) report.error = error.length;
  report.rejections = sizes_.rejections();
  report.flows.refined = state_.step_size.h_max > 0 || (report.rejections.of_energy() > 0 && report.step_size < sizes_.whole());
  report.flows.damped = uses_fallback_integrator();
  use_fallback_integrator(false);
  reporter_.end(report, state_, balance_.warning(), impulses_ ? &*impulses_ : nullptr);
  if (!validation.warning.empty()) reporter_.warn(WarningKind::stepper_fault, report.step, report.time, validation.warning);
  if (!validation.fault.empty()) reporter_.warn(WarningKind::tolerated_step, report.step, report.time, validation.fault + "; " + validation.remedy);
}

void TimeStepper::check_wall_limit(const std::string& fault) const {
  if (!clock_.deadline().run_passed()) return;
  throw SimulationError(fmt::format("step {} at t = {:.6g} s: the run's wall time is used up (time.wall_limit: {} s){}", state_.step + 1, state_.time, *time_.wall_limit,
                                    fault.empty() ? "" : "; " + fault));
}

}  // namespace tack
