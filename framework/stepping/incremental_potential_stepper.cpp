// Incremental potential stepper: solves a step as a minimisation of its incremental potential, from
// a feasible start by feasible steps (the paper, eq. 1; Li et al. 2020, Incremental Potential
// Contact). Vertices with a prescribed motion are at their target positions at the end of every
// step: they move there together with the first guess of the others if the path is free, and by
// Dirichlet continuation otherwise (prescribed_motion_follower.hpp).
#include <fmt/format.h>

#include <optional>

#include "framework/contact/contact_system.hpp"
#include "framework/contact/friction_term.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/bent_steps.hpp"
#include "framework/stepping/convergence.hpp"
#include "framework/stepping/feasible_steps.hpp"
#include "framework/stepping/free_bodies.hpp"
#include "framework/stepping/lagged_impulses.hpp"
#include "framework/stepping/predicted_motion.hpp"
#include "framework/stepping/prescribed_motion_follower.hpp"
#include "framework/stepping/stepper.hpp"
#include "framework/stepping/tunnelling_check.hpp"
#include "framework/stepping/time_config.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"

namespace tack {
namespace {

constexpr const char* loosen =
    "refine time.step, loosen solver.tolerance or raise solver.max_iterations (or solver.time_limit)";
constexpr const char* leave_room = "leave room for what the script pushes";

// State of the stepper for one run.
class Minimization {
 public:
  Minimization(const StepperContext& context, const StepObservers& observers);
  void begin(bool new_unknowns);
  void attempt(const Step& step, const VecX* guess, Attempt& attempt);
  Verdict verdict(const Attempt& attempt);

 private:
  VecX first_guess(const Step& step);
  bool start(const Step& step, const VecX* guess, Attempt& attempt, VecX& q);
  void minimize_lagged(const MinimizerProblem& problem, const Step& step, VecX& q, Attempt& attempt);
  std::string failure(const Attempt& attempt) const;
  void look_for_what_is_passed(const VecX& x, Verdict& verdict);

