#include "framework/output/energy_losses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/stepping/energy_advice.hpp"

namespace tack {
namespace {

constexpr double interval_fraction = 0.8;  // of a loss: the reported interval has at least that
constexpr size_t group_lines_max = 3;      // lines of groups

struct RankedWarning {
  double fraction;  // of the reference energy
  Warning warning;
};

std::string percent(double fraction) { return fraction < 0.1 ? fmt::format("{:.2g}%", 100 * fraction) : fmt::format("{:.0f}%", 100 * fraction); }

}  // namespace

void EnergyLosses::Cause::add(const StepReport& report, double dissipated, double jerk, bool contact) {
  losing = std::max(0.0, losing + dissipated);
  gaining = std::max(0.0, gaining - dissipated - jerk);
  lost = std::max(lost, losing);
  gained = std::max(gained, gaining);
  sum += dissipated;
  in_contact += contact ? dissipated : 0;
  over_time.add(report.time - report.step_size / 2, report.step_size, dissipated);
}

void EnergyLosses::Group::add(const StepReport& report, const GroupFlow& flow) {
  reference_energy = std::max(reference_energy, flow.reference_energy);
  moving = std::max(moving, flow.moving);
  noise += flow.noise * flow.noise;
  met_another = met_another || flow.met_another;
  (report.flows.damped ? repeated : integrator).add(report, flow.numerics, flow.jerk, flow.in_contact);
}

void EnergyLosses::add(const StepReport& report) {
  const EnergyFlows& flows = report.flows;
  reference_energy = std::max(reference_energy, flows.reference_energy);
  moving = std::max(moving, flows.moving);
  noise += flows.noise * flows.noise;
  areas.add(report, flows.areas, 0, flows.in_contact);
  (flows.damped ? repeated : integrator).add(report, flows.numerics, flows.jerk, flows.in_contact);
  if (groups.size() < flows.groups.size()) groups.resize(flows.groups.size());
  for (size_t g = 0; g < flows.groups.size(); ++g) groups[g].add(report, flows.groups[g]);
}

std::vector<Warning> EnergyLosses::warnings(const TimeIntegrator& rule, const std::vector<std::string>& group_names) const {
  std::vector<RankedWarning> ranked;
  // Adds a warning if the cause changed the energy of `of` noticeably. of: the scene, or a group.
  const auto add_warning = [&](WarningKind kind, const Cause& cause, const auto& of, const std::string& group, const char* what, const auto& advice) {
    const bool gained = cause.gained > cause.lost;
    const double joules = gained ? cause.gained : cause.lost;
    if (joules <= tolerated_fraction * of.reference_energy + std::sqrt(of.noise)) return;
    if (!gained && kind == WarningKind::energy_integration && rule.damps() && of.moving < moving_fraction_min * of.reference_energy) return;
    const auto [from, to] = cause.over_time.densest(gained ? -interval_fraction * joules : interval_fraction * joules);
    ranked.push_back({joules / of.reference_energy,
                    {kind, fmt::format("energy{}: {} {} {:.3g} J, {} of the reference energy ({:.3g} J), mainly from t = {:.4g} to {:.4g} s: {}",
                                       group.empty() ? "" : " of " + group, what, gained ? "gained" : "lost", joules, percent(joules / of.reference_energy), of.reference_energy, from, to,
                                       advice(gained, cause)), group}});
  };
  const auto of_areas = [](bool, const Cause&) { return areas_advice; };
  const auto of_repeats = [&](bool, const Cause&) {
    return fmt::format("steps with a numerical energy gain were repeated with {}: refine time.step", rule.fallback() ? rule.fallback()->type() : rule.type());
  };
  const auto of_rule = [&](bool gained, const Cause& cause) { return rule.energy_advice(gained, 2 * std::abs(cause.in_contact) > std::abs(cause.sum)); };
  const bool by_groups = !groups.empty() && groups.size() == group_names.size() && std::none_of(groups.begin(), groups.end(), [](const Group& g) { return g.met_another; });
  if (by_groups) {
    for (size_t g = 0; g < groups.size(); ++g) {
      // Contact areas are not accounted for by group: all of them together bound those of the group.
      const bool areas_count = std::max(areas.lost, areas.gained) > tolerated_fraction * groups[g].reference_energy;
      const char* what = areas_count ? "time integration and areas of contact" : "time integration";
      add_warning(WarningKind::energy_integration, groups[g].integrator, groups[g], group_names[g], what, of_rule);
      add_warning(WarningKind::energy_repeats, groups[g].repeated, groups[g], group_names[g], "repeated steps", of_repeats);
    }
  } else {
    add_warning(WarningKind::energy_areas, areas, *this, "", "areas of contact", of_areas);
    add_warning(WarningKind::energy_repeats, repeated, *this, "", "repeated steps", of_repeats);
    add_warning(WarningKind::energy_integration, integrator, *this, "", "time integration", of_rule);
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const RankedWarning& a, const RankedWarning& b) { return a.fraction > b.fraction; });
  std::vector<Warning> warnings;
  for (const RankedWarning& t : ranked) {
    if (by_groups && warnings.size() == group_lines_max) {
      warnings.emplace_back(WarningKind::energy_further_groups, fmt::format("energy: {} more groups of bodies lost or gained more than {:g}% of their reference energy", ranked.size() - group_lines_max, 100 * tolerated_fraction));
      break;
    }
    warnings.push_back(t.warning);
  }
  return warnings;
}

}  // namespace tack
