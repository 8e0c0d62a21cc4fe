#include "framework/stepping/integrators/bdf2.hpp"

#include "framework/stepping/integrators/contact_change.hpp"

namespace tack {
namespace {

struct Weights {
  explicit Weights(double w) : next((1 + 2 * w) / (1 + w)), now(1 + w), before(w * w / (1 + w)) {}
  double next, now, before;
};

bool has_history(const State& s, double h) { return step_ratio(s, h) > 0 && contact_change(s) < 1; }

}  // namespace

TimeIntegrator::Prediction Bdf2::predict(const StepStage& stage) const {
  const State& s = stage.state;
  const double h = stage.h;
  if (!has_history(s, h)) return euler_.predict(stage);
  if (const double w = step_ratio(s, h); w != 1) {
    const Weights k(w);
    return {(k.now * s.x - k.before * s.x_before) / k.next + h * (k.now * s.v - k.before * s.v_before) / (k.next * k.next),
            h * h / (k.next * k.next)};
  }
  return {(4 * s.x - s.x_before) / 3 + h * (8 * s.v - 2 * s.v_before) / 9, 4 * h * h / 9};
}

void Bdf2::update(const StepStage& stage, const VecX& x, const VecX& contact, VecX& v, VecX& a) const {
  const State& old = stage.state;
  const double h = stage.h;
  if (!has_history(old, h)) return euler_.update(stage, x, contact, v, a);
  if (const double w = step_ratio(old, h); w != 1) {
    const Weights k(w);
    v = (k.next * x - k.now * old.x + k.before * old.x_before) / h;
    a = (k.next * v - k.now * old.v + k.before * old.v_before) / h;
    return;
  }
  v = (3 * x - 4 * old.x + old.x_before) / (2 * h);
  a = (3 * v - 4 * old.v + old.v_before) / (2 * h);
}

EndVelocity Bdf2::end_velocity(const StepStage& stage) const {
  const State& s = stage.state;
  const double h = stage.h;
  if (!has_history(s, h)) return euler_.end_velocity(stage);
  if (const double w = step_ratio(s, h); w != 1) {
    const Weights k(w);
    return {k.next / h, (k.now * s.x - k.before * s.x_before) / k.next};
  }
  return {3 / (2 * h), (4 * s.x - s.x_before) / 3};
}

TimeIntegrator::LocalError Bdf2::local_error(const StepStage& stage, const VecX& x, const VecX& contact) const {
  const State& old = stage.state;
  const double h = stage.h;
  if (!has_history(old, h)) return euler_.local_error(stage, x, contact);
  const double w = step_ratio(old, h), k = (1 + w) * (1 + w) / (w * (1 + 2 * w));
  return {k / (1 + k) * (x - old.x - h * old.v - h * h / 2 * old.a), 3};
}

std::string Bdf2::energy_advice(bool gain, bool contact) const {
  if (gain) return energy_gain_advice(contact);
  return contact ? "BDF2 is implicit Euler, which damps, for a step after each sudden change of contact: refine time.step, or time.integrator: newmark"
                 : "BDF2 damps what is fast for its steps: refine time.step, or time.integrator: newmark";
}

TACK_REGISTER(TimeIntegrator, Bdf2, "bdf2",
              "Second order, with little numerical damping; falls back to implicit Euler for one step after non-smooth contact.",
              "Li 2020, Robust and Accurate Simulation of Elastodynamics and Contact");

}  // namespace tack