  World& world_;
  const SceneConfig& scene_;
  Minimizer& solver_;
  PhaseClock& clock_;
  const StepObservers& observers_;
  Convergence convergence_;
  std::optional<IterateCheck> check_;
  FeasibleSteps steps_;
  PrescribedMotionFollower follower_;
  std::optional<TunnellingCheck> straight_;
  VecX from_;     // 3n [m]: where the latest step starts
  double h_ = 0;  // s: likewise
  bool free_body_ = false;  // the latest attempt failed as nothing holds a body
};

Minimization::Minimization(const StepperContext& context, const StepObservers& observers)
    : world_(context.world), scene_(context.scene), solver_(context.solver), clock_(context.clock), observers_(observers),
      convergence_(world_, solver_, context.time.step),
      check_(solver_.checks_iterates() ? std::optional<IterateCheck>(std::in_place, world_, clock_) : std::nullopt),
      steps_(world_, clock_, check_ ? &*check_ : nullptr),
      follower_(world_, solver_, clock_, steps_) {
  if (world_.contact) straight_.emplace(world_);
  steps_.observe([this](const VecX& x, const VecX& p, double feasible) {
    if (observers_.steps) observers_.steps(x, p, feasible);
  });
}

void Minimization::begin(bool new_unknowns) {
  steps_.reset();
  if (new_unknowns) {
    follower_.reset();
    convergence_.begin_unknowns();
  }
}

void Minimization::attempt(const Step& step, const VecX* guess, Attempt& attempt) {
  from_ = step.state.x;
  h_ = step.h;
  free_body_ = false;
  if (check_) check_->begin(step.state.step + 1, "the first guess");
  convergence_.begin_step(step.potential, step.h, step.prediction.inertia);
  VecX q;
  if (!start(step, guess, attempt, q) || world_.dofs.size() == 0) return;
  if (check_) check_->begin(step.state.step + 1, "the minimisation");
  MinimizerProblem problem{step.potential,
                           [&](const VecX& from, const VecX& p) { return steps_.largest_tried(step.potential, from, p); },
                           {}, clock_};
  problem.observer = observers_.minimizer;
  problem.true_residuals = observers_.true_residuals;
  convergence_.judge(problem);
  bend_steps(world_, step.potential, problem);
  try {
    minimize_lagged(problem, step, q, attempt);
  } catch (const FreeBody& free) {
    attempt.failure = free.what();
    free_body_ = true;
  }
}

// Finds a feasible q with the prescribed vertices at their target positions; returns false if they
// do not get there.
bool Minimization::start(const Step& step, const VecX* guess, Attempt& attempt, VecX& q) {
  if (guess) {
    world_.dofs.gather(*guess, q);
    return true;
  }
  if (!step.has_prescribed_motion()) {
    q = first_guess(step);
    return true;
  }
  const DirichletContinuation::Result start = follower_.follow(step, check_ ? &*check_ : nullptr, observers_.walk);
  attempt.result = start.solve;
  attempt.failure = start.failure;
  if (!start.failure.empty() || start.solve.status != MinimizerStatus::converged) return false;
  if (check_) check_->at(start.x);
  world_.dofs.gather(start.x, q);
  return true;
}

// Returns the start of the minimisation: the motion with the acceleration of the last step, as far
// as nothing lets go and it is feasible, if that is better than staying at rest.
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
  for (const VecX& way : motion.ways) {
    if (way.isZero()) continue;
    const VecX guess = q + steps_.largest_tried(step.potential, q, way) * way;
    step.potential.move_to(guess);
    if (const double value = step.potential.value(); value < lowest) lowest = value, best = guess;
  }
  return best;
}

// The fixed-point loop of friction: minimise, take normal forces and tangents anew, and so on.
void Minimization::minimize_lagged(const MinimizerProblem& problem, const Step& step, VecX& q, Attempt& attempt) {
  const auto minimize = [&] {
    const MinimizerResult before = attempt.result;
    attempt.result = solver_.minimize(problem, q);
    attempt.result.add_work(before);
    attempt.unbalanced_force = convergence_.balance().unbalanced;
    attempt.tolerated_force = convergence_.balance().tolerated;
    world_.dofs.scatter(q, attempt.x);
    if (check_) check_->at(attempt.x);
  };
  minimize();
  if (!world_.friction) return;
  const LaggingConfig& lagging = scene_.contact->lagging;
  const auto solved = [&]() -> Attempt::Solved {
    if (step.potential.configuration() != attempt.x) step.potential.move_to(q);
    return {attempt.x, step.potential.gradient()};
  };
  for (attempt.lag_iterations = 1;; ++attempt.lag_iterations) {
    if (attempt.result.status != MinimizerStatus::converged) return;
    world_.participants.move_to(attempt.x);
    const ContactPoints now = world_.friction->lagged_at(attempt.x);
    attempt.friction_residual = world_.friction->residual(attempt.x, now);
    attempt.lag_converged = !lagging.until || attempt.friction_residual <= *lagging.until;
    const bool reached = lagging.until && attempt.lag_converged;
    Attempt::Solved before = solved();
    if (step.impulses && step.impulses->settle(now)) {
      attempt.before.push_back(std::move(before));
      minimize();
      continue;
    }
    if (reached || attempt.lag_iterations >= lagging.iterations) return;
    attempt.before.push_back(std::move(before));
    world_.participants.lag(attempt.x);
    minimize();
  }
}

// Why the solve gave nothing to look at, or "".
std::string Minimization::failure(const Attempt& attempt) const {
  if (!attempt.failure.empty()) return attempt.failure + steps_.blocker();
  if (attempt.result.status == MinimizerStatus::converged) return "";
  const bool late = attempt.result.status == MinimizerStatus::time_limit && !clock_.deadline().run_passed();
  const std::string limit = late ? fmt::format(" (solver.time_limit: {} s)", *solver_.time_limit()) : "";
  return fmt::format("{}{} after {} iterations, {:.3g} times the tolerance{}", to_string(attempt.result.status), limit,
                     attempt.result.iterations, attempt.result.residual, steps_.blocker());
}

Verdict Minimization::verdict(const Attempt& attempt) {
  Verdict v{failure(attempt), attempt.failure.empty() ? loosen : free_body_ ? FreeBody::remedy : leave_room};
  if (!v.wrong.empty()) return v;
  const PhaseScope scope(clock_, Phase::check);
  if (const int tet = first_inverted_tet(world_.tets, attempt.x); tet >= 0) {
    v.inverted_tets = 1;
    v.wrong = fmt::format("tet {} inverted", tet);
  } else if (world_.contact) {
    const auto hits = find_intersections(world_.contact->surface().mesh, attempt.x, world_.contact->colliding(), 1);
    v.intersections = static_cast<int>(hits.size());
    if (!hits.empty()) v.wrong = "the surfaces intersect";
    else look_for_what_is_passed(attempt.x, v);
  }
  return v;
}

void Minimization::look_for_what_is_passed(const VecX& x, Verdict& verdict) {
  const auto blocked = straight_->blocked(from_, x);
  if (!blocked) return;
  verdict.wrong = fmt::format(
      "'{}' went around '{}', which is in its way: {:.3g} m or more, at {:.3g} m/s, and the smaller one of them is {:.3g} m long",
      world_.bodies[blocked->body].name, world_.bodies[blocked->obstacle].name, blocked->way, blocked->way / h_, blocked->size);
  verdict.remedy = "take a smaller time.step or a larger time.max_halvings";
  verdict.parts = blocked->parts;
  verdict.tolerable = true;
}

class IncrementalPotentialStepper : public Stepper {
 public:
  void prepare(const StepperContext& context) override { minimization_.emplace(context, observers_); }
  void begin(bool new_unknowns) override { minimization_->begin(new_unknowns); }
  void attempt(const Step& step, const VecX* guess, Attempt& attempt) override {
    minimization_->attempt(step, guess, attempt);
  }
  Verdict verdict(const Attempt& attempt) override { return minimization_->verdict(attempt); }

 private:
  std::optional<Minimization> minimization_;
};

TACK_REGISTER(Stepper, IncrementalPotentialStepper, "incremental_potential",
              "Minimises the incremental potential of the step; accepted states neither intersect nor invert.",
              "Fang et al., eq. 1; Li et al. 2020, Incremental Potential Contact");

}  // namespace
}  // namespace tack
