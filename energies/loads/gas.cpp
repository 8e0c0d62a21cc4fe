// Ideal gas: p V^gamma = m^gamma p0 V0^gamma, with m of the amount of gas at rest; gamma = 1 is isothermal. Let pa be the ambient pressure, Vr the volume
// at which the gas has the reference pressure pr (pa, or p0 in a vacuum), and y = V / Vr. The stored energy is the work of an expansion to Vr against pa:
//     W = pr Vr (y^(1 - gamma) - 1) / (gamma - 1) + pa (V - Vr),    or  - pr Vr ln y + pa (V - Vr)  with gamma = 1.
// A leak reduces the excess over the ambient pressure, at constant volume, by the fraction `leak` per second; exact for any step size.
#include <cmath>
#include <limits>

#include "energies/loads/ramp.hpp"
#include "framework/load/cavity_content.hpp"

namespace tack {
namespace {

class Gas : public StoredContent {
 public:
  void fields(Fields& f) override {
    f.optional_number("pressure", pressure_, units::pressure, "absolute pressure of the gas in the chamber at rest; ambient unless given").positive();
    f.number("ambient", ambient_, units::pressure, "absolute pressure of the surroundings; 0: a vacuum").nonnegative();
    f.number("gamma", gamma_, units::none, "ratio of specific heats: p V^gamma is constant; 1: isothermal").range(1, 3);
    amount_.fields(f, "amount", "amount of gas relative to that at rest, over time");
    f.number("leak", leak_, units::rate, "leak rate: the pressure above ambient decays at this rate").nonnegative();
    f.check("pressure", [this]() -> std::string { return p0() > 0 ? "" : "a gas needs a pressure at rest where the ambient one is 0"; });
  }

  VolumeSample at(double volume, double at_rest, double left, double time) const override {
    if (!(volume > 0)) return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN(), 0};
    const double reference = ambient_ > 0 ? ambient_ : p0(), m = left * amount_.at(time);
    const double vr = m * at_rest * std::pow(p0() / reference, 1 / gamma_);
    const double ln = std::log(volume / vr), by = (1 - gamma_) * ln;
    const double part = gamma_ == 1 ? -ln : std::expm1(by) / (gamma_ - 1);
    const double p = reference * std::exp(by) * vr / volume;
    return {reference * vr * part + ambient_ * (volume - vr), p - ambient_, gamma_ * p / volume};
  }
  double after(double volume, double at_rest, double left, double time, double h, double vented) const override {
    const double over = at(volume, at_rest, left, time).pressure, p = over + ambient_;
    const double stays = ambient_ + over * std::exp(-(leak_ + vented) * h);
    return leak_ + vented > 0 && std::isfinite(p) ? left * std::pow(stays / p, 1 / gamma_) : left;
  }
  double target(double, double) const override { return std::numeric_limits<double>::quiet_NaN(); }
  bool is_gas() const override { return true; }
  std::vector<double> corners() const override { return amount_.corners(); }

 private:
  double p0() const { return pressure_.value_or(ambient_); }

  std::optional<double> pressure_;  // Pa
  double ambient_ = 101325;         // Pa
  double gamma_ = 1;
  Ramp amount_;
  double leak_ = 0;  // 1/s
};

// W = K (V - Vt)^2 / (2 Vt), Vt the volume that there is of it without pressure.
class Liquid : public StoredContent {
 public:
  void fields(Fields& f) override {
    f.number("bulk_modulus", bulk_modulus_, units::pressure,
             "pressure per relative change of volume; the relative volume error is the pressure over this modulus")
        .required().positive();
    volume_.fields(f, "volume", "volume at zero pressure relative to that of the chamber at rest, over time");
  }
  VolumeSample at(double volume, double at_rest, double left, double time) const override {
    const double wanted = left * target(at_rest, time), off = volume - wanted, k = bulk_modulus_ / wanted;
    return {k / 2 * off * off, -k * off, k};
  }
  double after(double volume, double at_rest, double left, double time, double h, double vented) const override {
    if (vented == 0) return left;
    const double all = target(at_rest, time), wanted = left * all, over = bulk_modulus_ * (wanted - volume) / wanted * std::exp(-vented * h);
    return volume / (1 - over / bulk_modulus_) / all;
  }
  double target(double at_rest, double time) const override { return at_rest * volume_.at(time); }
  bool is_gas() const override { return false; }
  std::vector<double> corners() const override { return volume_.corners(); }

 private:
  double bulk_modulus_ = 1;  // Pa
  Ramp volume_;
};

TACK_REGISTER(CavityContent, Gas, "gas", "An ideal gas, isothermal or polytropic, with or without a leak.", "");
TACK_REGISTER(CavityContent, Liquid, "liquid", "A nearly incompressible liquid, which may be pumped in and out.", "");

}  // namespace
}  // namespace tack
