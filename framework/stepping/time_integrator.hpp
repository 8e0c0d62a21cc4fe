// Time integration as a minimisation: one step solves
//     x* = argmin 1/2 |x - x~|_M^2 + beta h^2 P(x)      (the paper, eq. 1),
// where dynamic terms (contact, friction, bonds, ...: Term::dynamic) may have a factor of their
// own.
#pragma once

#include <string>

#include "framework/assembly/term_scales.hpp"
#include "framework/config/registry.hpp"
#include "framework/core/state.hpp"

namespace tack {

class TimeIntegrator : public Component {
 public:
  static constexpr const char* kind_name = "integrator";
  static constexpr const char* kind_doc = "Turns a time step into a minimisation.";

  struct Prediction {
    VecX x;             // x~ (3n)
    double scale = 1;   // beta h^2 [s^2]; 1 when quasi-static
    double contact_scale = scale;  // of dynamic terms
    bool inertia = true;
    TermScales scales() const { return {scale, contact_scale}; }
  };
  virtual Prediction predict(const State& state, double h) const = 0;
  // Velocities and accelerations from the new positions; time and history are the caller's. contact:
  // what State::contact will be.
  virtual void update(const State& old, const VecX& x, const VecX& contact, double h, VecX& v,
                      VecX& a) const = 0;
  // By how far the end x of a step is off, an estimate from a formula of another order (3n) [m], and the power of h with which that falls.
  struct LocalError {
    VecX x;
    int power;
  };
  virtual LocalError local_error(const State& old, const VecX& x, const VecX& /*contact*/, double h) const {
    return {0.5 * (x - old.x - h * old.v), 2};
  }
  // What update() makes of velocities; meaningless without inertia.
  virtual EndVelocity end_velocity(const State& state, double h) const { return {1 / h, state.x}; }
  // Whether it uses State::contact; it stays empty otherwise.
  virtual bool follows_contact() const { return false; }
  // What repeats a step in which energy has grown noticeably, and nothing put it in (energy_balance.hpp);
  // null: the step is kept.
  virtual const TimeIntegrator* fallback() const { return nullptr; }
  // Whether it brings to rest what nothing drives.
  virtual bool damps() const { return false; }
  // Why it made or lost energy, mostly in steps with contact or without, and what cures that.
  virtual std::string energy_advice(bool /*made*/, bool /*contact*/) const { return "refine time.step"; }
  // Corrects them for vertices that do not follow from forces, if the above carries velocities over
  // from step to step.
  virtual void update_held(const State& /*old*/, const VecX& /*x*/, double /*h*/,
                           const std::vector<int>& /*held*/, VecX& /*v*/, VecX& /*a*/) const {}
};

}  // namespace tack
