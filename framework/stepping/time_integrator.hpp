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
    VecX x;                        // x~ (3n)
    double scale = 1;              // beta h^2 [s^2]; 1 when quasi-static
    double contact_scale = scale;  // of dynamic terms
    bool inertia = true;
    TermScales scales() const { return {scale, contact_scale}; }
  };
  // Returns the prediction of a step of size h [s].
  virtual Prediction predict(const State& state, double h) const = 0;
  // Returns velocities and accelerations for the new positions x (3n); the caller sets time and
  // history. contact: the value that State::contact will have.
  virtual void update(const State& old, const VecX& x, const VecX& contact, double h, VecX& v,
                      VecX& a) const = 0;
  // Error of a step, estimated by a formula of another order.
  struct LocalError {
    VecX x;     // of the positions at the end of the step (3n) [m]
    int power;  // of h with which the error falls
  };
  // Returns the estimated error of the end x of a step (3n).
  virtual LocalError local_error(const State& old, const VecX& x, const VecX& /*contact*/,
                                 double h) const {
    return {0.5 * (x - old.x - h * old.v), 2};
  }
  // Returns the velocity at the end of a step as update() computes it; undefined without inertia.
  virtual EndVelocity end_velocity(const State& state, double h) const { return {1 / h, state.x}; }
  // Returns whether the integrator uses State::contact, which stays empty otherwise.
  virtual bool follows_contact() const { return false; }
  // Returns the integrator that repeats a step with a noticeable numerical energy gain
  // (energy_balance.hpp); null: the step is accepted.
  virtual const TimeIntegrator* fallback() const { return nullptr; }
  // Returns whether the integrator brings undriven motion to rest.
  virtual bool damps() const { return false; }
  // Returns advice on a numerical energy gain (`gain`) or loss, mostly in steps with `contact` or
  // without.
  virtual std::string energy_advice(bool /*gain*/, bool /*contact*/) const {
    return "refine time.step";
  }
  // Corrects velocities and accelerations of vertices with prescribed motion, if update() would
  // carry velocities over from step to step. fixed: these vertices.
  virtual void update_fixed(const State& /*old*/, const VecX& /*x*/, double /*h*/,
                            const std::vector<int>& /*fixed*/, VecX& /*v*/, VecX& /*a*/) const {}
};

}  // namespace tack
