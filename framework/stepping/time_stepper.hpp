// Time loop: opens a step, has it solved and validated (step_stages.hpp), and accepts it or rejects
// it with a reason (rejection.hpp). A rejected step leaves the state as it was; step_size.hpp gives
// the size of its repetition.
#pragma once

#include <functional>
#include <optional>

#include "framework/stepping/adaptive_steps.hpp"
#include "framework/stepping/step_events.hpp"
#include "framework/stepping/step_reporter.hpp"
#include "framework/stepping/step_size.hpp"
#include "framework/stepping/step_stages.hpp"

namespace tack {

// A solved step before it is accepted. All participants are still in the state of the step.
struct SolvedStep {
  const State& start;
  double h;  // s
  const TimeIntegrator& integrator;
  bool damped;  // true if `integrator` is the fallback of the scene's integrator
  const SolveResult& result;
  StepPotential& potential;
  int unknowns;  // number of changes of the unknowns so far
};

class TimeStepper : public StepStages {
 public:
  // `warn` receives failed solves and other warnings.
  TimeStepper(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver,
              PhaseClock& clock, WarningFunction warn);
  TimeStepper(const TimeStepper&) = delete;  // sizes_ refers to the state

  // Advances by one accepted step. Throws SimulationError if the smallest step fails too.
  StepReport advance();
  // Sets further times at which adaptive steps end: next(t) is the first one after t [s].
  void stop_at(std::function<double(double t)> next) { sizes_.stop_at(std::move(next)); }
  // Sets what happens between steps, and begins there. It must outlive the stepper.
  void follow(StepEvents& events);
  bool finished() const {
    return state_.time >= time_.duration - sizes_.time_tolerance() ||
           (events_ && events_->finished());
  }
  bool interrupted() const { return interrupted_; }
  // Returns the size that advance() tries first [s].
  double next_step_size() const { return sizes_.size(); }
  // Receives each solved step before it is accepted. Some of them are undone afterwards and
  // repeated.
  using SolvedObserver = std::function<void(const SolvedStep&)>;
  void observe_solved(SolvedObserver solved) { solved_ = std::move(solved); }

 private:
  // A step solved up to its last stage, or up to a stage that failed.
  struct Attempt {
    SolveResult result;
    Validation validation;
  };
  Attempt solve_stages(double h);
  bool rejects(const Validation& validation, double h);
  bool rejects_error(const ErrorRatio& error);
  ErrorRatio error_of(const VecX& x, double h) const;
  bool repeats_for_energy() const;
  StepReport commit_with_report(const SolveResult& result, double h);
  bool rejects_energy(const StepReport& report, State start);
  bool repeats_for_event(StepReport& report, double h, State& start);
  void accept_event();
  void end(StepReport& report, const Validation& validation, const ErrorRatio& error);
  void check_wall_limit(const std::string& fault) const;

  double contact_distance_;  // m; 0 without contact
  StepSizeController sizes_;
  std::optional<StepErrors> errors_;  // in adaptive steps
  StepReporter reporter_;
  SolvedObserver solved_;
  StepEvents* events_ = nullptr;
  bool interrupted_ = false;
};

}  // namespace tack
