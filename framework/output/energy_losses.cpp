#include "framework/output/energy_losses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/stepping/energy_advice.hpp"

namespace tack {
namespace {

constexpr double most_of_it = 0.8;

struct Told {
  double joules;
  std::string text;
};

std::string percent(double share) { return share < 0.1 ? fmt::format("{:.2g}%", 100 * share) : fmt::format("{:.0f}%", 100 * share); }

}  // namespace

void EnergyLosses::Cause::add(const StepReport& report, double dissipated, double jerk) {
  losing = std::max(0.0, losing + dissipated);
  making = std::max(0.0, making - dissipated - jerk);
  lost = std::max(lost, losing);
  made = std::max(made, making);
  sum += dissipated;
  in_contact += report.flows.in_contact ? dissipated : 0;
  when.add(report.time - report.step_size / 2, report.step_size, dissipated);
}

void EnergyLosses::add(const StepReport& report) {
  const EnergyFlows& flows = report.flows;
  at_play = std::max(at_play, flows.at_play);
  moving = std::max(moving, flows.moving);
  noise += flows.noise * flows.noise;
  areas.add(report, flows.areas, 0);
  (flows.damped ? repeated : integrator).add(report, flows.numerics, flows.jerk);
}

std::vector<Warning> EnergyLosses::told(const TimeIntegrator& rule) const {
  std::vector<Told> told;
  const auto look = [&](const Cause& cause, const char* what, const auto& advice) {
    const bool made = cause.made > cause.lost;
    const double joules = made ? cause.made : cause.lost;
    if (joules <= tolerated * at_play + std::sqrt(noise)) return;
    if (!made && &cause == &integrator && rule.damps() && moving < motion * at_play) return;
    const auto [from, to] = cause.when.densest(made ? -most_of_it * joules : most_of_it * joules);
    told.push_back({joules, fmt::format("energy: {} {} {:.3g} J, {} of the most that was at play ({:.3g} J), most of it from t = {:.4g} to {:.4g} s: {}",
                                        what, made ? "made" : "lost", joules, percent(joules / at_play), at_play, from, to, advice(made, cause))});
  };
  look(areas, "areas of contact", [](bool, const Cause&) { return areas_advice; });
  look(repeated, "repeated steps", [](bool, const Cause&) { return repeats_advice; });
  look(integrator, "time integration", [&](bool made, const Cause& cause) {
    return rule.energy_advice(made, 2 * std::abs(cause.in_contact) > std::abs(cause.sum));
  });
  std::stable_sort(told.begin(), told.end(), [](const Told& a, const Told& b) { return a.joules > b.joules; });
  std::vector<Warning> warnings;
  for (const Told& t : told) warnings.emplace_back(t.text);
  return warnings;
}

}  // namespace tack
