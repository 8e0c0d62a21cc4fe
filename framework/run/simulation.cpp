#include "framework/run/simulation.hpp"

#include "framework/config/bind.hpp"
#include "framework/output/next_due.hpp"

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

}  // namespace tack
