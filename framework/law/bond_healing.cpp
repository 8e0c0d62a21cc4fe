#include "framework/law/bond_healing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/plot/axis_unit.hpp"

namespace tack {
namespace {

constexpr int dwell_steps = 500, opening_steps = 2000, dwell_points = 60;
constexpr double shortest_dwell = 1e-9, longest_dwell = 1e9;  // s
constexpr double healed_intensity_min = 0.01;  // a smaller gain of intensity does not count as healing

// Returns the path of a bond that is pressed for a time [s] under a pressure [Pa].
std::vector<BondStep> pressing_path(double time, double pressure) {
  std::vector<BondStep> path;
  for (int i = 1; i <= dwell_steps; ++i) path.push_back({time * i / dwell_steps, 0, 0, pressure});
  return path;
}

double intensity_after(const BondLaw& law, double time, double pressure) { return trace_bond(law, pressing_path(time, pressure), true).back().intensity; }

// Returns the largest traction [Pa] of a bond that is pressed for a time [s] and then opened to
// `opening_end` [m]. It opens too slowly for viscosity to count, unless the law limits the step.
double strength_after(const BondLaw& law, double time, double pressure, double opening_end) {
  std::vector<BondStep> path = pressing_path(time, pressure);
  const bool any_step = !std::isfinite(law.longest_step());
  const double h = any_step ? 1e12 : law.longest_step() / 20;
  const int steps = any_step ? opening_steps : 10 * opening_steps;
  for (int i = 1; i <= steps; ++i) path.push_back({time + h * i, opening_end * i / steps, 0});
  double strength = 0;
  for (const BondPoint& p : trace_bond(law, path, true)) strength = std::max(strength, p.traction);
  return strength;
}

// Returns the time [s] after which half of the final gain of intensity is reached.
double half_time(const BondLaw& law, double pressure) {
  const double begins = intensity_after(law, shortest_dwell, pressure), half = (begins + intensity_after(law, longest_dwell, pressure)) / 2;
  double low = shortest_dwell, high = longest_dwell;
  for (int i = 0; i < 60; ++i) {
    const double middle = std::sqrt(low * high);
    (intensity_after(law, middle, pressure) > half ? high : low) = middle;
  }
  return high;
}

}  // namespace

void study_healing(const BondLaw& law, double pressure, double opening_end, std::vector<HealingCurve>& curves, std::vector<KeyQuantity>& quantities) {
  if (!(pressure > 0) || intensity_after(law, longest_dwell, pressure) - intensity_after(law, shortest_dwell, pressure) < healed_intensity_min) return;
  const double half = half_time(law, pressure);
  quantities.push_back({"time to heal", half, "s", fmt::format("to half of the final intensity, under {}", with_axis_unit(pressure, "Pa"))});
  for (const double p : {pressure / 10, pressure, 10 * pressure}) {
    HealingCurve& curve = curves.emplace_back(HealingCurve{p, {}});
    for (int i = 0; i <= dwell_points; ++i) {
      const double time = half * std::pow(10, -2 + 4.0 * i / dwell_points);
      curve.strength.emplace_back(time, strength_after(law, time, p, opening_end));
    }
  }
}

}  // namespace tack
