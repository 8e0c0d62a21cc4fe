// Prescribed pressure that follows the surface: W = -p V. W is no stored energy; the pressure does
// work.
#pragma once

#include "energies/loads/ramp.hpp"
#include "framework/load/volume_term.hpp"

namespace tack {

class PressureTerm : public VolumeTerm {
 public:
  // value: Pa, times the ramp, which must outlive it.
  PressureTerm(std::string label, OrientedSurface surface, double value, const Ramp& ramp)
      : VolumeTerm("pressure", std::move(label), std::move(surface)), value_(value), ramp_(ramp) {}
  double pressure(const VecX&, double time) const override { return value_ * ramp_.at(time); }
  std::vector<double> abrupt_times() const override { return ramp_.corners(); }
  void begin_step(const StepStart& start) override {
    VolumeTerm::begin_step(start);
    reference_ = surface().closed() ? volume(start.x) : 0;
  }

 protected:
  VolumeSample sample(double volume, double part) const override {
    const double p = value_ * ramp_.at(time() + part * h());
    return {-p * (volume - reference_), p, 0};
  }

 private:
  double value_;
  const Ramp& ramp_;
  double reference_ = 0;  // volume of zero potential [m^3]
};

}  // namespace tack
