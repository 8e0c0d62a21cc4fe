#include "framework/law/demands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/plot/axis_unit.hpp"

namespace tack {
namespace {

constexpr double fall_begins = 0.9, fall_ends = 0.1;   // of the peak, where it falls
constexpr double part_of_zone = 1.0 / 3;
constexpr double part_of_fall = 0.1;      // that surfaces should part by in a step
constexpr double part_of_range = 0.25;    // that the gap may change by across an element (framework/checks/resolution.hpp)
constexpr double at_once = 0.01;          // of the opening: a fall that no step resolves

}  // namespace

Fall fall_of(const std::vector<std::pair<double, double>>& traction) {
  double peak = 0;
  for (const auto& [x, y] : traction) peak = std::max(peak, y);
  Fall fall;
  for (size_t i = 0; i + 1 < traction.size() && peak > 0; ++i) {
    const double x = traction[i].first, y = traction[i].second, next = traction[i + 1].first, below = traction[i + 1].second;
    const auto crossed = [&](double level) { return y >= level && below < level ? x + (next - x) * (y - level) / (y - below) : 0; };
    if (const double at = crossed(fall_begins * peak); at > 0) fall.from = at;
    if (const double at = crossed(fall_ends * peak); at > 0) fall.to = at;
  }
  return fall.to > fall.from ? fall : Fall{};
}

void add_demands(const StudiedLaw& studied, const StudySettings& settings, const Fall& fall, std::vector<LawFigure>& figures) {
  const double peak = studied.law().peak_traction(), work = studied.law().work_of_adhesion();
  if (peak > 0 && work > 0 && std::isfinite(work)) {
    const double per_young = work / (peak * peak);
    if (studied.young > 0) {
      const double zone = studied.young * per_young;
      figures.push_back({"process zone", zone, "m", fmt::format("E W / sigma^2 with E = {}", with_axis_unit(studied.young, "Pa"))});
      figures.push_back({"mesh size", part_of_zone * zone, "m", "where it peels or tears: a third of the process zone; all of it at most"});
    } else {
      figures.push_back({"process zone per modulus", per_young, "m/Pa", "W / sigma^2; with --young the process zone and the mesh size"});
    }
  }
  if (studied.gap)
    figures.push_back({"gap change across an element", part_of_range * studied.gap->range(), "m",
                       "at most: a quarter of its range; where surfaces are curved or tilted"});
  if (fall.way() > 0) {
    const bool brittle = fall.way() < at_once * fall.to;
    figures.push_back({"way per step", part_of_fall * (brittle ? fall.to : fall.way()), "m",
                       brittle ? "at most: a tenth of the opening at which it breaks; it breaks at once, which no step resolves"
                               : "at most: a tenth of the way over which the traction falls from 0.9 to 0.1 of its peak"});
    if (settings.speed) {
      const double step = figures.back().value / *settings.speed;
      figures.push_back({"time step", step, "s", fmt::format("at most, at {}", with_axis_unit(*settings.speed, "m/s"))});
    }
  }
  if (studied.bond && std::isfinite(studied.bond->longest_step()))
    figures.push_back({"longest time step", studied.bond->longest_step(), "s", "it is integrated: beyond, it breaks at another force and work"});
}

}  // namespace tack
