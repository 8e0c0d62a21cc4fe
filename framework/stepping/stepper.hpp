// How one step of a world is solved. The time loop (time_stepper.hpp) opens a step, has it attempted, asks for the
// verdict, and keeps what it gets or rolls back and tries half of it; velocities are the integrator's, of the
// positions. A stepper knows nothing of that, and the loop nothing of how a step is solved: whether by minimisation
// or not, and whether what it gives may interpenetrate.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/core/history.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/core/step_figure.hpp"
#include "framework/stepping/time_integrator.hpp"

namespace tack {

class HeldVertices;
class LaggedImpulses;
class StepPotential;
struct SceneConfig;
struct TimeConfig;
struct World;

// What a run has, for its whole length.
struct StepperContext {
  World& world;
  const SceneConfig& scene;
  const TimeConfig& time;
  Minimizer& solver;
  PhaseClock& clock;
};

// A step that is to be solved. All that take part have been told of it (framework/core/step_participant.hpp), and
// world.dofs has its unknowns.
struct Step {
  const State& state;  // where it starts
  double h;            // s
  TimeIntegrator::Prediction prediction;
  VecX places;  // 3n [m]: where it starts, and what the script moves where it ends
  const HeldVertices& held;
  StepPotential& potential;  // its incremental potential, begun at `places`
  LaggedImpulses* impulses = nullptr;  // what friction is given, if it lags by a step; null: nobody has to know

  bool scripted() const { return places != state.x; }  // whether the script moves anything in it
};

// What became of a step, before it is judged and kept. Numbers that mean nothing to a stepper stay as they are.
struct Attempt {
  MinimizerResult result;  // counts over all lag iterations
  VecX x;                  // 3n [m]; `places` to begin with
  std::string failure = "";  // why the scripted vertices could not be moved
  int lag_iterations = 0;
  // The solves before the last: where they ended, what lags was taken anew (3n), and the gradient that was left there, in the unknowns.
  struct Solved {
    VecX x, gradient;
  };
  std::vector<Solved> before = {};
  double friction_residual = 0;
  bool lag_converged = true;
  double unbalanced_force = 0, tolerated_force = 0;  // the largest that is left at a vertex, and may be [N]
  std::vector<StepFigure> figures = {};  // the stepper's own
};

struct Verdict {
  std::string wrong;   // "" if the attempt may be kept
  std::string remedy;  // what users can do about it
  int intersections = 0, inverted_tets = 0;  // that were found: for records
  int parts = 2;           // into how many the step is cut if it is refused; a power of two
  std::string told = "";   // what is doubtful of an attempt that may be kept: a warning
  bool tolerable = false;  // of the smallest steps that are tried, it may be kept all the same: what is wrong is warned of
};

// Who is told of what while a step is solved.
struct StepObservers {
  MinimizerProblem::Observer minimizer, walk;  // every iteration; `walk`: of those that walk scripted vertices
  // Every step from x to x + p (3n) that a minimiser wants to take, and the part of it that is feasible.
  std::function<void(const VecX& x, const VecX& p, double feasible)> steps;
  bool true_residuals = false;  // MinimizerProblem::true_residuals
};

class Stepper : public Component {
 public:
  static constexpr const char* kind_name = "stepper";
  static constexpr const char* kind_doc = "Solves a time step.";

  // Throws InputError for a world that it cannot step. Asked when a scene is loaded.
  virtual void admit(const World& /*world*/, const SceneConfig& /*scene*/, const TimeConfig& /*time*/) const {}
  // What it tells of its steps beside what all do: its attempts' figures, or before the first of them 0.
  virtual std::vector<StepFigure> figures() const { return {}; }
  // Once, before anything below.
  virtual void prepare(const StepperContext& context) = 0;
  // A step is about to be opened; new_unknowns: those of the world are others than before.
  virtual void begin(bool /*new_unknowns*/) {}
  // Solves it, or says in the attempt that it could not: halves may follow. Whatever is to be kept has scripted
  // vertices at their places, and all that take part at attempt.x (move_to). `guess`: null, or a start (3n) with the
  // scripted vertices at their places, as feasible as the stepper needs it. May throw OutOfTime, for which the loop
  // sets the result's status, and SimulationError, which ends the run.
  virtual void attempt(const Step& step, const VecX* guess, Attempt& attempt) = 0;
  // Asked of every attempt but interrupted ones, also of what OutOfTime has cut short.
  virtual Verdict verdict(const Attempt& attempt) = 0;
  // The latest attempt is kept: writes what the next step is to know beside where everything is.
  virtual void commit(History& /*history*/) const {}
  // Bodies are put elsewhere, by no step: erases what commit() has written.
  virtual void forget(History& /*history*/) const {}

  void observe(StepObservers observers) { observers_ = std::move(observers); }

 protected:
  StepObservers observers_;
};

}  // namespace tack
