// Stepper: solves one step of a world. The time loop (time_stepper.hpp) opens a step, has it solved
// and validated, and either accepts the result or rolls back and solves substeps. The integrator
// derives velocities from positions. Loop and stepper are independent: the loop does not know how a
// step is solved, by minimisation or otherwise, nor whether results interpenetrate.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/core/history.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/core/step_metric.hpp"
#include "framework/stepping/rejection.hpp"
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

// A step to be solved. All participants have begun it (framework/core/step_participant.hpp), and
// world.dofs has its unknowns.
struct Step {
  const State& state;  // at the start of the step
  double h;            // s
  TimeIntegrator::Prediction prediction;
  VecX targets;  // 3n [m]: positions at the start, with prescribed vertices at their targets
  const FixedVertices& fixed;
  StepPotential& potential;            // incremental potential, begun at `targets`
  LaggedImpulses* impulses = nullptr;  // of friction that lags by a step; null otherwise

  // Returns whether a prescribed motion moves vertices in the step.
  bool has_prescribed_motion() const { return targets != state.x; }
};

// Result of a solve, before it is validated and accepted. A stepper leaves fields that it does not
// compute.
struct SolveResult {
  MinimizerResult minimizer;  // summed over all lag iterations
  VecX x;                     // 3n [m]; initially Step::targets
  std::string failure = "";   // why prescribed vertices did not reach their targets
  std::string limit = "";     // of wall time that ended the solve: "solver.time_limit: 5 s"
  int lag_iterations = 0;
  // Solution of an earlier lag iteration, where lagged forces were updated.
  struct LaggedSolve {
    VecX x;         // 3n
    VecX gradient;  // remaining gradient by the unknowns
  };
  std::vector<LaggedSolve> earlier_solves = {};
  double friction_residual = 0;
  bool lag_converged = true;
  double unbalanced_force = 0, tolerated_force = 0;  // force residual and its limit [N]
  std::vector<StepMetric> metrics = {};              // step metrics of the stepper
};

// Returns how the minimisation ended: "out of wall time (solver.time_limit: 5 s)".
inline std::string status_text(const SolveResult& result) {
  return std::string(to_string(result.minimizer.status)) +
         (result.limit.empty() ? "" : " (" + result.limit + ")");
}

// Validation of a solve result.
struct Validation {
  std::string fault;                    // reason to reject the result; "" if it may be accepted
  std::string remedy;                   // advice to users against the fault
  Rejection reason = Rejection::solve;  // of the fault
  int intersections = 0, inverted_tets = 0;  // counts found, for records
  int substeps = 2;                          // number of substeps after a rejection; a power of two
  std::string warning = "";                  // about a result that may be accepted
  bool tolerable = false;  // the result may be accepted at the smallest step size, with a warning
};

// Observers of a solve.
struct StepObservers {
  MinimizerProblem::Observer minimizer;  // every iteration of the minimisation
  MinimizerProblem::Observer motion;     // every iteration that moves prescribed vertices
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
  // Returns whether it checks how far steps debond bodies (time.resolve_debonding).
  virtual bool resolves_debonding() const { return false; }
  // Returns the step metrics of the last solve; zeros before the first solve.
  virtual std::vector<StepMetric> metrics() const { return {}; }
  // Load times, at which prescribed motion and dead loads are taken, at the ends of a step [s].
  struct LoadTimes {
    double from, to;
  };
  // Returns the load times of the step of size h that led to a state: the times of the state,
  // unless the stepper finds the load of a step.
  virtual LoadTimes load_times(const State& state, double h) const {
    return {state.time - h, state.time};
  }
  // Prepares a run. Called once, before all functions below.
  virtual void prepare(const StepperContext& context) = 0;
  // Called before a step is opened. new_unknowns: the unknowns of the world have changed.
  virtual void begin(bool /*new_unknowns*/) {}
  // Solves the step, or sets result.failure; substeps may follow. In an acceptable result, vertices
  // with prescribed motion are at their target positions, and all participants are at result.x
  // (move_to).
  // guess: null, or a start (3n) with those vertices at their target positions, as feasible as the
  // stepper needs it.
  // May throw OutOfTime, for which the loop sets the status of the result, and SimulationError,
  // which ends the run.
  virtual void solve(const Step& step, const VecX* guess, SolveResult& result) = 0;
  // Validates a result, also one cut short by OutOfTime, but not an interrupted one.
  virtual Validation validate(const SolveResult& result) = 0;
  // Called when the last result is accepted: stores history for the next step, besides positions.
  virtual void commit(History& /*history*/) const {}
  // Called when bodies are moved outside of steps: erases the history that commit() stored.
  virtual void erase_history(History& /*history*/) const {}

  void observe(StepObservers observers) { observers_ = std::move(observers); }

 protected:
  StepObservers observers_;
};

}  // namespace tack
