#include "framework/run/simulation.hpp"

#include "framework/config/bind.hpp"
#include "framework/output/next_due.hpp"
#include "framework/remesh/carried_state.hpp"

namespace tack {

Simulation::Simulation(LoadedExperiment loaded, WarningFunction warn)
    : built_(std::move(loaded)), warn_(std::move(warn)) {}

void Simulation::start_from(State state) {
  world().start = std::move(state);
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

double Simulation::exchange(std::vector<NewElements> elements) {
  const State before = state();
  const VecX stored = stored_gradient(world(), before.x);
  FlowedMeshes flowed = built_.flowed();
  for (const NewElements& e : elements) flowed[world().bodies[e.body].name] = e.mesh;
  stepper_.reset();
  const std::unique_ptr<World> was = built_.rebuild(std::move(flowed));
  start_from(carried_state(before, *was, world(), elements));
  State booked = state();
  book_remeshed_energy(world(), carried_field(stored, *was, world(), elements), booked);
  stepper_->set_state(std::move(booked));
  return lost_by_remeshing(state());
}

}  // namespace tack
