// The time loop: predict, minimise, verify exactly, commit or roll back.
// A step whose solve fails, or whose result does not pass the exact check, leaves no trace: the state
// is untouched, h is halved, and the halves run until the step's end is reached.
// Scripted vertices are at their places at the end of every step: they are moved there together with
// the first guess of the others if that is free, and walk there otherwise (script_walk.hpp).
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/incremental_potential.hpp"
#include "framework/core/step_filter.hpp"
#include "framework/scene/world.hpp"
#include "framework/stepping/held_vertices.hpp"
#include "framework/stepping/script_walk.hpp"
#include "framework/stepping/step_report.hpp"

namespace tack {

class TimeStepper {
 public:
  // `warn` gets a line for each failed solve.
  TimeStepper(World& world, const SceneConfig& scene, PhaseClock& clock,
              std::function<void(const std::string&)> warn);

  // One accepted step. Throws SimulationError when no step small enough succeeds.
  StepReport advance();
  bool finished() const;
  bool interrupted() const { return interrupted_; }
  const State& state() const { return state_; }

 private:
  struct Attempt {
    MinimizerResult result;  // counts over all lag iterations
    VecX x;
    std::string failure = "";  // why the scripted vertices could not be moved
    int lag_iterations = 0;
    double friction_residual = 0;
    bool lag_converged = true;
  };
  Attempt solve(double h);
  void minimize_lagged(const MinimizerProblem& problem, VecX& q, Attempt& attempt);
  void hold(double h);
  void set_accelerations(double t, const std::vector<int>& vertices);
  VecX first_guess(double h);
  ScriptWalk::Result follow_script(double h, const VecX& places,
                                   const TimeIntegrator::Prediction& prediction);
  std::string verdict(const Attempt& attempt);  // "" if the attempt may be kept
  void commit(const VecX& x, double h);
  void apply_loads(double t);
  double largest_step(const VecX& x, const VecX& p);
  double feasible_step(const VecX& q, const VecX& p);
  Stopping stopping() const;
  double stopping_norm(double h, const VecX& p, const VecX& gradient) const;
  StepReport report(const Attempt& attempt, double h, int halvings) const;

  World& world_;
  const SceneConfig& scene_;
  PhaseClock& clock_;
  std::function<void(const std::string&)> warn_;
  State state_;
  HeldVertices held_;
  std::optional<IncrementalPotential> potential_;
  std::optional<ScriptWalk> walk_;  // made when it is first needed
  std::vector<std::unique_ptr<StepFilter>> filters_;
  VecX direction_;  // scratch, 3n
  bool inertia_ = true;
  int slots_done_ = 0;  // whole steps of the scene's size behind us
  double h_ = 0;        // size tried next
  struct Found {
    int intersections = 0, inverted_tets = 0;
  } found_;  // by the exact check, in the solves of the present step
  bool interrupted_ = false;
};

}  // namespace tack
