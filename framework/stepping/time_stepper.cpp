#include "framework/stepping/time_stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "framework/affine/orthogonality_term.hpp"
#include "framework/config/bind.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/core/damping_terms.hpp"
#include "framework/load/following_load.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/time_config.hpp"
#include "framework/world/energy_records.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr int max_refinements = 3;  // halvings of a step with numerical energy gain or loss

// Suspends the wall time limit during its lifetime, so that a step is begun and accepted as a whole.
class DeadlineSuspension {
 public:
  DeadlineSuspension(PhaseClock& clock, const TimeConfig& time) : clock_(clock), time_(time) { clock_.deadline().limit_run(clock_.begun(), std::nullopt); }
  ~DeadlineSuspension() { clock_.deadline().limit_run(clock_.begun(), time_.wall_limit); }
  DeadlineSuspension(const DeadlineSuspension&) = delete;
  DeadlineSuspension& operator=(const DeadlineSuspension&) = delete;

 private:
  PhaseClock& clock_;
  const TimeConfig& time_;
};

std::vector<double> masses_of_bodies(const World& world) {
  std::vector<double> masses;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    masses.push_back(0);
    for (const int v : world.vertices_of(static_cast<int>(i))) masses.back() += world.mass(v);
  }
  return masses;
}

}  // namespace

TimeStepper::TimeStepper(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver,
                         PhaseClock& clock, WarningFunction warn)
    : world_(world), scene_(scene), time_(time), solver_(solver), clock_(clock), warn_(std::move(warn)), state_(world.start),
      fixed_(world.prescribed_motion, world.constraints, world.rest), balance_(world, solver), integrator_(time.integrator.get()),
      stepper_(instance_of(*time.stepper)) {
  if (state_.h_next == 0) state_.h_next = time.step;
  refined_ = state_.substeps > 1 || state_.h_max > 0;
  state_.adapts = time.adaptive.has_value();
  if (time.adaptive) control_.emplace(world, time);
  if (time.integrator->follows_contact())
    std::copy_if(world.terms.begin(), world.terms.end(), std::back_inserter(dynamic_terms_), [](const Term* term) { return term->dynamic(); });
  const DeadlineSuspension suspension(clock_, time_);
  stepper_->prepare({world, scene, time, solver, clock});
  const bool without_history = state_.a.size() == 0;
  if (without_history) begin_without_history();
  world_.participants.load_history(state_.history);
  if (world.friction && scene.contact->lagging.iterations == 1 && !world.records.replaced(*world.friction))
    impulses_.emplace(*world.friction, masses_of_bodies(world), solver.velocity_tolerance());
  fix_vertices(state_.h_next);
  if (without_history) {
    std::vector<int> free;
    for (int b = 0; b < world_.dofs.block_count(); ++b) free.push_back(world_.dofs.vertex_of_block(b));
    set_accelerations(state_.time, free);
  }
  begin_records();
}

// Begins a step of zero length at the state, so that terms have forces, energies and fields there
// before the first step is opened.
void TimeStepper::begin_records() {
  const bool inertia = integrator_->predict(state_, time_.step).inertia;
  const EndVelocity now{1 / time_.step, inertia ? VecX(state_.x - time_.step * state_.v) : state_.x};
  world_.participants.begin_step({state_.x, state_.time, 0, &now, inertia ? &state_.v : nullptr});
}

// Fixes the vertices with prescribed motion in the middle of a step of size h. All other vertices are
// unknowns.
void TimeStepper::fix_vertices(double h) {
  const bool changed = fixed_.activate(state_, state_.time + h / 2);
  if (changed) world_.dofs = fixed_.dofs();
  stepper_->begin(changed);
  if (!changed) return;
  ++unknowns_;
  potential_.emplace(world_, clock_);
  if (world_.contact) world_.contact->set_free(fixed_.may_move() ? fixed_.moving() : std::vector<char>());
  set_accelerations(state_.time, fixed_.released());
}

double TimeStepper::next_step_size() const {
  if (control_) return control_->size(state_);
  // The last substep ends exactly at the end of the whole step.
  const double step = time_.step, left = (state_.whole_steps + 1) * step - state_.time;
  if (state_.h_next <= left * (1 - 1e-9)) return state_.h_next;
  return state_.h_next >= step ? step : left;
}

