// The time loop: predict, minimise, verify exactly, commit or roll back.
// A step whose solve fails, or whose result does not pass the exact check, leaves no trace: the state
// is untouched, h is halved, and the halves run until the step's end is reached.
// Scripted vertices are at their places at the end of every step: they are moved there together with
// the first guess of the others if that is free, and walk there otherwise (script_follower.hpp).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/core/step_filter.hpp"
#include "framework/scene/world.hpp"
#include "framework/stepping/convergence.hpp"
#include "framework/stepping/energy_balance.hpp"
#include "framework/stepping/held_vertices.hpp"
#include "framework/stepping/iterate_check.hpp"
#include "framework/stepping/script_follower.hpp"
#include "framework/stepping/step_report.hpp"
#include "framework/stepping/time_config.hpp"

namespace tack {

// The result of one solve, before it is verified and kept.
struct Attempt {
  MinimizerResult result;  // counts over all lag iterations
  VecX x;                  // 3n [m]
  std::string failure = "";  // why the scripted vertices could not be moved
  int lag_iterations = 0;
  double friction_residual = 0;
  bool lag_converged = true;
  Convergence::Balance balance = {};
};

struct SceneConfig;

class TimeStepper {
 public:
  // Goes on from world.start. `warn` gets a line for each failed solve.
  TimeStepper(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver, PhaseClock& clock,
              std::function<void(const std::string&)> warn);

  // One accepted step. Throws SimulationError when no step small enough succeeds.
  StepReport advance();
  bool finished() const;
  bool interrupted() const { return interrupted_; }
  const State& state() const { return state_; }
  double next_step_size() const;  // that advance() tries first [s]

  // The parts of advance(), for those who study single steps. The minimisation of the step from now to
  // now + h; `guess`: its start (3n), feasible and with the scripted vertices at their places.
  Attempt solve(double h, const VecX* guess = nullptr);
  std::string verdict(const Attempt& attempt);  // "" if the attempt may be kept
  void commit(const VecX& x, double h);
  // The incremental potential of the latest solve over beta h^2, at x (3n) [J].
  double potential_at(const VecX& x);
  // Is told of every iteration of the minimisers; `walk`: of those that walk scripted vertices.
  void observe(MinimizerProblem::Observer observer, MinimizerProblem::Observer walk = {}) {
    observer_ = std::move(observer);
    walk_observer_ = std::move(walk);
  }
  // Is told of every step from x to x + p (3n) that a minimiser wants to take, and the part of it that is feasible.
  using StepObserver = std::function<void(const VecX& x, const VecX& p, double feasible)>;
  void observe_steps(StepObserver observer) { step_observer_ = std::move(observer); }

 private:
  void attempt_step(double h, const VecX* guess, Attempt& attempt);
  std::string blocker() const;
  void check_wall_limit(const std::string& wrong) const;
  void minimize_lagged(const MinimizerProblem& problem, VecX& q, Attempt& attempt);
  void hold(double h);
  void set_accelerations(double t, const std::vector<int>& vertices);
  VecX first_guess(double h);
  VecX contact_accelerations(const VecX& x) const;
  void update_held_directions(const VecX& x, double h, VecX& v, VecX& a) const;
  double largest_step(const VecX& x, const VecX& p);
  double largest_tried_step();
  double feasible_step(const VecX& q, const VecX& p);
  StepReport report(const Attempt& attempt, double h, int halvings) const;

  World& world_;
  const SceneConfig& scene_;
  const TimeConfig& time_;
  Minimizer& solver_;
  PhaseClock& clock_;
  std::function<void(const std::string&)> warn_;
  State state_;
  HeldVertices held_;
  Convergence convergence_;
  EnergyBalance balance_;
  const TimeIntegrator* integrator_;  // the scene's, or its fallback while a step is repeated
  bool told_of_gain_ = false, told_of_strain_ = false;
  std::optional<IncrementalPotential> potential_;
  ScriptFollower follower_;
  std::vector<std::unique_ptr<StepFilter>> filters_;
  struct Tried {
    VecX x, p;  // 3n
  } tried_;     // the last step that a minimiser wanted to take
  std::optional<IterateCheck> check_;
  bool inertia_ = true;
  MinimizerProblem::Observer observer_, walk_observer_;
  StepObserver step_observer_;
  struct Found {
    int intersections = 0, inverted_tets = 0;
  } found_;  // by the exact check, in the solves of the present step
  bool interrupted_ = false;
};

}  // namespace tack
