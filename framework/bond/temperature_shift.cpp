#include "framework/bond/temperature_shift.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/config/thermal_units.hpp"

namespace tack {
namespace {

constexpr double gas_constant = 8.31446261815324;  // J/(mol K)
constexpr double shift_max = 300;                  // |ln a_T|

}  // namespace

void TemperatureShift::fields(Fields& f, const std::string& time) {
  f.choice("shift", form_,
           {{"none", Form::none, "the relaxation time does not depend on the temperature"},
            {"arrhenius", Form::arrhenius, "ln a_T = E / R (1/T - 1/T_ref)"},
            {"wlf", Form::wlf, "Williams, Landel and Ferry: log10 a_T = -C_1 (T - T_ref) / (C_2 + T - T_ref)"}},
           "dependence of the relaxation time on environment.temperature: a_T times that at the reference temperature");
  f.number("reference_temperature", reference_, units::temperature, "T_ref, at which " + time + " holds").positive();
  f.optional_number("activation_energy", activation_, units::molar_energy, "E of the shift `arrhenius`").nonnegative();
  f.number("wlf_c1", c1_, units::none, "C_1 of the shift `wlf`; the default is that of many polymers from their glass transition").nonnegative();
  f.number("wlf_c2", c2_, units::temperature_difference, "C_2 of the shift `wlf`").positive();
  f.check("activation_energy", [this]() -> std::string {
    if (form_ == Form::arrhenius) return activation_ ? "" : "is missing: `shift: arrhenius` needs it";
    return activation_ ? "is of `shift: arrhenius`; choose that, or take it away" : "";
  });
}

double TemperatureShift::factor(double temperature) const {
  const double warmer = temperature - reference_;
  double exponent = 0;  // ln a_T
  if (form_ == Form::arrhenius) exponent = -*activation_ / gas_constant * warmer / (temperature * reference_);
  if (form_ == Form::wlf) exponent = c2_ + warmer > 0 ? -std::numbers::ln10 * c1_ * warmer / (c2_ + warmer) : shift_max;
  return std::exp(std::clamp(exponent, -shift_max, shift_max));
}

}  // namespace tack
