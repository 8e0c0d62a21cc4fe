#include "framework/run/simulation.hpp"

#include <stdexcept>

#include "framework/config/bind.hpp"
#include "framework/output/next_due.hpp"
#include "framework/remesh/carried_state.hpp"
#include "framework/setup/remesh_checks.hpp"

namespace tack {

Simulation::Simulation(LoadedExperiment loaded, WarningFunction warn)
    : built_(std::move(loaded)), warn_(std::move(warn)), remesher_(experiment()) {}

void Simulation::start_from(State state) {
  world().start = std::move(state);
  looked_ = true;
  world().participants.forget();
  stepper_.reset();
  solver_ = make_solver_ ? make_solver_() : instance_of(*experiment().solver);
  stepper_.emplace(world(), experiment(), experiment().time, *solver_, clock(), warn_);
  const OutputConfig& output = experiment().output;
  if (output.frames && output.frame_interval > 0)
    stepper_->stop_at([interval = output.frame_interval, step = experiment().time.step](double t) { return next_due(interval, t, step); });
  stepper_->observe(observers_);
  stepper_->observe_solved(solved_);
}

StepReport Simulation::step() {
  if (!looked_) throw std::logic_error("objects of the scene may be meshed anew (remesh): due_elements() has to be called between two steps");
  looked_ = !remeshes(experiment());
  return stepper_->advance();
}

std::vector<NewElements> Simulation::due_elements() {
  looked_ = true;
  if (!remeshes(experiment())) return {};
  State noted = state();
  std::vector<NewElements> elements = remesher_.exchange(world(), noted, warn_);
  stepper_->set_state(std::move(noted));
  return elements;
}

double Simulation::exchange(std::vector<NewElements> elements) {
  const State before = state();
  StoredInObjects stored = stored_in_objects(world(), before.x);
  FlowedMeshes flowed = built_.flowed();
  for (const NewElements& e : elements) flowed[world().bodies[e.body].name] = e.mesh;
  stepper_.reset();
  const std::unique_ptr<World> was = built_.rebuild(std::move(flowed));
  start_from(carried_state(before, *was, world(), elements));
  State booked = state();
  stored.gradient = carried_field(stored.gradient, *was, world(), elements);
  book_remeshed_energy(world(), stored, booked);
  stepper_->set_state(std::move(booked));
  return lost_by_remeshing(state());
}

}  // namespace tack
