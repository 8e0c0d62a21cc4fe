#include "framework/law/scene_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/plot/axis_unit.hpp"
#include "framework/setup/adhesion_lengths.hpp"

namespace tack {
namespace {

constexpr double softening_start = 0.9, softening_end = 0.1;  // tractions, of the peak
constexpr double step_per_softening = 0.1;  // displacement per step over the softening range
// Softening range over the opening; a smaller one is brittle: no step resolves it.
constexpr double brittle_softening = 0.01;

}  // namespace

SofteningRange softening_range(const std::vector<std::pair<double, double>>& traction) {
  double peak = 0;
  for (const auto& [x, y] : traction) peak = std::max(peak, y);
  SofteningRange softening;
  for (size_t i = 0; i + 1 < traction.size() && peak > 0; ++i) {
    const double x = traction[i].first, y = traction[i].second, next = traction[i + 1].first, below = traction[i + 1].second;
    const auto crossed = [&](double level) { return y >= level && below < level ? x + (next - x) * (y - level) / (y - below) : 0; };
    if (const double at = crossed(softening_start * peak); at > 0) softening.from = at;
    if (const double at = crossed(softening_end * peak); at > 0) softening.to = at;
  }
  return softening.to > softening.from ? softening : SofteningRange{};
}

void add_scene_requirements(const StudiedLaw& studied, const StudySettings& settings, const SofteningRange& softening, const SofteningRange& at_speed, std::vector<KeyQuantity>& quantities) {
  const double peak = studied.law().peak_traction(), work = studied.law().work_of_adhesion();
  if (peak > 0 && work > 0 && std::isfinite(work)) {
    if (studied.young > 0) {
      const double zone = process_zone(studied.young, work, peak);
      quantities.push_back({"process zone", zone, "m", fmt::format("E W / sigma^2 with E = {}", with_axis_unit(studied.young, "Pa"))});
      quantities.push_back({"mesh size", mesh_size_per_process_zone * zone, "m", "for peeling and tearing: a third of the process zone; at most all of it"});
    }
    if (studied.bending_stiffness > 0) {
      const double length = bending_length(studied.bending_stiffness, work, peak);
      quantities.push_back({"bending length", length, "m", fmt::format("(2 B W / sigma^2)^(1/4) with B = {} per width", with_axis_unit(studied.bending_stiffness, "N m"))});
      quantities.push_back({"mesh size of a sheet or a rod", mesh_size_max_per_bending_length * length, "m", "for peeling: at most a half of the bending length"});
    }
    if (studied.young == 0 && studied.bending_stiffness == 0)
      quantities.push_back({"process zone per modulus", process_zone(1, work, peak), "m/Pa", "W / sigma^2; with --young the process zone and the mesh size"});
  }
  if (studied.gap)
    quantities.push_back({"gap change across an element", gap_change_per_range * studied.gap->range(), "m",
                       "at most: a quarter of the range; where surfaces are curved or tilted"});
  if (softening.width() > 0) {
    const bool brittle = softening.width() < brittle_softening * softening.to;
    quantities.push_back({"displacement per step", step_per_softening * (brittle ? softening.to : softening.width()), "m",
                       brittle ? "at most: a tenth of the critical opening; the failure is brittle, and no step resolves it"
                               : "at most: a tenth of the displacement over which the traction falls from 0.9 to 0.1 of its peak"});
    if (settings.speed) {
      const bool sooner = at_speed.width() > 0 && at_speed.width() < softening.width();
      const double way = sooner && !brittle ? step_per_softening * at_speed.width() : quantities.back().value;
      quantities.push_back({"time step", way / *settings.speed, "s",
                         fmt::format("at most, at {}{}", with_axis_unit(*settings.speed, "m/s"), sooner && !brittle ? ", where the traction falls sooner than under slow loading" : "")});
    }
  }
  if (studied.bond && std::isfinite(studied.bond->longest_step()))
    quantities.push_back({"longest time step", studied.bond->longest_step(), "s", "explicit integration: with longer steps, force and work of the failure are wrong"});
}

}  // namespace tack
