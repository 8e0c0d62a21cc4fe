// Stepper: solves one step of a world. The time loop (time_stepper.hpp) opens a step, has it
// attempted, asks for the verdict, and either keeps the result or rolls back and tries half of the
// step. The integrator derives velocities from positions. The two are independent: the loop does
// not know how a step is solved, by minimisation or otherwise, nor whether results interpenetrate.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/core/history.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/core/step_metric.hpp"
#include "framework/stepping/time_integrator.hpp"

namespace tack {

class FixedVertices;
class LaggedImpulses;
class StepPotential;
struct SceneConfig;
struct TimeConfig;
struct World;

// Context of a stepper for the whole run.
struct StepperContext {
  World& world;
  const SceneConfig& scene;
  const TimeConfig& time;
  Minimizer& solver;
  PhaseClock& clock;
};

// A step that is to be solved. All participants have begun it
// (framework/core/step_participant.hpp), and world.dofs has its unknowns.
struct Step {
  const State& state;  // where it starts
  double h;            // s
  TimeIntegrator::Prediction prediction;
  VecX places;  // 3n [m]: start, with prescribed vertices at their targets
  const FixedVertices& held;
  StepPotential& potential;  // its incremental potential, begun at `places`
  LaggedImpulses* impulses = nullptr;  // of friction, if it lags by a step; may be null

  bool has_prescribed_motion() const { return places != state.x; }  // whether a motion moves vertices
};

// Result of a solve, before it is judged and kept. Steppers leave numbers that they do not have.
struct Attempt {
  MinimizerResult result;  // counts over all lag iterations
  VecX x;                  // 3n [m]; `places` to begin with
  std::string failure = "";  // why prescribed vertices could not be moved
  int lag_iterations = 0;
  // The solves before the last: their end, where lagged forces were updated (3n), and the remaining
  // gradient, in the unknowns.
  struct Solved {
    VecX x, gradient;
  };
  std::vector<Solved> before = {};
  double friction_residual = 0;
  bool lag_converged = true;
  double unbalanced_force = 0, tolerated_force = 0;  // force residual and its limit [N]
  std::vector<StepMetric> metrics = {};  // the stepper's own
};

struct Verdict {
  std::string wrong;   // "" if the attempt may be kept
  std::string remedy;  // what users can do about it
  int intersections = 0, inverted_tets = 0;  // found, for records
  int parts = 2;           // substeps if it is refused; a power of two
  std::string told = "";   // warning about an attempt that may be kept
  bool tolerable = false;  // may be kept at the smallest step size, with a warning
};

// Observers of a solve.
struct StepObservers {
  MinimizerProblem::Observer minimizer, walk;  // every iteration; `walk`: of the continuation
  // Every step from x to x + p (3n) that a minimiser requests, and its feasible fraction.
  std::function<void(const VecX& x, const VecX& p, double feasible)> steps;
  bool true_residuals = false;  // MinimizerProblem::true_residuals
};

class Stepper : public Component {
 public:
  static constexpr const char* kind_name = "stepper";
  static constexpr const char* kind_doc = "Solves a time step.";

  // Throws InputError for a world that it cannot step. Called when a scene is loaded.
  virtual void admit(const World& /*world*/, const SceneConfig& /*scene*/,
                     const TimeConfig& /*time*/) const {}
  // Returns the stepper's own metrics: those of its attempts, or, before the first attempt, zeros.
  virtual std::vector<StepMetric> metrics() const { return {}; }
  // Called once, before all functions below.
  virtual void prepare(const StepperContext& context) = 0;
  // Called before a step is opened. new_unknowns: the unknowns of the world have changed.
  virtual void begin(bool /*new_unknowns*/) {}
  // Solves the step, or says in the attempt that it could not; smaller steps may follow. In a
  // result that may be kept, vertices with prescribed motion are at their target positions, and all
  // participants are at attempt.x (move_to). guess: null, or a start (3n) with those vertices at
  // their target positions, as feasible as the stepper needs it. May throw OutOfTime, for which the
  // loop sets the status of the result, and SimulationError, which ends the run.
  virtual void attempt(const Step& step, const VecX* guess, Attempt& attempt) = 0;
  // Judges an attempt, also one cut short by OutOfTime, but not an interrupted one.
  virtual Verdict verdict(const Attempt& attempt) = 0;
  // Called when the latest attempt is kept: stores history for the next step, other than positions.
  virtual void commit(History& /*history*/) const {}
  // Called when bodies are moved by no step: erases the history that commit() stored.
  virtual void forget(History& /*history*/) const {}

  void observe(StepObservers observers) { observers_ = std::move(observers); }

 protected:
  StepObservers observers_;
};

}  // namespace tack
