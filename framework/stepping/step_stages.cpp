#include "framework/stepping/step_stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <new>

#include "framework/config/bind.hpp"
#include "framework/contact/contact_history.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/core/damping_terms.hpp"
#include "framework/load/following_load.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/friction_account.hpp"
#include "framework/world/body_mass.hpp"
#include "framework/world/energy_records.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"

namespace tack {
namespace {

// Throws SimulationError, with the exception that is being handled nested in it.
[[noreturn]] void throw_failed(const State& state, const Minimizer& solver,
                               const std::string& why) {
  const std::string name =
      solver.type().empty() ? "the minimizer" : fmt::format("minimizer '{}'", solver.type());
  std::throw_with_nested(SimulationError(fmt::format("step {} at t = {:.6g} s: {} failed: {}",
                                                     state.step + 1, state.time, name, why)));
}

}  // namespace

StepStages::StepStages(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver, PhaseClock& clock)
    : world_(world), time_(time), solver_(solver), clock_(clock), state_(world.start), balance_(world, solver), integrator_(time.integrator.get()), stage_ends_(integrator_->stages()),
      accelerations_(world, *integrator_, time.step), fixed_(world.prescribed_motion, world.constraints, world.rest), stepper_(instance_of(*time.stepper)) {
  state_.adapts = time.adaptive.has_value();
  const DeadlineSuspension suspension(clock_, time_);
  stepper_->prepare({world, scene, time, solver, clock});
  const bool without_history = state_.a.size() == 0;
  if (without_history) begin_without_history();
  world_.participants.load_history(state_.history);
  if (world_.friction && scene.contact->lagging.iterations == 1 && !world_.records.replaced(*world_.friction))
    impulses_.emplace(*world_.friction, body_masses(world), solver.velocity_tolerance());
  fix_vertices(state_.step_size.h_next > 0 ? state_.step_size.h_next : time.step);
  if (without_history) {
    std::vector<int> free;
    for (int b = 0; b < world_.dofs.block_count(); ++b) free.push_back(world_.dofs.vertex_of_block(b));
    accelerations_.set(state_, state_.time, free, *potential_);
  }
  begin_records();
}

// Begins at a state that no step has computed: erases the history of steps. Accelerations must be set
// afterwards.
void StepStages::begin_without_history() {
  state_.a = VecX::Zero(state_.x.size());
  state_.history.erase(friction_account_name);
  erase_contact_history(state_.history);
  integrator_->forget(state_.history);
  stepper_->erase_history(state_.history);
}

// Begins a step of zero length at the state, so that terms have forces, energies and fields there
// before the first step is opened.
void StepStages::begin_records() {
  const bool inertia = integrator_->inertia();
  const EndVelocity now{1 / time_.step, inertia ? VecX(state_.x - time_.step * state_.v) : state_.x};
  world_.participants.begin_step({state_.x, state_.time, 0, &now, inertia ? &state_.v : nullptr});
}

// Fixes the vertices with prescribed motion in the middle of a step of size h, for all its stages. All other vertices are
// unknowns.
void StepStages::fix_vertices(double h) {
  const bool changed = fixed_.activate(state_, step_start().time + h / 2);
  if (changed) world_.dofs = fixed_.dofs();
  stepper_->begin(changed);
  if (!changed) return;
  ++unknowns_;
  potential_.emplace(world_, clock_);
  if (world_.contact) world_.contact->set_free(fixed_.may_move() ? fixed_.moving() : std::vector<char>());
  accelerations_.set(state_, state_.time, fixed_.released(), *potential_);
  if (!fixed_.released().empty()) integrator_->forget(state_.history);
}

double StepStages::potential_at(const VecX& x) {
  VecX q;
  world_.dofs.gather(x, q);
  potential_->move_to(q);
  return potential_->value() / potential_->scale();
}

// Sets the lagged normal forces of friction. Contact acts on velocities for a time that depends on the
// integrator.
void StepStages::lag_impulses(Step& step, const StepStage& stage) {
  if (!impulses_ || !step.prediction.inertia) return;
  const double given = step.prediction.contact_time;
  impulses_->begin(state_, step.h, given > 0 ? given : step.prediction.contact_scale * integrator_->end_velocity(stage).rate);
  step.impulses = &*impulses_;
}

// Returns whether any term or load needs velocities in a step.
bool StepStages::velocities_matter() const {
  const auto& elastic = world_.elastic_terms;
  const auto& loads = world_.following_loads;
  return !world_.damping_terms.empty() || std::any_of(elastic.begin(), elastic.end(), [](const auto& term) { return !term->stores(); }) ||
         std::any_of(loads.begin(), loads.end(), [](const FollowingLoad* load) { return load->needs_velocities(); });
}

StepStage StepStages::stage(double h) const {
  const double begin = solved_stages_.empty() ? 0 : stage_ends_[solved_stages_.size() - 1];
  return {state_, (stage_end() - begin) * h, step_start(), h, solved_stages_};
}

Step StepStages::open(double h) {
  fix_vertices(h);
  const StepStage stage = this->stage(h);
  Step step{state_, stage.h, integrator_->predict(stage), state_.x, fixed_, *potential_};
  std::optional<EndVelocity> velocity;
  if (velocities_matter()) velocity = integrator_->end_velocity(stage);
  world_.participants.begin_step({state_.x, state_.time, stage.h, velocity ? &*velocity : nullptr, step.prediction.inertia ? &state_.v : nullptr});
  lag_impulses(step, stage);
  fixed_.set_positions(stepper_->load_times(step_start(), step_start().h_before).to + stage_end() * h, step.targets);
  if (accounts_) balance_.begin(state_, step.has_prescribed_motion());
  potential_->begin_step(step.targets, step.prediction.x, step.prediction.scales(), step.prediction.inertia);
  return step;
}

SolveResult StepStages::solve(double h, const VecX* guess) {
  SolveResult result{{}, state_.x};
  clock_.deadline().begin_solve(solver_.time_limit());
  try {
    const Step step = open(h);
    result.x = step.targets;
    stepper_->solve(step, guess, result);
  } catch (const OutOfTime&) {
    result.minimizer.status = MinimizerStatus::time_limit;
  } catch (const Interrupted&) {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const SimulationError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw_failed(state_, solver_, error.what());
  } catch (...) {
    throw_failed(state_, solver_, "it threw what is no std::exception");
  }
  clock_.deadline().end_solve();
  if (result.minimizer.status == MinimizerStatus::time_limit) {
    if (time_.wall_limit && clock_.deadline().run_passed()) result.limit = fmt::format("time.wall_limit: {} s", *time_.wall_limit);
    else if (solver_.time_limit()) result.limit = fmt::format("solver.time_limit: {} s", *solver_.time_limit());
  }
  return result;
}

// Updates velocities and accelerations in the fixed directions of partly fixed vertices as those of
// fixed vertices.
void StepStages::update_fixed_directions(const StepStage& stage, const VecX& x, VecX& v, VecX& a) const {
  if (world_.dofs.partly_fixed_blocks().empty()) return;
  std::vector<int> vertices;
  for (const DofMap::PartlyFixedBlock& block : world_.dofs.partly_fixed_blocks()) vertices.push_back(world_.dofs.vertex_of_block(block.block));
  VecX v_fixed = v, a_fixed = a;
  integrator_->update_fixed(stage, x, vertices, v_fixed, a_fixed);
  for (size_t i = 0; i < vertices.size(); ++i) {
    const Mat3& fixed = world_.dofs.partly_fixed_blocks()[i].projection;
    vertex(v, vertices[i]) += fixed * (vertex(v_fixed, vertices[i]) - vertex(v, vertices[i]));
    vertex(a, vertices[i]) += fixed * (vertex(a_fixed, vertices[i]) - vertex(a, vertices[i]));
  }
}

void StepStages::commit(const VecX& x, double h) {
  StageEnd end{x, {}, {}, accelerations_.by_dynamic_terms(x)};
  const bool last = at_last_stage();
  if (!last && !step_start_) step_start_ = state_;
  const StepStage stage = this->stage(h);
  const double length = stage.h, time = step_start().time + stage_end() * h;
  integrator_->update(stage, x, end.contact, end.v, end.a);
  integrator_->update_fixed(stage, x, fixed_.vertices(), end.v, end.a);
  update_fixed_directions(stage, x, end.v, end.a);
  world_.dofs.update_dependents(end.v);
  world_.dofs.update_dependents(end.a);
  integrator_->store(stage, end, fixed_.vertices(), state_.history);
  if (uses_fallback_integrator()) time_.integrator->forget(state_.history);
  fixed_.commit(state_);
  state_.x_before = std::exchange(state_.x, x);
  state_.v_before = std::exchange(state_.v, end.v);
  state_.a = end.a;
  state_.contact_before = std::exchange(state_.contact, end.contact);
  world_.participants.commit(x, state_.history);
  stepper_->commit(state_.history);
  world_.participants.load_history(state_.history);
  state_.h_before = length;
  state_.contact_time_before = impulses_ ? impulses_->contact_time() : 0;
  if (state_.contact_time_before > 0) state_.history[friction_account_name] = impulses_->history();
  state_.time = time;
  if (!last) return solved_stages_.push_back(std::move(end));
  ++state_.step;
  step_start_.reset();
  solved_stages_.clear();
}

void StepStages::commit_stage(const VecX& x, double h) {
  const DeadlineSuspension suspension(clock_, time_);
  if (accounts_) balance_.end(x);
  commit(x, h);
  if (!accounts_) return;
  const EnergyFlows flows = close_account(energies_by_term(world_, state_));
  if (stage_flows_) *stage_flows_ += flows;
  else stage_flows_ = flows;
}

EnergyFlows StepStages::with_stages(EnergyFlows last) {
  if (stage_flows_) last += *std::exchange(stage_flows_, std::nullopt);
  return last;
}

void StepStages::restore_step_start() {
  if (!step_start_) return;
  const StepSizeState sizes = state_.step_size;
  State start = *std::exchange(step_start_, std::nullopt);
  start.step_size = sizes;
  solved_stages_.clear();
  stage_flows_.reset();
  set_state(std::move(start));
}

void StepStages::commit_solution(const VecX& x, double h) {
  if (accounts_) balance_.end(x);
  commit(x, h);
  if (accounts_) close_account(energies_by_term(world_, state_));
}

void StepStages::set_state(State state) {
  state_ = std::move(state);
  world_.participants.load_history(state_.history);
}

}  // namespace tack
