// A number that is fitted: its range, the keys that take it, and the scale on which it is searched for.
//
// Searches work on u = ln(value) on a logarithmic scale, and on u = 3 value / (to - from) on a linear one, so that a step of 0.15 is 15% of
// the value, or 5% of the range. Values have six digits: what is as close as that is the same run.
#pragma once

#include <string>
#include <vector>

#include "framework/calibrate/calibrate_config.hpp"

namespace tack {

struct FittedNumber {
  std::string name;                            // of tables
  std::vector<std::vector<std::string>> keys;  // of each experiment
  // Per experiment and key: the unit that the number's text has in the scene, as the text of a
  // parameter has one; "" if it has none.
  std::vector<std::vector<std::string>> units;
  std::string unit;                            // SI; "" until it is known, "1" of a plain number
  double from = 0, to = 1, start = 0;          // SI
  bool log = false;

  double u(double value) const;
  double value(double u) const;  // to six digits, within the range
  double slope(double value) const { return log ? value : (to - from) / 3; }  // d value / d u
  double low() const { return u(from); }
  double high() const { return u(to); }
};

// To six significant digits.
double six_digits(double value);

// In the order of their names. Throws InputError for names that are the same, or columns that tables have anyway, and keys that name no experiment.
std::vector<FittedNumber> fitted_numbers(const CalibrateConfig& config);

}  // namespace tack
