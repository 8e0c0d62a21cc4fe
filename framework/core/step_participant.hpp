// The life of a time step, as everything knows it that has a part in it: terms of the potential, and what several of
// them share (contact). In this order, for each step that is tried:
//   remember    the history that counts from now on: before the first step, and whenever one was kept or undone
//   begin_step  a step starts at x
//   lag         what is held while the step is minimised is taken at x: at its start, and when the step is
//               solved again with what its latest solution says; x is the current configuration
//   move_to     x is the current configuration: before anything is evaluated there, many times
//   commit      the step ends at x and is kept: writes what is to be remembered of it
// Between two calls of remember() the history does not change. A step that is given up is followed by another
// begin_step(), from the same x or an earlier one.
#pragma once

#include <vector>

#include "framework/core/history.hpp"
#include "geometry/types.hpp"

namespace tack {

// What a time integrator takes for the velocities at the end x of a step: rate (x - still).
struct EndVelocity {
  double rate;  // 1/s
  VecX still;   // 3n [m]
};

struct StepStart {
  const VecX& x;    // 3n [m]
  double time = 0;  // s
  double h = 0;     // step size [s]; 0: nothing is solved, and records are asked for at x
  const EndVelocity* velocity = nullptr;  // null: the step over h
  const VecX* before = nullptr;  // velocities at the start (3n) [m/s]; null: nothing has any, as in quasi-static steps
};

class StepParticipant {
 public:
  virtual ~StepParticipant() = default;

  virtual void remember(const History& /*history*/) {}
  virtual void begin_step(const StepStart& /*start*/) {}
  virtual bool lags() const { return false; }  // whether lag() does anything
  virtual void lag(const VecX& /*x*/) {}
  virtual void move_to(const VecX& /*x*/) {}
  virtual void commit(const VecX& /*x*/, History& /*history*/) const {}
  virtual std::vector<double> abrupt_times() const { return {}; }  // at which it changes in no smooth way [s]: steps that adapt end there
  // Forgets what steps have left for the sake of speed: as if built anew.
  virtual void forget() {}
};

// All that take part in the steps of a world, in the order in which they are told: what others build on comes first.
class StepParticipants : public StepParticipant {
 public:
  void add(StepParticipant* participant) { all_.push_back(participant); }

  void remember(const History& history) override {
    for (StepParticipant* p : all_) p->remember(history);
  }
  // With lag() at the start, if there is anything to lag.
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
  void forget() override {
    for (StepParticipant* p : all_) p->forget();
  }

 private:
  std::vector<StepParticipant*> all_;
};

}  // namespace tack
