#include "framework/law/bond_healing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/plot/axis_unit.hpp"

namespace tack {
namespace {

constexpr int dwell_steps = 500, parting_steps = 2000, dwell_points = 60;
constexpr double shortest_dwell = 1e-9, longest_dwell = 1e9;  // s
constexpr double healed = 0.01;                   // of a whole bond: less is nothing

std::vector<BondStep> pressed(double time, double pressure) {
  std::vector<BondStep> way;
  for (int i = 1; i <= dwell_steps; ++i) way.push_back({time * i / dwell_steps, 0, 0, pressure});
  return way;
}

double intensity_after(const BondLaw& law, double time, double pressure) { return follow_bond(law, pressed(time, pressure), true).back().intensity; }

// Returns the strength of bonds that were pressed for a time, parted too slowly for viscosity to count, if the law permits.
double strength_after(const BondLaw& law, double time, double pressure, double far) {
  std::vector<BondStep> way = pressed(time, pressure);
  const bool any_step = !std::isfinite(law.longest_step());
  const double h = any_step ? 1e12 : law.longest_step() / 20;
  const int steps = any_step ? parting_steps : 10 * parting_steps;
  for (int i = 1; i <= steps; ++i) way.push_back({time + h * i, far * i / steps, 0});
  double most = 0;
  for (const BondPoint& p : follow_bond(law, way, true)) most = std::max(most, p.traction);
  return most;
}

// When half of what it comes to has been reached.
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

void study_healing(const BondLaw& law, double pressure, double far, std::vector<HealingCurve>& curves, std::vector<LawFigure>& figures) {
  if (!(pressure > 0) || intensity_after(law, longest_dwell, pressure) - intensity_after(law, shortest_dwell, pressure) < healed) return;
  const double half = half_time(law, pressure);
  figures.push_back({"time to heal", half, "s", fmt::format("to a half of what it comes to, under {}", with_axis_unit(pressure, "Pa"))});
  for (const double p : {pressure / 10, pressure, 10 * pressure}) {
    HealingCurve& curve = curves.emplace_back(HealingCurve{p, {}});
    for (int i = 0; i <= dwell_points; ++i) {
      const double time = half * std::pow(10, -2 + 4.0 * i / dwell_points);
      curve.strength.emplace_back(time, strength_after(law, time, p, far));
    }
  }
}

}  // namespace tack
