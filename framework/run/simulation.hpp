// An experiment under way: its world, a solver of its own, the clock, and the state that is stepped on. Nothing is
// written; see recorded_run.hpp.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "framework/core/warning.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "framework/remesh/remesher.hpp"
#include "framework/stepping/time_stepper.hpp"

namespace tack {

class Simulation {
 public:
  // Builds the world; throws InputError as BuiltExperiment does. `warn` is told of failed solves and whatever else is doubtful.
  explicit Simulation(LoadedExperiment loaded, WarningFunction warn = [](const Warning&) {});

  const BuiltExperiment& built() const { return built_; }
  BuiltExperiment& built() { return built_; }
  const Experiment& experiment() const { return built_.experiment(); }
  World& world() { return built_.world(); }
  const World& world() const { return built_.world(); }
  PhaseClock& clock() { return built_.clock(); }

  // Before anything below: at the experiment's start, or from a state as a program would go on that was started
  // there: with a solver and candidates of its own.
  void start() { start_from(world().start); }
  void start_from(State state);
  bool started() const { return stepper_.has_value(); }
  // Sets positions and velocities of the meshes' vertices (3 per vertex) [m, m/s] between steps, as
  // moved_state() says. Those that the state already has change nothing. Throws InputError, and
  // leaves everything as it was, for positions that intersect, touch, invert elements, or that
  // dependent vertices cannot have.
  void move(const VecX& x, const VecX& v);

  // One accepted step. Throws SimulationError when no step small enough succeeds. Of scenes in which objects may be meshed anew, due_elements() has to
  // be called between two steps: else std::logic_error.
  StepReport step();
  bool finished() const { return stepper_->finished(); }
  bool interrupted() const { return stepper_->interrupted(); }
  const State& state() const { return stepper_->state(); }
  const Minimizer& solver() const { return *solver_; }
  // Who minimises from the next start on; empty: what the experiment says.
  void solve_with(std::function<std::unique_ptr<Minimizer>()> make) { make_solver_ = std::move(make); }
  TimeStepper& stepper() { return *stepper_; }  // for those who study single steps; another one after start_from()

  // After a step, better elements of the objects whose tets are worn (`remesh`), for exchange(). Nothing has changed but that it is noted what was tried.
  std::vector<NewElements> due_elements();
  // Goes on with them: there is another world, and whatever pointed into the one before has to be made anew. The state is as that of a program
  // which is started with it. Returns the energy that was lost [J].
  double exchange(std::vector<NewElements> elements);
  // Before start_from(): objects with the meshes that the state is of.
  void rebuild(FlowedMeshes flowed) { built_.rebuild(std::move(flowed)); }

  // Who is told of what, from the next start on.
  void observe(StepObservers observers) { observers_ = std::move(observers); }
  void observe_solved(TimeStepper::SolvedObserver solved) { solved_ = std::move(solved); }

 private:
  BuiltExperiment built_;
  WarningFunction warn_;
  StepObservers observers_;
  TimeStepper::SolvedObserver solved_;
  Remesher remesher_;
  bool looked_ = true;  // for worn tets, since the last step
  std::function<std::unique_ptr<Minimizer>()> make_solver_;
  std::unique_ptr<Minimizer> solver_;
  std::optional<TimeStepper> stepper_;
};

}  // namespace tack
