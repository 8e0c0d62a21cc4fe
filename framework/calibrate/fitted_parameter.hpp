// A fitted scene parameter: its range, its keys, and the scale of the search.
//
// Searches work in u, so that a step of 0.15 is 15% of the value, or 5% of the range:
//   logarithmic scale  u = ln(value)
//   linear scale       u = 3 value / (to - from)
// Values are rounded to six digits: points that are equal after rounding share their runs.
#pragma once

#include <string>
#include <vector>

#include "framework/calibrate/calibrate_config.hpp"

namespace tack {

struct FittedParameter {
  std::string name;                            // column in tables
  std::vector<std::vector<std::string>> keys;  // per experiment
  // Per experiment and key: the unit of the number in the scene file, for parameters whose text has
  // one; "" otherwise.
  std::vector<std::vector<std::string>> units;
  std::string unit;                    // SI; "" until it is known, "1" of a plain number
  double from = 0, to = 1, start = 0;  // SI
  bool log = false;

  double u(double value) const;
  double value(double u) const;  // to six digits, within the range
  double slope(double value) const { return log ? value : (to - from) / 3; }  // d value / d u
  double low() const { return u(from); }
  double high() const { return u(to); }
};

// Rounds to six significant digits.
double six_digits(double value);

// Returns the fitted parameters sorted by name. Throws InputError for equal names, names of fixed
// columns, and keys that name no experiment.
std::vector<FittedParameter> fitted_parameters(const CalibrateConfig& config);

}  // namespace tack
