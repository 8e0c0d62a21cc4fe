#include "framework/stepping/integrators/implicit_euler.hpp"

#include "framework/stepping/integrators/contact_change.hpp"

namespace tack {

TimeIntegrator::Prediction ImplicitEuler::predict(const StepStage& stage) const {
  const State& s = stage.state;
  const double h = stage.h;
  return {s.x + h * s.v, h * h};
}

void ImplicitEuler::update(const StepStage& stage, const VecX& x, const VecX&, VecX& v, VecX& a) const {
  v = (x - stage.state.x) / stage.h;
  a = (v - stage.state.v) / stage.h;
}

std::string ImplicitEuler::energy_advice(bool gain, bool contact) const {
  if (gain) return energy_gain_advice(contact);
  return "implicit Euler damps what moves and vibrates, in proportion to the step: time.integrator: newmark, or refine time.step";
}

TACK_REGISTER(TimeIntegrator, ImplicitEuler, "implicit_euler",
              "First order, stable for any step, damps vibrations.", "Fang et al., section 3.1");

}  // namespace tack
