// Participants of a time step: the terms of the potential, and objects that several terms share
// (contact). Calls of each step that is tried, in this order:
//   load_history  sets the history: before the first step, after a step was accepted or rolled back
//   begin_step    starts a step at x
//   lag           updates the lagged quantities at x, the current configuration: at the start of
//                 the step, and before each further lagging iteration
//   move_to       makes x the current configuration, before any evaluation there: many times
//   commit        ends an accepted step at x: stores the history variables
// The history does not change between two calls of load_history(). After a rejected step,
// begin_step() follows again, from the same x or an earlier one.
#pragma once

#include <vector>

#include "framework/core/history.hpp"
#include "geometry/types.hpp"

namespace tack {

/// Velocities at the end x of a step, as a time integrator defines them: rate (x - still).
struct EndVelocity {
  double rate;  // 1/s
  VecX still;   // 3n [m]
};

/// The start of a step.
struct StepStart {
  const VecX& x;    // 3n [m]
  double time = 0;  // s
  double h = 0;     // step size [s]; 0: no solve follows, records are evaluated at x
  const EndVelocity* velocity = nullptr;  // null: velocities are (x' - x) / h
  const VecX* before = nullptr;  // velocities at the start (3n) [m/s]; null: quasi-static step
};

/// Interface of everything that takes part in time steps.
class StepParticipant {
 public:
  virtual ~StepParticipant() = default;

  virtual void load_history(const History& /*history*/) {}
  virtual void begin_step(const StepStart& /*start*/) {}
  virtual bool lags() const { return false; }  // true if lag() does anything
  virtual void lag(const VecX& /*x*/) {}
  virtual void move_to(const VecX& /*x*/) {}
  virtual void commit(const VecX& /*x*/, History& /*history*/) const {}
  /// Returns the times of discontinuities [s]; steps of adaptive size end there.
  virtual std::vector<double> abrupt_times() const { return {}; }
  /// Clears all caches: later steps give the bits of a participant that was just built.
  virtual void clear_caches() {}
};

/// The participants of a world, in the order of their calls: one that others depend on comes first.
class StepParticipants : public StepParticipant {
 public:
  void add(StepParticipant* participant) { all_.push_back(participant); }

  void load_history(const History& history) override {
    for (StepParticipant* p : all_) p->load_history(history);
  }
  /// Calls lag(start.x) afterwards if any participant lags.
  void begin_step(const StepStart& start) override {
    for (StepParticipant* p : all_) p->begin_step(start);
    lag(start.x);
  }
  bool lags() const override {
    for (const StepParticipant* p : all_)
      if (p->lags()) return true;
    return false;
  }
  void lag(const VecX& x) override {
    if (!lags()) return;
    move_to(x);
    for (StepParticipant* p : all_) p->lag(x);
  }
  void move_to(const VecX& x) override {
    for (StepParticipant* p : all_) p->move_to(x);
  }
  void commit(const VecX& x, History& history) const override {
    for (const StepParticipant* p : all_) p->commit(x, history);
  }
  std::vector<double> abrupt_times() const override {
    std::vector<double> times;
    for (const StepParticipant* p : all_)
      for (const double t : p->abrupt_times()) times.push_back(t);
    return times;
  }
  void clear_caches() override {
    for (StepParticipant* p : all_) p->clear_caches();
  }

 private:
  std::vector<StepParticipant*> all_;
};

}  // namespace tack
