#include "framework/stepping/step_stages.hpp"

#include <algorithm>

#include "framework/config/bind.hpp"
#include "framework/contact/contact_history.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/core/damping_terms.hpp"
#include "framework/load/following_load.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/friction_account.hpp"
#include "framework/world/energy_records.hpp"

namespace tack {
namespace {

std::vector<double> masses_of_bodies(const World& world) {
  std::vector<double> masses;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    masses.push_back(0);
    for (const int v : world.vertices_of(static_cast<int>(i))) masses.back() += world.mass(v);
  }
  return masses;
}

}  // namespace

StepStages::StepStages(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver, PhaseClock& clock)
    : world_(world), time_(time), solver_(solver), clock_(clock), state_(world.start), balance_(world, solver), integrator_(time.integrator.get()),
      accelerations_(world, *integrator_, time.step), fixed_(world.prescribed_motion, world.constraints, world.rest), stepper_(instance_of(*time.stepper)) {
  state_.adapts = time.adaptive.has_value();
  const DeadlineSuspension suspension(clock_, time_);
  stepper_->prepare({world, scene, time, solver, clock});
  const bool without_history = state_.a.size() == 0;
  if (without_history) begin_without_history();
  world_.participants.load_history(state_.history);
  if (world_.friction && scene.contact->lagging.iterations == 1 && !world_.records.replaced(*world_.friction))
    impulses_.emplace(*world_.friction, masses_of_bodies(world), solver.velocity_tolerance());
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
  stepper_->erase_history(state_.history);
}

// Begins a step of zero length at the state, so that terms have forces, energies and fields there
// before the first step is opened.
void StepStages::begin_records() {
  const bool inertia = integrator_->predict(state_, time_.step).inertia;
  const EndVelocity now{1 / time_.step, inertia ? VecX(state_.x - time_.step * state_.v) : state_.x};
  world_.participants.begin_step({state_.x, state_.time, 0, &now, inertia ? &state_.v : nullptr});
}

// Fixes the vertices with prescribed motion in the middle of a step of size h. All other vertices are
// unknowns.
void StepStages::fix_vertices(double h) {
  const bool changed = fixed_.activate(state_, state_.time + h / 2);
  if (changed) world_.dofs = fixed_.dofs();
  stepper_->begin(changed);
  if (!changed) return;
  ++unknowns_;
  potential_.emplace(world_, clock_);
  if (world_.contact) world_.contact->set_free(fixed_.may_move() ? fixed_.moving() : std::vector<char>());
  accelerations_.set(state_, state_.time, fixed_.released(), *potential_);
}

double StepStages::potential_at(const VecX& x) {
  VecX q;
  world_.dofs.gather(x, q);
  potential_->move_to(q);
  return potential_->value() / potential_->scale();
}

// Sets the lagged normal forces of friction. Contact acts on velocities for a time that depends on the
// integrator.
void StepStages::lag_impulses(Step& step) {
  if (!impulses_ || !step.prediction.inertia) return;
  impulses_->begin(state_, step.h, step.prediction.contact_scale * integrator_->end_velocity(state_, step.h).rate);
  step.impulses = &*impulses_;
}

// Returns whether any term or load needs velocities in a step.
bool StepStages::velocities_matter() const {
  const auto& elastic = world_.elastic_terms;
  const auto& loads = world_.following_loads;
  return !world_.damping_terms.empty() || std::any_of(elastic.begin(), elastic.end(), [](const auto& term) { return !term->stores(); }) ||
         std::any_of(loads.begin(), loads.end(), [](const FollowingLoad* load) { return load->needs_velocities(); });
}

Step StepStages::open(double h) {
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

SolveResult StepStages::solve(double h, const VecX* guess) {
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

// Updates velocities and accelerations in the fixed directions of partly fixed vertices as those of
// fixed vertices.
void StepStages::update_fixed_directions(const VecX& x, double h, VecX& v, VecX& a) const {
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

void StepStages::commit(const VecX& x, double h) {
  VecX v, a, contact = accelerations_.by_dynamic_terms(x);
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

void StepStages::commit_solution(const VecX& x, double h) {
  if (accounts_) balance_.end(x);
  commit(x, h);
  if (accounts_) close_account(energies_by_term(world_, state_), h);
}

void StepStages::set_state(State state) {
  state_ = std::move(state);
  world_.participants.load_history(state_.history);
}

}  // namespace tack
