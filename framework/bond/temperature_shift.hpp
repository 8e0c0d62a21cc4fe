// Shift factor a_T of relaxation times with the temperature T (thermorheologically simple
// materials): a time at the reference temperature T_ref becomes a_T times as long,
//     arrhenius  ln a_T = E / R (1/T - 1/T_ref)
//     wlf        log10 a_T = -C_1 (T - T_ref) / (C_2 + T - T_ref); without end below T_ref - C_2
// Source: Williams, Landel and Ferry 1955, The temperature dependence of relaxation mechanisms.
#pragma once

#include <optional>
#include <string>

#include "framework/bond/site_state.hpp"
#include "framework/config/field.hpp"

namespace tack {

class TemperatureShift {
 public:
  /// time: key of the time that is shifted.
  void fields(Fields& f, const std::string& time);
  /// Returns false if the factor is 1 at every temperature.
  bool shifts() const { return form_ != Form::none; }
  /// Returns a_T [1]. temperature: K.
  double factor(double temperature) const;

 private:
  enum class Form { none, arrhenius, wlf };

  Form form_ = Form::none;
  double reference_ = room_temperature;  // K
  std::optional<double> activation_;     // J/mol
  double c1_ = 17.44, c2_ = 51.6;        // 1, K
};

}  // namespace tack
