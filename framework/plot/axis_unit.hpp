// Units with SI prefixes, for axes and legends with short numbers.
#pragma once

#include <string>

namespace tack {

struct AxisUnit {
  double factor = 1;  // numbers are multiplied by it
  std::string text;   // "mm"; empty: a plain number
};

// Chooses the prefix for numbers of magnitude up to `largest` in an SI unit ("m", "1", ""). Units
// that take no prefix get a power of ten: "10⁶ kg/m³".
AxisUnit axis_unit(double largest, const std::string& unit);

// Returns "gap [mm]".
std::string axis_label(const std::string& name, const std::string& unit);

// Returns a number with its unit: "5 kPa", "0.3".
std::string with_axis_unit(double number, const std::string& unit);

}  // namespace tack
