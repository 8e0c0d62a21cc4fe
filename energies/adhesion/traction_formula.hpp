// Traction by gap, or its energy, as a formula with named parameters, converted to a curve
// (geometry/curves).
#pragma once

#include <map>
#include <string>

#include "framework/config/field.hpp"
#include "geometry/curves/adaptive_curve.hpp"

namespace tack {

struct TractionFormula {
  std::string traction, energy;  // one of them
  std::map<std::string, Quantity> parameters;
  double range = 0;  // m

  void fields(Fields& f);

  // Returns the curve from 0 to the range. Throws InputError for a formula that is not finite there
  // or jumps.
  AdaptiveCurve sample() const;

 private:
  const std::string& text() const { return traction.empty() ? energy : traction; }
  std::vector<std::string> variables() const;
  std::string check_formula() const;
  std::string check_parameters() const;
};

}  // namespace tack
