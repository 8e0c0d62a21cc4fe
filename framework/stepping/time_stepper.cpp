#include "framework/stepping/time_stepper.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "framework/affine/orthogonality_term.hpp"
#include "framework/contact/friction_term.hpp"
#include "framework/core/damping_terms.hpp"
#include "framework/core/interrupt.hpp"
#include "framework/scene/energy_records.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/obstacle.hpp"
#include "geometry/errors.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"

namespace tack {

TimeStepper::TimeStepper(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver,
                         PhaseClock& clock, std::function<void(const std::string&)> warn)
    : world_(world), scene_(scene), time_(time), solver_(solver), clock_(clock), warn_(std::move(warn)), state_(world.start),
      held_(world.script, world.bindings, world.rest), convergence_(world, solver), balance_(world, solver),
      integrator_(time.integrator.get()),
      follower_(world, solver, clock, held_,
                [this](const VecX& x, const VecX& p) { return largest_step(x, p); },
                [this](const VecX& x, const VecX& p) {
                  tried_ = {x, p};
                  return largest_tried_step();
                }) {
  if (state_.h_next == 0) state_.h_next = time.step;
  clock_.deadline().limit_run(clock.begun(), time.wall_limit);
  world_.participants.remember(state_.history);
  if (solver.checks_iterates()) check_.emplace(world, clock);
  filters_ = attached_filters({world.contact.get(), world.tets, clock});
  tried_.p = VecX::Zero(state_.x.size());
  hold(state_.h_next);
}

// Makes those the unknowns that are free in the step from now to now + h.
void TimeStepper::hold(double h) {
  if (!held_.change(state_, state_.time + h / 2)) return;
  world_.dofs = held_.dofs();
  follower_.reset();
  potential_.emplace(world_.terms, world_.dofs, world_.mass, clock_,
                     [this](const VecX& x) {
                       clock_.deadline().check();
                       world_.participants.move_to(x);
                     });
  if (world_.contact) world_.contact->set_free(held_.may_move() ? held_.moving() : std::vector<char>());
  set_accelerations(state_.time, held_.released());
}

// M^-1 times the forces: what Newmark's step and the first guess of vertices without a past build on.
void TimeStepper::set_accelerations(double t, const std::vector<int>& vertices) {
  if (vertices.empty() || !integrator_->predict(state_, time_.step).inertia) return;
  for (LinearTerm* term : {static_cast<LinearTerm*>(&world_.gravity_term), static_cast<LinearTerm*>(&world_.load_term)})
    term->begin_step({state_.x, t});
  const EndVelocity now{1, state_.x - state_.v};
  for (const auto& term : world_.damping_terms) term->begin_step({state_.x, t, 0, &now});
  VecX q;
  world_.dofs.gather(state_.x, q);
  potential_->begin_step(state_.x, state_.x, {}, false);
  potential_->move_to(q);
  const VecX& gradient = potential_->gradient();
  const VecX mass = world_.dofs.block_masses(world_.mass);
  for (const int v : vertices)
    vertex(state_.a, v) = -gradient.segment<3>(3 * world_.dofs.block(v)) / mass(world_.dofs.block(v));
  world_.dofs.follow(state_.a);
  if (!time_.integrator->follows_contact() || !world_.contact) return;
  const VecX contact = contact_accelerations(state_.x);
  if (state_.contact.size() == 0) state_.contact = VecX::Zero(contact.size());
  for (const int v : vertices) vertex(state_.contact, v) = vertex(contact, v);
  world_.dofs.follow(state_.contact);
}

// Of what moves (3n), at x, where the contact system must be.
VecX TimeStepper::contact_accelerations(const VecX& x) const {
  const DofMap& dofs = world_.dofs;
  VecX force = world_.contact_term->forces(x, LawPart::all);
  if (world_.friction) force += world_.friction->forces(x, TangentialPart::all);
  dofs.collect(force);
  const VecX mass = dofs.block_masses(world_.mass);
  VecX a = VecX::Zero(force.size());
  for (int b = 0; b < dofs.block_count(); ++b) {
    const int v = dofs.vertex_of_block(b);
    vertex(a, v) = vertex(force, v) / mass(b);
  }
  dofs.follow(a);
  return a;
}

double TimeStepper::largest_step(const VecX& x, const VecX& p) {
  if (check_) check_->at(x);
  double t = 1;
  for (const auto& filter : filters_) {
    clock_.deadline().check();
    t = filter->largest_step(x, p, t);
  }
  clock_.deadline().check();
  return t;
}

double TimeStepper::largest_tried_step() {
  const double feasible = largest_step(tried_.x, tried_.p);
  if (step_observer_) step_observer_(tried_.x, tried_.p, feasible);
  return feasible;
}

double TimeStepper::feasible_step(const VecX& q, const VecX& p) {
  tried_.x = potential_->configuration();
  world_.dofs.scatter(q, tried_.x);
  tried_.p.setZero();
  world_.dofs.scatter(p, tried_.p);
  return largest_tried_step();
}

// Where the motion would go with the acceleration of the last step, as far as that is feasible and
// better than staying: minimisers start closer to the solution.
VecX TimeStepper::first_guess(double h) {
  VecX q, p;
  world_.dofs.gather(state_.x, q);
  if (!inertia_) return q;
  world_.dofs.gather(h * (state_.v + h * state_.a), p);
  if (p.isZero()) return q;
  potential_->move_to(q);
  const double staying = potential_->value();
  const VecX guess = q + feasible_step(q, p) * p;
  potential_->move_to(guess);
  return potential_->value() < staying ? guess : q;
}

double TimeStepper::next_step_size() const {
  // The last part ends exactly where the whole step would.
  const double whole = time_.step, left = (state_.whole_steps + 1) * whole - state_.time;
  if (state_.h_next <= left * (1 - 1e-9)) return state_.h_next;
  return state_.h_next >= whole ? whole : left;
}

double TimeStepper::potential_at(const VecX& x) {
  VecX q;
  world_.dofs.gather(x, q);
  potential_->move_to(q);
  return potential_->value() / potential_->scale();
}

Attempt TimeStepper::solve(double h, const VecX* guess) {
  Attempt attempt{{}, state_.x};
  clock_.deadline().begin_solve(solver_.time_limit());
  try {
    attempt_step(h, guess, attempt);
  } catch (const OutOfTime&) {
    attempt.result.status = MinimizerStatus::time_limit;
  }
  clock_.deadline().end_solve();
  return attempt;
}

void TimeStepper::attempt_step(double h, const VecX* guess, Attempt& attempt) {
  tried_.x.resize(0);
  if (check_) check_->begin(state_.step + 1, "the first guess");
  hold(h);
  const TimeIntegrator::Prediction prediction = integrator_->predict(state_, h);
  inertia_ = prediction.inertia;
  std::optional<EndVelocity> velocity;
  if (!world_.damping_terms.empty()) velocity = integrator_->end_velocity(state_, h);
  world_.participants.begin_step({state_.x, state_.time, h, velocity ? &*velocity : nullptr});
  VecX places = state_.x;
  held_.place(state_.time + h, places);
  balance_.begin(state_, places != state_.x);
  potential_->begin_step(places, prediction.x, prediction.scales(), prediction.inertia);
  convergence_.begin_step(*potential_, h, prediction.inertia);
  attempt.x = places;
  VecX q;
  if (guess) {
    world_.dofs.gather(*guess, q);
  } else if (places == state_.x) {
    q = first_guess(h);
  } else {
    const ScriptWalk::Result start =
        follower_.follow(state_, h, prediction, *potential_, check_ ? &*check_ : nullptr, walk_observer_);
    attempt.result = start.solve;
    attempt.failure = start.failure;
    if (!start.failure.empty() || start.solve.status != MinimizerStatus::converged) return;
    if (check_) check_->at(start.x);
    world_.dofs.gather(start.x, q);
  }
  if (world_.dofs.size() == 0) return;
  if (check_) check_->begin(state_.step + 1, "the minimisation");
  MinimizerProblem problem{
      *potential_, [this](const VecX& from, const VecX& p) { return feasible_step(from, p); }, {}, clock_};
  problem.observer = observer_;
  convergence_.judge(problem);
  minimize_lagged(problem, q, attempt);
}

// The fixed-point loop of friction: minimise, take normal forces and tangents anew, and so on.
void TimeStepper::minimize_lagged(const MinimizerProblem& problem, VecX& q, Attempt& attempt) {
  const auto minimize = [&] {
    const MinimizerResult before = attempt.result;
    attempt.result = solver_.minimize(problem, q);
    attempt.result.add_work(before);
    attempt.balance = convergence_.balance();
    world_.dofs.scatter(q, attempt.x);
    if (check_) check_->at(attempt.x);
  };
  minimize();
  if (!world_.friction) return;
  const LaggingConfig& lagging = scene_.contact->lagging;
  for (attempt.lag_iterations = 1;; ++attempt.lag_iterations) {
    if (attempt.result.status != MinimizerStatus::converged) return;
    world_.participants.move_to(attempt.x);
    attempt.friction_residual = world_.friction->residual(attempt.x);
    attempt.lag_converged = !lagging.until || attempt.friction_residual <= *lagging.until;
    const bool reached = lagging.until && attempt.lag_converged;
    if (reached || attempt.lag_iterations >= lagging.iterations) return;
    world_.participants.lag(attempt.x);
    minimize();
  }
}

std::string TimeStepper::verdict(const Attempt& attempt) {
  if (!attempt.failure.empty()) return attempt.failure + blocker();
  if (attempt.result.status != MinimizerStatus::converged) {
    const bool late = attempt.result.status == MinimizerStatus::time_limit && !clock_.deadline().run_passed();
    const std::string limit = late ? fmt::format(" (solver.time_limit: {} s)", *solver_.time_limit()) : "";
    return fmt::format("{}{} after {} iterations, {:.3g} times the tolerance{}", to_string(attempt.result.status),
                       limit, attempt.result.iterations, attempt.result.residual, blocker());
  }
  const PhaseScope scope(clock_, Phase::check);
  if (const int tet = first_inverted_tet(world_.tets, attempt.x); tet >= 0) {
    ++found_.inverted_tets;
    return fmt::format("tet {} inverted", tet);
  }
  if (!world_.contact) return "";
  const auto hits = find_intersections(world_.contact->surface().mesh, attempt.x, world_.contact->colliding(), 1);
  found_.intersections += static_cast<int>(hits.size());
  return hits.empty() ? "" : "the surfaces intersect";
}

// "; ..." about what cut the last step of the latest solve, or "".
std::string TimeStepper::blocker() const {
  if (tried_.x.size() == 0) return "";
  const std::string what = describe_blocker(world_, filters_, tried_.x, tried_.p);
  return what.empty() ? "" : "; the last step was " + what;
}

void TimeStepper::check_wall_limit(const std::string& wrong) const {
  if (!clock_.deadline().run_passed()) return;
  throw SimulationError(fmt::format("step {} at t = {} s: the run's wall time is used up (time.wall_limit: {} s){}",
                                    state_.step + 1, state_.time, *time_.wall_limit,
                                    wrong.empty() ? "" : "; " + wrong));
}

// As of held vertices, in the directions in which vertices are held.
void TimeStepper::update_held_directions(const VecX& x, double h, VecX& v, VecX& a) const {
  if (world_.dofs.held_blocks().empty()) return;
  std::vector<int> vertices;
  for (const DofMap::HeldBlock& held : world_.dofs.held_blocks()) vertices.push_back(world_.dofs.vertex_of_block(held.block));
  VecX v_held = v, a_held = a;
  integrator_->update_held(state_, x, h, vertices, v_held, a_held);
  for (size_t i = 0; i < vertices.size(); ++i) {
    const Mat3& held = world_.dofs.held_blocks()[i].held;
    vertex(v, vertices[i]) += held * (vertex(v_held, vertices[i]) - vertex(v, vertices[i]));
    vertex(a, vertices[i]) += held * (vertex(a_held, vertices[i]) - vertex(a, vertices[i]));
  }
}

void TimeStepper::commit(const VecX& x, double h) {
  VecX v, a, contact;
  if (world_.contact && time_.integrator->follows_contact()) {
    world_.participants.move_to(x);
    contact = contact_accelerations(x);
  }
  integrator_->update(state_, x, contact, h, v, a);
  integrator_->update_held(state_, x, h, held_.vertices(), v, a);
  update_held_directions(x, h, v, a);
  world_.dofs.follow(v);
  world_.dofs.follow(a);
  held_.commit(state_);
  state_.x_before = std::exchange(state_.x, x);
  state_.v_before = std::exchange(state_.v, std::move(v));
  state_.a = std::move(a);
  state_.contact_before = std::exchange(state_.contact, std::move(contact));
  world_.participants.commit(x, state_.history);
  world_.participants.remember(state_.history);
  state_.h_before = h;
  state_.time += h;
  ++state_.step;
}

bool TimeStepper::finished() const {
  return state_.time >= time_.duration - 1e-9 * time_.step;
}

StepReport TimeStepper::report(const Attempt& attempt, double h, int halvings) const {
  StepReport r;
  r.step = state_.step;
  r.time = state_.time;
  r.step_size = h;
  r.halvings = halvings;
  r.solve = attempt.result;
  r.converged = attempt.result.status == MinimizerStatus::converged;
  r.unbalanced_force = attempt.balance.unbalanced;
  r.tolerated_force = attempt.balance.tolerated;
  r.lag_iterations = attempt.lag_iterations;
  r.friction_residual = attempt.friction_residual;
  r.lag_converged = attempt.lag_converged;
  r.min_distance = std::numeric_limits<double>::infinity();
  if (world_.contact) {
    r.contacts = static_cast<int>(world_.contact->contacts().size());
    r.candidates = static_cast<int>(world_.contact->candidates().size());
    r.min_distance = world_.contact->smallest_distance(state_.x);
  }
  r.intersections = found_.intersections;
  r.inverted_tets = found_.inverted_tets;
  r.energies = energies_by_term(world_, state_);
  if (world_.affine) r.affine_strain = world_.affine->largest_strain(state_.x);
  return r;
}

StepReport TimeStepper::advance() {
  const auto started = std::chrono::steady_clock::now();
  const PhaseClock::Seconds before = clock_.seconds();
  const int builds_before = world_.contact ? world_.contact->broad_phase_builds() : 0;
  const double whole = time_.step;
  found_ = {};
  int halvings = 0;
  check_wall_limit("");
  for (;;) {
    const double end = (state_.whole_steps + 1) * whole;
    const double h = next_step_size();
    const Attempt attempt = solve(h);
    if (attempt.result.status == MinimizerStatus::interrupted) {
      interrupted_ = true;
      return {};
    }
    const std::string wrong = verdict(attempt);
    if (wrong.empty()) {
      std::optional<State> undo;
      if (integrator_->fallback()) undo = state_;
      balance_.end(attempt.x);
      commit(attempt.x, h);
      if (state_.time >= end - 1e-9 * whole) {
        ++state_.whole_steps;
        state_.h_next = whole;
      }
      StepReport r = report(attempt, h, halvings);
      r.flows = balance_.close(state_, r.energies, h, held_.may_move(), *potential_);
      if (r.flows.gained && undo) {
        integrator_ = integrator_->fallback();
        state_ = *std::move(undo);
        world_.participants.remember(state_.history);
        continue;
      }
      r.flows.damped = integrator_ != time_.integrator.get();
      integrator_ = time_.integrator.get();
      if (r.flows.gained && !std::exchange(told_of_gain_, true)) warn_(balance_.warning());
      if (r.affine_strain > tolerated_affine_strain && !std::exchange(told_of_strain_, true))
        warn_(fmt::format("step {} at t = {:.6g} s: an affine body is strained by {:.2g}, more than {:g}; raise body.stiffness",
                          state_.step, state_.time, r.affine_strain, tolerated_affine_strain));
      if (!attempt.lag_converged)
        warn_(fmt::format("step {} at t = {:.6g} s: after {} lag iterations tangential forces still change by "
                          "{:.2g} of the largest (contact.lagging.until: {:.2g})",
                          state_.step, state_.time, attempt.lag_iterations, attempt.friction_residual,
                          *scene_.contact->lagging.until));
      if (world_.contact) r.broad_phase_builds = world_.contact->broad_phase_builds() - builds_before;
      const PhaseClock::Seconds& after = clock_.seconds();
      for (int i = 0; i < phase_count; ++i) r.phases[i] = after[i] - before[i];
      r.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
      return r;
    }
    check_wall_limit(wrong);
    if (h < whole * std::pow(0.5, time_.max_halvings) * (1 + 1e-9))
      throw SimulationError(fmt::format(
          "step {} at t = {} s failed with h = {} s ({}); {}", state_.step + 1, state_.time, h, wrong,
          attempt.failure.empty() ? "refine time.step, loosen solver.tolerance or raise solver.max_iterations (or solver.time_limit)"
                                  : "leave room for what the script pushes"));
    state_.h_next = h / 2;
    ++halvings;
    warn_(fmt::format("step {} at t = {:.6g} s: {}; rolled back, h halved to {:.6g} s (1/{} of the step)",
                      state_.step + 1, state_.time, wrong, state_.h_next, std::lround(whole / state_.h_next)));
  }
}

}  // namespace tack