double TimeStepper::potential_at(const VecX& x) {
  VecX q;
  world_.dofs.gather(x, q);
  potential_->move_to(q);
  return potential_->value() / potential_->scale();
}

// Sets the lagged normal forces of friction. Contact acts on velocities for a time that depends on the
// integrator.
void TimeStepper::lag_impulses(Step& step) {
  if (!impulses_ || !step.prediction.inertia) return;
  impulses_->begin(state_, step.h, step.prediction.contact_scale * integrator_->end_velocity(state_, step.h).rate);
  step.impulses = &*impulses_;
}

// Returns whether any term or load needs velocities in a step.
bool TimeStepper::velocities_matter() const {
  const auto& elastic = world_.elastic_terms;
  const auto& loads = world_.following_loads;
  return !world_.damping_terms.empty() || std::any_of(elastic.begin(), elastic.end(), [](const auto& term) { return !term->stores(); }) ||
         std::any_of(loads.begin(), loads.end(), [](const FollowingLoad* load) { return load->needs_velocities(); });
}

Step TimeStepper::open(double h) {
  fix_vertices(h);
  Step step{state_, h, integrator_->predict(state_, h), state_.x, fixed_, *potential_};
  std::optional<EndVelocity> velocity;
  if (velocities_matter()) velocity = integrator_->end_velocity(state_, h);
  world_.participants.begin_step({state_.x, state_.time, h, velocity ? &*velocity : nullptr, step.prediction.inertia ? &state_.v : nullptr});
  lag_impulses(step);
  fixed_.set_positions(state_.time + h, step.targets);
  if (accounts_) balance_.begin(state_, step.has_prescribed_motion());
  potential_->begin_step(step.targets, step.prediction.x, step.prediction.scales(), step.prediction.inertia);
  return step;
}

SolveResult TimeStepper::solve(double h, const VecX* guess) {
  SolveResult result{{}, state_.x};
  clock_.deadline().begin_solve(solver_.time_limit());
  try {
    const Step step = open(h);
    result.x = step.targets;
    stepper_->solve(step, guess, result);
  } catch (const OutOfTime&) {
    result.minimizer.status = MinimizerStatus::time_limit;
  }
  clock_.deadline().end_solve();
  return result;
}

Validation TimeStepper::validate(const SolveResult& result) {
  Validation validation = stepper_->validate(result);
  counts_.intersections += validation.intersections;
  counts_.inverted_tets += validation.inverted_tets;
  return validation;
}

std::string TimeStepper::fault(const SolveResult& result) {
  const Validation validation = validate(result);
  return validation.tolerable ? "" : validation.fault;
}

void TimeStepper::check_wall_limit(const std::string& fault) const {
  if (!clock_.deadline().run_passed()) return;
  throw SimulationError(fmt::format("step {} at t = {} s: the run's wall time is used up (time.wall_limit: {} s){}",
                                    state_.step + 1, state_.time, *time_.wall_limit,
                                    fault.empty() ? "" : "; " + fault));
}

// Updates velocities and accelerations in the fixed directions of partly fixed vertices as those of
// fixed vertices.
void TimeStepper::update_fixed_directions(const VecX& x, double h, VecX& v, VecX& a) const {
  if (world_.dofs.partly_fixed_blocks().empty()) return;
  std::vector<int> vertices;
  for (const DofMap::PartlyFixedBlock& block : world_.dofs.partly_fixed_blocks()) vertices.push_back(world_.dofs.vertex_of_block(block.block));
  VecX v_fixed = v, a_fixed = a;
  integrator_->update_fixed(state_, x, h, vertices, v_fixed, a_fixed);
  for (size_t i = 0; i < vertices.size(); ++i) {
    const Mat3& fixed = world_.dofs.partly_fixed_blocks()[i].projection;
    vertex(v, vertices[i]) += fixed * (vertex(v_fixed, vertices[i]) - vertex(v, vertices[i]));
    vertex(a, vertices[i]) += fixed * (vertex(a_fixed, vertices[i]) - vertex(a, vertices[i]));
  }
}

