// Incremental potential stepper: solves a step as a minimisation of its incremental potential, from
// a feasible start by feasible steps (the paper, eq. 1; Li et al. 2020, Incremental Potential
// Contact). Vertices with a prescribed motion are at their target positions at the end of every
// step. They move there along linear trajectories, together with the first guess of the free
// vertices, or by an augmented Lagrangian if these are blocked (prescribed_motion.hpp).
#include <fmt/format.h>

#include <optional>

#include "framework/contact/contact_system.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/core/minimizer_failure.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/step_retraction.hpp"
#include "framework/stepping/convergence.hpp"
#include "framework/stepping/debonding_check.hpp"
#include "framework/stepping/feasible_steps.hpp"
#include "framework/stepping/fixed_vertices.hpp"
#include "framework/stepping/free_bodies.hpp"
#include "framework/world/infinite_energy.hpp"
#include "framework/stepping/lagged_impulses.hpp"
#include "framework/stepping/predicted_motion.hpp"
#include "framework/stepping/prescribed_motion.hpp"
#include "framework/stepping/stepper.hpp"
#include "framework/stepping/tunnelling_check.hpp"
#include "framework/stepping/time_config.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"

namespace tack {
namespace {

constexpr const char* loosen =
    "refine time.step, loosen solver.tolerance or raise solver.max_iterations (or solver.time_limit)";
constexpr const char* blocked_motion_remedy = "leave room for what the prescribed motion pushes";
constexpr const char* limit_remedy = "prescribe a smaller motion, or raise that limit";

// State of the stepper for one run.
class Minimization {
 public:
  Minimization(const StepperContext& context, const StepObservers& observers, const MotionPenalty& penalty);
  void begin(bool new_unknowns);
  void solve(const Step& step, const VecX* guess, SolveResult& result);
  Validation validate(const SolveResult& result);

 private:
  void solve_open(const Step& step, const VecX* guess, SolveResult& result);
  VecX first_guess(const Step& step);
  bool start(const Step& step, const VecX* guess, SolveResult& result, VecX& q);
  void minimize_lagged(const MinimizerProblem& problem, const Step& step, VecX& q, SolveResult& result);
  void find_limit(const Step& step, const VecX& x);
  std::string failure(const SolveResult& result) const;
  const char* remedy(const SolveResult& result) const;
  void check_tunnelling(const VecX& x, Validation& validation);
  void check_debonding(const VecX& x, Validation& validation);

