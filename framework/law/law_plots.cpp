#include "framework/law/law_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/plot/axis_unit.hpp"

namespace tack {
namespace {

constexpr double shown_ratio_max = 6;  // largest displacement in a plot, over the smallest `shown` of its paths
constexpr double shown_repulsion = 0.5;  // largest repulsion in a plot, of the peak or the depth

Plot plot_of(const std::string& title, const char* along, const char* up, const char* unit) {
  return {.title = title, .x_label = along, .y_label = up, .x_unit = "m", .y_unit = unit, .style = Plot::Style::lines, .curves = {}, .levels = {}, .notes = {}};
}

template <class Y>
Curve curve_of(const std::string& title, const std::vector<BondPoint>& points, double shown, const Y& y) {
  Curve curve{title, {}, {}};
  BondPoint start;
  start.intensity = points.front().intensity;
  curve.points.emplace_back(0, y(start));
  for (const BondPoint& p : points)
    if (displacement_of(p) <= shown * (1 + 1e-9)) curve.points.emplace_back(displacement_of(p), y(p));
  const BondPoint& last = points.back();
  if (displacement_of(last) < shown && last.traction == 0 && last.shear == 0) curve.points.emplace_back(shown, y(last));  // the bond has failed
  return curve;
}

// Returns the curve from the first unloading to the last displacement at which unloading began.
template <class Y>
Curve unloading_curve(const BondPath& path, const Y& y) {
  size_t first = 0, end = 0;
  double farthest = 0;
  const auto& p = path.points;
  for (size_t i = 1; i < p.size(); ++i) {
    if (displacement_of(p[i]) > displacement_of(p[i - 1])) continue;
    if (first == 0) first = i - 1;
    if (displacement_of(p[i - 1]) > farthest) farthest = displacement_of(p[i - 1]);
    end = i;
  }
  while (end < p.size() && displacement_of(p[end]) <= farthest * (1 + 1e-9)) ++end;
  Curve curve{"unloaded and loaded again", {}, {}};
  for (size_t i = first; i < end; ++i) curve.points.emplace_back(displacement_of(p[i]), y(p[i]));
  return curve;
}

std::string picture_of(double angle) { return angle == 0 ? "unloading" : angle > 1 ? "unloading_across" : "unloading_45"; }

}  // namespace

std::map<std::string, Plot> law_plots(const std::string& title, const GapStudy& study) {
  Plot traction = plot_of(title, "gap", "traction", "Pa"), energy = plot_of(title, "gap", "energy per area", "J/m^2");
  traction.curves = {{"adhesion", {}, {}}, {"with the barrier", {}, {}}};
  energy.curves = traction.curves;
  double peak = 0, depth = 0;
  for (const GapPoint& p : study.curve) peak = std::max(peak, p.traction), depth = std::max(depth, -p.energy);
  for (const GapPoint& p : study.curve) {
    if (p.gap > study.shown * (1 + 1e-9)) continue;
    traction.curves[0].points.emplace_back(p.gap, p.traction);
    energy.curves[0].points.emplace_back(p.gap, p.energy);
    if (p.pair_traction > -shown_repulsion * peak) traction.curves[1].points.emplace_back(p.gap, p.pair_traction);
    if (p.pair_energy < shown_repulsion * depth) energy.curves[1].points.emplace_back(p.gap, p.pair_energy);
  }
  return {{"traction", std::move(traction)}, {"energy", std::move(energy)}};
}

std::map<std::string, Plot> law_plots(const std::string& title, const BondStudy& study) {
  std::map<std::string, Plot> plots;
  if (study.slow.empty()) return plots;
  // A direction that softens slowly would squeeze one that fails early.
  double least = study.slow.front().shown, shown = 0;
  for (const BondPath& p : study.slow) least = std::min(least, p.shown), shown = std::max(shown, p.shown);
  shown = std::min(shown, shown_ratio_max * least);
  Plot& traction = plots["traction"] = plot_of(title, "opening or slip", "traction along the displacement", "Pa");
  for (const BondPath& p : study.slow)
    traction.curves.push_back(curve_of(direction_name(p.angle), p.points, shown, [&](const BondPoint& at) { return traction_along(at, p.angle); }));
  const BondPath& first = study.slow.front();
  const char* along = first.angle == 0 ? "opening" : "displacement";
  Plot& energy = plots["energy"] = plot_of(fmt::format("{}, {}", title, direction_name(first.angle)), along, "energy per area", "J/m^2");
  energy.curves = {curve_of("stored", first.points, first.shown, [](const BondPoint& p) { return p.stored; }),
                   curve_of("dissipated", first.points, first.shown, [](const BondPoint& p) { return p.dissipated; }),
                   curve_of("both", first.points, first.shown, [](const BondPoint& p) { return p.stored + p.dissipated; })};
  if (!study.unloading.empty()) {
    Plot& intensity = plots["intensity"] = plot_of(title, "opening or slip", "intensity", "1");
    for (const BondPath& p : study.slow)
      intensity.curves.push_back(curve_of(direction_name(p.angle), p.points, shown, [](const BondPoint& at) { return at.intensity; }));
  }
  for (size_t i = 0; i < study.unloading.size(); ++i) {
    const BondPath& p = study.unloading[i];
    const auto pull = [&](const BondPoint& at) { return traction_along(at, p.angle); };
    Plot& plot = plots[picture_of(p.angle)] = plot_of(fmt::format("{}, {}", title, direction_name(p.angle)), p.angle == 0 ? "opening" : p.angle > 1 ? "slip" : "displacement",
                                                      "traction along the displacement", "Pa");
    plot.curves = {curve_of("loaded once", study.slow[i].points, p.shown, pull), unloading_curve(p, pull)};
  }
  if (!study.rates.empty()) {
    const auto pull = [&](const BondPoint& at) { return traction_along(at, first.angle); };
    Plot& rate = plots["rate"] = plot_of(fmt::format("{}, {}", title, direction_name(first.angle)), along, "traction", "Pa");
    rate.curves.push_back(curve_of("slowly", first.points, study.rates.front().shown, pull));
    for (const BondPath& p : study.rates) rate.curves.push_back(curve_of(with_axis_unit(p.speed, "m/s"), p.points, p.shown, pull));
  }
  if (study.scan.rate_dependent()) {
    const auto plot_over_speed = [&](const char* name, const char* quantity, const char* unit, double RatePoint::*metric) {
      Plot& plot = plots[name] = plot_of(fmt::format("{}, {}", title, direction_name(first.angle)), "speed", quantity, unit);
      plot.x_unit = "m/s";
      plot.log_x = true;
      plot.curves = {{"at constant speed", {}, {}}, {"slowly", {}, {}}};
      for (const RatePoint& p : study.scan.points) {
        plot.curves[0].points.emplace_back(p.speed, p.*metric);
        plot.curves[1].points.emplace_back(p.speed, study.scan.slow.*metric);
      }
    };
    plot_over_speed("peak_over_speed", "peak traction", "Pa", &RatePoint::peak);
    plot_over_speed("work_over_speed", "work", "J/m^2", &RatePoint::work);
  }
  if (!study.healing.empty()) {
    Plot& healing = plots["healing"] = plot_of(title, "time of pressing", "strength", "Pa");
    healing.x_unit = "s";
    healing.log_x = true;
    for (const HealingCurve& h : study.healing) healing.curves.push_back({"under " + with_axis_unit(h.pressure, "Pa"), h.strength, {}});
  }
  return plots;
}

}  // namespace tack
