// Units with prefixes, so that axes and legends have numbers of few digits.
#pragma once

#include <string>

namespace tack {

struct AxisUnit {
  double factor = 1;  // what numbers are multiplied by
  std::string text;   // "mm"; empty: a plain number
};

// For numbers up to `largest` in size of an SI unit ("m", "1", ""). What has no prefix has a power of ten: "10⁶ kg/m³".
AxisUnit axis_unit(double largest, const std::string& unit);

// "gap [mm]"
std::string axis_label(const std::string& name, const std::string& unit);

// "5 kPa", "0.3"
std::string with_axis_unit(double number, const std::string& unit);

}  // namespace tack