void TimeStepper::commit(const VecX& x, double h) {
  VecX v, a, contact;
  if (!dynamic_terms_.empty()) {
    world_.participants.move_to(x);
    contact = dynamic_accelerations(x);
  }
  integrator_->update(state_, x, contact, h, v, a);
  integrator_->update_fixed(state_, x, h, fixed_.vertices(), v, a);
  update_fixed_directions(x, h, v, a);
  world_.dofs.update_dependents(v);
  world_.dofs.update_dependents(a);
  fixed_.commit(state_);
  state_.x_before = std::exchange(state_.x, x);
  state_.v_before = std::exchange(state_.v, std::move(v));
  state_.a = std::move(a);
  state_.contact_before = std::exchange(state_.contact, std::move(contact));
  world_.participants.commit(x, state_.history);
  stepper_->commit(state_.history);
  world_.participants.load_history(state_.history);
  state_.h_before = h;
  state_.contact_time_before = impulses_ ? impulses_->contact_time() : 0;
  if (state_.contact_time_before > 0) state_.history[friction_account_name] = impulses_->history();
  state_.time += h;
  ++state_.step;
}

void TimeStepper::commit_solution(const VecX& x, double h) {
  if (accounts_) balance_.end(x);
  commit(x, h);
  if (accounts_) balance_.close(state_, energies_by_term(world_, state_), h, fixed_.may_move(), *potential_);
}

void TimeStepper::set_state(State state) {
  state_ = std::move(state);
  world_.participants.load_history(state_.history);
}

bool TimeStepper::finished() const {
  return state_.time >= time_.duration - 1e-9 * time_.step;
}

// Commits a result. Returns false if it was undone because of numerical energy gain or loss, to be
// repeated with smaller steps or the fallback integrator.
bool TimeStepper::accept(const SolveResult& result, double h, StepReport& r) {
  const DeadlineSuspension suspension(clock_, time_);
  const double end = (state_.whole_steps + 1) * time_.step;
  std::optional<State> undo;
  if (integrator_->fallback()) undo = state_;
  balance_.end(result.x);
  commit(result.x, h);
  if (control_) {
    control_->accepted(state_, h);
  } else if (state_.time >= end - 1e-9 * time_.step) {
    ++state_.whole_steps;
    if (state_.substeps > 1 && ++state_.steady_steps >= steady_steps_min) {
      state_.substeps /= 2;
      state_.steady_steps = 0;
    }
    state_.h_next = time_.step / state_.substeps;
  }
  r = report(result, h);
  world_.step_metrics = result.metrics;
  r.flows = balance_.close(state_, r.energies, h, fixed_.may_move(), *potential_);
  const bool free = r.contacts == 0;
  const bool finer = h > smallest_refined() * (1 + 1e-9) && (free || resolves_impact(h));
  if (undo && (r.flows.gained || (finer && balance_.lost()))) {
    state_ = *std::move(undo);
    world_.participants.load_history(state_.history);
    if (finer) request_refinement(h, free);
    else integrator_ = integrator_->fallback();
    return false;
  }
  r.flows.refined = refined_;
  r.flows.damped = integrator_ != time_.integrator.get();
  integrator_ = time_.integrator.get();
  if (control_ ? state_.h_max == 0 : state_.substeps == 1 && state_.h_next == time_.step) refined_ = false;
  return true;
}

// Returns the smallest size of steps that are refined to conserve energy [s].
double TimeStepper::smallest_refined() const { return time_.step * std::pow(0.5, std::min(max_refinements, time_.max_cutbacks)); }

// Returns whether the smallest steps resolve the impact in the present step of size h: the fastest
// vertex crosses the contact range in at least two of them. Otherwise smaller steps would not help.
bool TimeStepper::resolves_impact(double h) const {
  return 2 * (state_.x - state_.x_before).lpNorm<Eigen::Infinity>() * smallest_refined() / h <= scene_.contact->contact_distance;
}

