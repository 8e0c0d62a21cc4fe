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
  // Returns velocities and accelerations for the new positions x (3n); the caller sets time and
  // history. contact: the value that State::contact will have.
  virtual void update(const State& old, const VecX& x, const VecX& contact, double h, VecX& v,
                      VecX& a) const = 0;
  // Estimated error of the end x of a step (3n) [m], from a formula of another order, and the power
  // of h with which it falls.
  struct LocalError {
    VecX x;
    int power;
  };
  virtual LocalError local_error(const State& old, const VecX& x, const VecX& /*contact*/,
                                 double h) const {
    return {0.5 * (x - old.x - h * old.v), 2};
  }
  // Velocity at the end of a step as update() computes it; meaningless without inertia.
  virtual EndVelocity end_velocity(const State& state, double h) const { return {1 / h, state.x}; }
  // Returns whether the integrator uses State::contact, which stays empty otherwise.
  virtual bool follows_contact() const { return false; }
  // Integrator that repeats a step in which energy has grown noticeably without a source
  // (energy_balance.hpp); null: the step is kept.
  virtual const TimeIntegrator* fallback() const { return nullptr; }
  // Returns whether the integrator brings undriven motion to rest.
  virtual bool damps() const { return false; }
  // Advice on a numerical gain (`made`) or loss of energy, mostly in steps with `contact` or
  // without.
  virtual std::string energy_advice(bool /*made*/, bool /*contact*/) const {
    return "refine time.step";
  }
  // Corrects them for vertices that do not follow from forces, if the above carries velocities over
  // from step to step.
  virtual void update_fixed(const State& /*old*/, const VecX& /*x*/, double /*h*/,
                           const std::vector<int>& /*held*/, VecX& /*v*/, VecX& /*a*/) const {}
};

}  // namespace tack
