#include "framework/plot/axis_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace tack {
namespace {

constexpr std::array<std::string_view, 11> take_prefixes = {"m", "s", "N", "Pa", "J", "W", "m/s", "N m", "Hz", "J/m^2", "N/m"};
constexpr std::array<std::string_view, 9> prefixes = {"p", "n", "µ", "m", "", "k", "M", "G", "T"};  // from 10^-12

constexpr std::array<std::string_view, 10> superscripts = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

// Returns "m/s²" for "m/s^2".
std::string pretty(std::string_view unit) {
  std::string out;
  bool raised = false;
  for (const char c : unit) {
    if (c == '^') {
      raised = true;
      continue;
    }
    if (raised && c >= '0' && c <= '9') out += superscripts[static_cast<size_t>(c - '0')];
    else if (raised && c == '-') out += "⁻";
    else out += c, raised = false;
  }
  return out;
}

}  // namespace

AxisUnit axis_unit(double largest, const std::string& unit) {
  AxisUnit plain{1, unit == "1" ? "" : pretty(unit)};
  if (!(largest > 0) || !std::isfinite(largest)) return plain;
  const int exponent = 3 * static_cast<int>(std::floor(std::log10(largest * 1.0001) / 3));
  const bool prefixed = std::find(take_prefixes.begin(), take_prefixes.end(), unit) != take_prefixes.end();
  if (exponent == 0 || (largest >= 0.1 && largest < 1) || (exponent == 3 && !prefixed) || (unit == "s" && exponent > 0)) return plain;
  const double factor = std::pow(10.0, -exponent);
  if (prefixed && std::abs(exponent) <= 12) return {factor, std::string(prefixes[static_cast<size_t>(exponent / 3 + 4)]) + pretty(unit)};
  return {factor, fmt::format("{}{}{}", pretty(fmt::format("10^{}", exponent)), plain.text.empty() ? "" : " ", plain.text)};
}

std::string axis_label(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : fmt::format("{} [{}]", name, unit);
}

std::string with_axis_unit(double number, const std::string& unit) {
  const AxisUnit scaled = unit.empty() || unit == "1" ? AxisUnit{} : axis_unit(std::abs(number), unit);
  return fmt::format("{:.6g}{}{}", number * scaled.factor, scaled.text.empty() ? "" : " ", scaled.text);
}

}  // namespace tack