  World& world_;
  const SceneConfig& scene_;
  Minimizer& solver_;
  PhaseClock& clock_;
  const StepObservers& observers_;
  Convergence convergence_;
  std::optional<IterateCheck> check_;
  FeasibleSteps steps_;
  PrescribedMotionSolver motion_;
  std::optional<TunnellingCheck> tunnelling_;
  std::optional<DebondingCheck> debonding_;
  VecX x_start_;  // 3n [m]: start of the latest step
  VecX drift_;    // 3n [m]: displacement with the velocities of the start; empty: none
  double h_ = 0;  // s: size of the latest step
  bool has_free_body_ = false;     // the latest solve failed because a body is free
  bool minimizer_failed_ = false;  // in the latest solve, by an exception
  std::string limit_;  // limit that excludes the positions to which the latest solve leads
};

Minimization::Minimization(const StepperContext& context, const StepObservers& observers, const MotionPenalty& penalty)
    : world_(context.world), scene_(context.scene), solver_(context.solver), clock_(context.clock), observers_(observers),
      convergence_(world_, solver_, context.time.step),
      check_(solver_.checks_iterates() ? std::optional<IterateCheck>(std::in_place, world_, clock_) : std::nullopt),
      steps_(world_, clock_, check_ ? &*check_ : nullptr, solver_.step_filters()),
      motion_(world_, solver_, clock_, steps_, penalty) {
  if (world_.contact) tunnelling_.emplace(world_);
  if (context.time.resolve_debonding) debonding_.emplace(world_);
  steps_.observe([this](const VecX& x, const VecX& p, double feasible) {
    if (observers_.steps) observers_.steps(x, p, feasible);
  });
}

void Minimization::begin(bool new_unknowns) {
  steps_.reset();
  if (new_unknowns) {
    motion_.reset();
    convergence_.begin_unknowns();
  }
}

void Minimization::solve(const Step& step, const VecX* guess, SolveResult& result) {
  x_start_ = step.state.x;
  h_ = step.h;
  if (debonding_ && step.prediction.inertia) drift_ = step.h * step.state.v;
  has_free_body_ = minimizer_failed_ = false;
  limit_.clear();
  try {
    solve_open(step, guess, result);
  } catch (const MinimizerFailure& fault) {
    result.minimizer = fault.work;
    result.failure = fault.what();
    minimizer_failed_ = true;
  }
}

void Minimization::solve_open(const Step& step, const VecX* guess, SolveResult& result) {
  if (check_) check_->begin(step.state.step + 1, "the first guess");
  convergence_.begin_step(step.potential, step.h, step.prediction.inertia);
  VecX q;
  if (!start(step, guess, result, q) || world_.dofs.size() == 0) return;
  if (check_) check_->begin(step.state.step + 1, "the minimisation");
  MinimizerProblem problem{step.potential, {}, {}, clock_};
  steps_.set_feasibility(step.potential, problem);
  problem.observer = observers_.minimizer;
  problem.true_residuals = observers_.true_residuals;
  convergence_.set_criteria(problem);
  set_retraction(world_, step.potential, problem);
  try {
    minimize_lagged(problem, step, q, result);
  } catch (const FreeBody& free) {
    result.failure = free.what();
    has_free_body_ = true;
  }
  if (result.minimizer.status == MinimizerStatus::not_finite) find_limit(step, result.x);
}

// Finds the limit that excludes the free vertices at x together with the targets of the others.
void Minimization::find_limit(const Step& step, const VecX& x) {
  VecX reached = x;
  step.fixed.set_positions(step.state.time + step.h, reached);
  world_.dofs.update_dependents(reached);
  limit_ = describe_infinite_energy(world_, reached);
}

// Finds a feasible q with the prescribed vertices at their target positions. Returns false if they
// do not reach them.
bool Minimization::start(const Step& step, const VecX* guess, SolveResult& result, VecX& q) {
  if (guess) {
    world_.dofs.gather(*guess, q);
    return true;
  }
  if (!step.has_prescribed_motion()) {
    q = first_guess(step);
    return true;
  }
  const PrescribedMotionSolver::Result start = motion_.solve(step, check_ ? &*check_ : nullptr, observers_.motion);
  result.minimizer = start.solve;
  result.failure = start.failure;
  if (!start.failure.empty()) find_limit(step, start.x);
  if (!start.failure.empty() || start.solve.status != MinimizerStatus::converged) return false;
  if (check_) check_->check(start.x);
  world_.dofs.gather(start.x, q);
  return true;
}

// Returns the start of the minimisation: the predicted motion (predicted_motion.hpp), truncated to
// a feasible step, or the present positions if their potential is lower.
VecX Minimization::first_guess(const Step& step) {
  VecX q, p, drift;
  world_.dofs.gather(step.state.x, q);
  if (!step.prediction.inertia) return q;
  world_.dofs.gather(step.h * (step.state.v + step.h * step.state.a), p);
  if (p.isZero()) return q;
  world_.dofs.gather(step.h * step.state.v, drift);
  step.potential.move_to(q);
  double lowest = step.potential.value();
  VecX best = q;
  const PredictedMotion motion = predicted_motion(world_, step.potential.configuration(), VecX::Zero(step.state.x.size()), p, drift);
  for (const VecX& displacement : motion.displacements) {
    if (displacement.isZero()) continue;
    const VecX guess = q + steps_.largest_requested(step.potential, q, displacement) * displacement;
    step.potential.move_to(guess);
    if (const double value = step.potential.value(); value < lowest) lowest = value, best = guess;
  }
  return best;
}

// Runs the fixed-point loop of friction: minimises, updates lagged normal forces and tangents, and
// repeats.
void Minimization::minimize_lagged(const MinimizerProblem& problem, const Step& step, VecX& q, SolveResult& result) {
  const auto minimize = [&] {
    const MinimizerResult before = result.minimizer;
    result.minimizer = solver_.minimize(problem, q);
    result.minimizer.add_work(before);
    result.unbalanced_force = convergence_.force_residual().residual;
    result.tolerated_force = convergence_.force_residual().limit;
    world_.dofs.scatter(q, result.x);
    if (check_) check_->check(result.x);
  };
  minimize();
  if (!world_.friction) {
    if (step.potential.configuration() != result.x) world_.participants.move_to(result.x);
    return;
  }
  const LaggingConfig& lagging = scene_.contact->lagging;
  const auto solved = [&]() -> SolveResult::LaggedSolve {
    if (step.potential.configuration() != result.x) step.potential.move_to(q);
    return {result.x, step.potential.gradient()};
  };
  for (result.lag_iterations = 1;; ++result.lag_iterations) {
    if (result.minimizer.status != MinimizerStatus::converged) return;
    world_.participants.move_to(result.x);
    const ContactPoints now = world_.friction->lagged_at(result.x);
    result.friction_residual = world_.friction->residual(result.x, now);
    result.lag_converged = !lagging.until || result.friction_residual <= *lagging.until;
    const bool reached = lagging.until && result.lag_converged;
    SolveResult::LaggedSolve before = solved();
    if (step.impulses && step.impulses->update_start_up(now)) {
      result.earlier_solves.push_back(std::move(before));
      minimize();
      continue;
    }
    if (reached || result.lag_iterations >= lagging.iterations) return;
    result.earlier_solves.push_back(std::move(before));
    world_.participants.lag(result.x);
    minimize();
  }
}

// Returns the reason why the solve has no result to validate, or "".
std::string Minimization::failure(const SolveResult& result) const {
  const std::string beyond = limit_.empty() ? "" : "; " + limit_;
  if (minimizer_failed_) return result.failure;
  if (!result.failure.empty()) return result.failure + steps_.blocker() + beyond;
  if (result.minimizer.status == MinimizerStatus::converged) return "";
  return fmt::format("{} after {} iterations, {:.3g} times the tolerance{}{}", status_text(result), result.minimizer.iterations, result.minimizer.residual, steps_.blocker(), beyond);
}

const char* Minimization::remedy(const SolveResult& result) const {
  if (minimizer_failed_) return MinimizerFailure::remedy;
  if (!limit_.empty()) return limit_remedy;
  if (result.failure.empty()) return loosen;
  return has_free_body_ ? FreeBody::remedy : blocked_motion_remedy;
}

Validation Minimization::validate(const SolveResult& result) {
  Validation v{failure(result), remedy(result)};
  if (!v.fault.empty()) return v;
  const PhaseScope scope(clock_, Phase::check);
  if (const int tet = first_inverted_tet(world_.tets, result.x); tet >= 0) {
    v.inverted_tets = 1;
    v.reason = Rejection::inversion;
    v.fault = fmt::format("tet {} inverted", tet);
  } else if (world_.contact) {
    const auto hits = find_intersections(world_.contact->surface().mesh, result.x, world_.contact->colliding(), 1);
    v.intersections = static_cast<int>(hits.size());
    if (hits.empty()) check_tunnelling(result.x, v);
    else v.fault = "the surfaces intersect", v.reason = Rejection::intersection;
  }
  if (v.fault.empty() && debonding_) check_debonding(result.x, v);
  return v;
}

void Minimization::check_debonding(const VecX& x, Validation& validation) {
  world_.participants.move_to(x_start_);
  int body = debonding_->find(x_start_, x);
  for (VecX drift = drift_; drift.size() > 0; drift /= 2) {
    const int drifting = debonding_->find(x_start_, x_start_ + drift);
    if (drifting < 0) break;
    body = drifting;
    if (drift != drift_) validation.substeps *= 2;
  }
  world_.participants.move_to(x);
  if (body < 0) return;
  validation.fault = fmt::format("'{}' debonds faster than steps of {:.3g} s resolve", world_.bodies[body].name, h_);
  validation.reason = Rejection::debonding;
  validation.remedy = "take a smaller time.step or a larger time.max_cutbacks";
  validation.tolerable = true;
}

void Minimization::check_tunnelling(const VecX& x, Validation& validation) {
  const auto tunnelling = tunnelling_->find(x_start_, x);
  if (!tunnelling) return;
  validation.fault = fmt::format(
      "'{}' tunnelled through '{}': it moved {:.3g} m or more, at {:.3g} m/s, and the smaller one of them is {:.3g} m long",
      world_.bodies[tunnelling->body].name, world_.bodies[tunnelling->obstacle].name, tunnelling->displacement, tunnelling->displacement / h_, tunnelling->size);
  validation.reason = Rejection::tunnelling;
  validation.remedy = "take a smaller time.step or a larger time.max_cutbacks";
  validation.substeps = tunnelling->substeps;
  validation.tolerable = true;
}

class IncrementalPotentialStepper : public Stepper {
 public:
  void fields(Fields& f) override { f.object("prescribed_motion", penalty_, "how vertices with prescribed motion push what is in their way"); }
  void prepare(const StepperContext& context) override { minimization_.emplace(context, observers_, penalty_); }
  bool resolves_debonding() const override { return true; }
  void begin(bool new_unknowns) override { minimization_->begin(new_unknowns); }
  void solve(const Step& step, const VecX* guess, SolveResult& result) override {
    minimization_->solve(step, guess, result);
  }
  Validation validate(const SolveResult& result) override { return minimization_->validate(result); }

 private:
  MotionPenalty penalty_;
  std::optional<Minimization> minimization_;
};

TACK_REGISTER(Stepper, IncrementalPotentialStepper, "incremental_potential",
              "Minimises the incremental potential of the step; accepted states neither intersect nor invert.",
              "Fang et al., eq. 1; Li et al. 2020, Incremental Potential Contact");

}  // namespace
}  // namespace tack