// Requests smaller steps after one of size h that gained or lost energy numerically. An impact passes.
// A rotation that is too fast for the step lasts: then the following steps are smaller too.
void TimeStepper::request_refinement(double h, bool lasting) {
  state_.h_next = h / 2;
  refined_ = true;
  if (control_) return control_->refined(state_, h, lasting);
  if (!lasting) return;
  state_.substeps = std::max(state_.substeps, static_cast<int>(std::lround(time_.step / state_.h_next)));
  state_.steady_steps = 0;
}

// Returns the size of the step that substeps divide [s].
double TimeStepper::whole_step() const { return control_ ? first_size_ : time_.step; }

double TimeStepper::smallest_size() const {
  return (control_ ? std::max(first_size_, time_.smallest_step()) : time_.step) * std::pow(0.5, time_.max_cutbacks);
}

// Returns whether a faulty result is accepted with a warning, because no smaller steps are tried.
bool TimeStepper::tolerates(double h, const Validation& validation) const { return validation.tolerable && h < smallest_size() * (1 + 1e-9); }

// Rejects a result of size h and requests a smaller step.
void TimeStepper::reject(double h, const Validation& validation) {
  if (h < smallest_size() * (1 + 1e-9))
    throw SimulationError(fmt::format("step {} at t = {} s failed with h = {} s ({}); {}", state_.step + 1, state_.time, h,
                                      validation.fault, validation.remedy));
  state_.h_next = h / 2;
  for (int substeps = 4; substeps <= validation.substeps && state_.h_next > smallest_size() * (1 + 1e-9); substeps *= 2) state_.h_next /= 2;
  ++cutbacks_;
  if (control_) control_->refined(state_, h, false);
  warn_({WarningKind::step_cutback, fmt::format("step {} at t = {:.6g} s: {}; rolled back, h halved to {:.6g} s (1/{} of the step)", state_.step + 1,
                     state_.time, validation.fault, state_.h_next, std::lround(whole_step() / state_.h_next))});
}

// Returns whether a result of size h is rejected because of its error.
bool TimeStepper::rejects_error(const SolveResult& result, double h) {
  if (!control_) return false;
  VecX contact;
  if (!dynamic_terms_.empty()) {
    world_.participants.move_to(result.x);
    contact = dynamic_accelerations(result.x);
  }
  error_ = control_->measure(*integrator_, state_, result.x, contact, h);
  if (!control_->repeats(state_, h)) return false;
  ++repeats_;
  first_size_ = state_.h_next;
  return true;
}

StepReport TimeStepper::advance() {
  const auto started = std::chrono::steady_clock::now();
  const PhaseClock::Seconds before = clock_.seconds();
  const int builds_before = world_.contact ? world_.contact->broad_phase_builds() : 0;
  counts_ = {};
  cutbacks_ = repeats_ = 0;
  first_size_ = next_step_size();
  check_wall_limit("");
  StepReport r;
  for (;;) {
    const double h = next_step_size();
    const SolveResult result = solve(h);
    if (result.minimizer.status == MinimizerStatus::interrupted) {
      interrupted_ = true;
      return {};
    }
    const Validation validation = validate(result);
    const bool tolerated = tolerates(h, validation);
    if (!validation.fault.empty() && !tolerated) {
      check_wall_limit(validation.fault);
      reject(h, validation);
      continue;
    }
    if (rejects_error(result, h)) continue;
    if (solved_) {
      const DeadlineSuspension suspension(clock_, time_);
      solved_({state_, h, *integrator_, integrator_ != time_.integrator.get(), result, *potential_, unknowns_});
    }
    if (accept(result, h, r)) {
      warn_of(result, r);
      if (!validation.warning.empty()) warn_({WarningKind::stepper_fault, fmt::format("step {} at t = {:.6g} s: {}", state_.step, state_.time, validation.warning)});
      if (tolerated)
        warn_({WarningKind::tolerated_step, fmt::format("step {} at t = {:.6g} s: {}; {}", state_.step, state_.time, validation.fault, validation.remedy)});
      break;
    }
  }
  if (world_.contact) r.broad_phase_builds = world_.contact->broad_phase_builds() - builds_before;
  const PhaseClock::Seconds& after = clock_.seconds();
  for (int i = 0; i < phase_count; ++i) r.phases[i] = after[i] - before[i];
  r.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return r;
}

}  // namespace tack
