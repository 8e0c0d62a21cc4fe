#include "framework/run/simulation.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "framework/config/bind.hpp"
#include "framework/output/next_due.hpp"
#include "framework/remesh/state_transfer.hpp"
#include "framework/run/moved_state.hpp"
#include "framework/setup/remesh_checks.hpp"
#include "framework/setup/start_checks.hpp"
#include "geometry/errors.hpp"
#include "geometry/exact/orientation.hpp"

namespace tack {

Simulation::Simulation(LoadedExperiment loaded, WarningFunction warn)
    : built_(std::move(loaded)), warn_(std::move(warn)), remesher_(experiment()) {
  if (!experiment().protocols.empty()) protocols_.emplace(built_);
}

void Simulation::start_from(State state) {
  world().start = std::move(state);
  elements_examined_ = true;
  world().participants.clear_caches();
  stepper_.reset();
  solver_ = make_solver_ ? make_solver_() : instance_of(*experiment().solver);
  stepper_.emplace(world(), experiment(), experiment().time, *solver_, clock(), warn_);
  const OutputConfig& output = experiment().output;
  if (output.frames && output.frame_interval > 0)
    stepper_->stop_at([from = output.frames_from, interval = output.frame_interval, step = experiment().time.step](double t) { return next_due_from(from, interval, t, step); });
  stepper_->observe(observers_);
  stepper_->observe_solved(solved_);
  if (protocols_) stepper_->follow(*protocols_);
}

void Simulation::move(const VecX& x, const VecX& v) {
  const State& now = state();
  if (now.x.head(x.size()) == x && now.v.head(v.size()) == v) return;
  State moved = moved_state(world(), now, x, v);
  const State start = world().start;
  try {
    world().start = moved;
    if (const int tet = first_inverted_tet(world().tets, moved.x); tet >= 0) {
      const Tet& t = world().tets[static_cast<size_t>(tet)];
      throw InputError(fmt::format("the positions invert the tet of the vertices {}, {}, {} and {}; move them less", t[0], t[1], t[2], t[3]));
    }
    check_start(experiment(), built_.root(), world());
  } catch (...) {
    world().start = start;
    throw;
  }
  start_from(std::move(moved));
}

StepReport Simulation::step() {
  if (!elements_examined_) throw std::logic_error("objects of the scene may be meshed anew (remesh): due_elements() has to be called between two steps");
  elements_examined_ = !any_remeshed(experiment());
  return stepper_->advance();
}

void Simulation::check_stages() const {
  if (!protocols_) return;
  if (const std::string fault = protocols_->fault(state().time, stepper_->finished()); !fault.empty()) throw SimulationError(fault);
}

std::vector<NewElements> Simulation::due_elements() {
  elements_examined_ = true;
  if (!any_remeshed(experiment())) return {};
  State noted = state();
  std::vector<NewElements> elements = remesher_.exchange(world(), noted, warn_);
  stepper_->set_state(std::move(noted));
  return elements;
}

double Simulation::exchange(std::vector<NewElements> elements) {
  const State before = state();
  StoredEnergy stored = stored_energy_of_objects(world(), before.x);
  FlowedMeshes flowed = built_.flowed();
  for (const NewElements& e : elements) flowed[world().bodies[e.body].name] = e.mesh;
  stepper_.reset();
  const std::unique_ptr<World> was = built_.rebuild(std::move(flowed));
  start_from(transfer_state(before, *was, world(), elements));
  State booked = state();
  stored.gradient = transfer_field(stored.gradient, *was, world(), elements);
  record_energy_loss(world(), stored, booked);
  stepper_->set_state(std::move(booked));
  return energy_loss_of_remeshing(state());
}

}  // namespace tack
