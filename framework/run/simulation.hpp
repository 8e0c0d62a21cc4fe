// A running experiment: its world, its own solver, the clock and the present state. It writes no
// files; see recorded_run.hpp.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "framework/core/warning.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "framework/remesh/remesher.hpp"
#include "framework/run/protocol_run.hpp"
#include "framework/stepping/time_stepper.hpp"

namespace tack {

/// A running experiment: start(), then step() until finished().
class Simulation {
 public:
  /// Builds the world. warn: gets failed solves and other warnings. Throws InputError as
  /// BuiltExperiment does.
  explicit Simulation(
      LoadedExperiment loaded, WarningFunction warn = [](const Warning&) {});

  const BuiltExperiment& built() const { return built_; }
  BuiltExperiment& built() { return built_; }
  const Experiment& experiment() const { return built_.experiment(); }
  World& world() { return built_.world(); }
  const World& world() const { return built_.world(); }
  PhaseClock& clock() { return built_.clock(); }

  /// start: begins at the experiment's start. start_from: begins at a state, with new solver and
  /// candidates. Call one of them before the functions below.
  void start() { start_from(world().start); }
  void start_from(State state);
  bool started() const { return stepper_.has_value(); }
  /// Sets positions x [m] and velocities v [m/s] of the meshes' vertices (3 per vertex) between
  /// steps (moved_state.hpp). Values equal to the state's have no effect. Throws InputError, with
  /// nothing changed, for positions that intersect, touch, invert elements, or that dependent
  /// vertices cannot have.
  void move(const VecX& x, const VecX& v);

  /// Makes one accepted step. Throws SimulationError if no permitted step size succeeds, and
  /// std::logic_error if objects may be remeshed and due_elements() was not called since the last
  /// step.
  StepReport step();
  bool finished() const { return stepper_->finished(); }
  /// Returns the protocols of the scene; null: it has none.
  const ProtocolRun* protocols() const { return protocols_ ? &*protocols_ : nullptr; }
  /// Takes up the actions of this scene in a state of the scene before a change
  /// (changed_scene.hpp).
  void renew_protocols(State& state) {
    if (protocols_) protocols_->renew(state);
  }
  /// Throws SimulationError for a stage that has not ended in its time.
  void check_stages() const;
  bool interrupted() const { return stepper_->interrupted(); }
  const State& state() const { return stepper_->state(); }
  const Minimizer& solver() const { return *solver_; }
  /// Sets the minimiser from the next start on; empty: that of the experiment.
  void solve_with(std::function<std::unique_ptr<Minimizer>()> make) {
    make_solver_ = std::move(make);
  }
  /// For studies of single steps. start_from() makes another stepper.
  TimeStepper& stepper() { return *stepper_; }

  /// Returns, after a step, new elements for objects with worn tetrahedra (`remesh`), for
  /// exchange(). Changes nothing but the record of attempts.
  std::vector<NewElements> due_elements();
  /// Continues with new elements. Replaces the world: pointers into the previous one become
  /// invalid. The state is as after a start from it. Returns the energy lost [J].
  double exchange(std::vector<NewElements> elements);
  /// Gives objects the meshes that the state belongs to. Call it before start_from().
  void rebuild(FlowedMeshes flowed) { built_.rebuild(std::move(flowed)); }

  /// Sets the observers of steps, from the next start on.
  void observe(StepObservers observers) { observers_ = std::move(observers); }
  void observe_solved(TimeStepper::SolvedObserver solved) { solved_ = std::move(solved); }

 private:
  BuiltExperiment built_;
  WarningFunction warn_;
  StepObservers observers_;
  TimeStepper::SolvedObserver solved_;
  Remesher remesher_;
  bool elements_examined_ = true;  // due_elements() was called since the last step
  std::function<std::unique_ptr<Minimizer>()> make_solver_;
  std::unique_ptr<Minimizer> solver_;
  std::optional<ProtocolRun> protocols_;
  std::optional<TimeStepper> stepper_;
};

}  // namespace tack
