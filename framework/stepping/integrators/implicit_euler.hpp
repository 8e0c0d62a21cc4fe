// Implicit Euler: x' = x + h v', v' = v + h a'. First order, damps.
#pragma once

#include "framework/stepping/time_integrator.hpp"

namespace tack {

class ImplicitEuler : public TimeIntegrator {
 public:
  Prediction predict(const StepStage& stage) const override;
  void update(const StepStage& stage, const VecX& x, const VecX& contact, VecX& v,
              VecX& a) const override;
  bool damps() const override { return true; }
  std::string energy_advice(bool gain, bool contact) const override;
};

}  // namespace tack
