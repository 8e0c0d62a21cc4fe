// Second-order backward differences. Differences across an impact would return energy that the
// impact dissipated. Implicit Euler, which keeps the global order at two, therefore solves
//   - steps that follow one in which contact was not smooth,
//   - the first step, and the first one after a change of h.
// Adaptive steps, whose sizes always change, use the formula of two sizes, with w the ratio of this
// size to the last, stable up to w = 1 + sqrt 2:
//     h v' = (1 + 2 w) / (1 + w) x' - (1 + w) x + w^2 / (1 + w) x_before,
// and the same formula for a' of the velocities.
#pragma once

#include "framework/stepping/integrators/implicit_euler.hpp"

namespace tack {

class Bdf2 : public TimeIntegrator {
 public:
  Prediction predict(const StepStage& stage) const override;
  void update(const StepStage& stage, const VecX& x, const VecX& contact, VecX& v,
              VecX& a) const override;
  EndVelocity end_velocity(const StepStage& stage) const override;
  // The formula misses k times h^3/6 x''', and the parabola of the last velocity and acceleration
  // misses h^3/6 x''' with the opposite sign.
  LocalError local_error(const StepStage& stage, const VecX& x, const VecX& contact) const override;
  bool follows_contact() const override { return true; }
  bool damps() const override { return true; }
  std::string energy_advice(bool gain, bool contact) const override;

 private:
  ImplicitEuler euler_;
};

}  // namespace tack
