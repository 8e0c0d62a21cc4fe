#include "framework/output/energy_losses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/stepping/energy_advice.hpp"

namespace tack {
namespace {

constexpr double most_of_it = 0.8;
constexpr size_t most_told = 3;  // lines of groups

struct Told {
  double fraction;  // of what was at play
  Warning warning;
};

std::string percent(double share) { return share < 0.1 ? fmt::format("{:.2g}%", 100 * share) : fmt::format("{:.0f}%", 100 * share); }

}  // namespace

void EnergyLosses::Cause::add(const StepReport& report, double dissipated, double jerk, bool contact) {
  losing = std::max(0.0, losing + dissipated);
  making = std::max(0.0, making - dissipated - jerk);
  lost = std::max(lost, losing);
  made = std::max(made, making);
  sum += dissipated;
  in_contact += contact ? dissipated : 0;
  when.add(report.time - report.step_size / 2, report.step_size, dissipated);
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

std::vector<Warning> EnergyLosses::told(const TimeIntegrator& rule, const std::vector<std::string>& group_names) const {
  std::vector<Told> told;
  // of: the scene, or one of its groups.
  const auto look = [&](WarningKind kind, const Cause& cause, const auto& of, const std::string& group, const char* what, const auto& advice) {
    const bool made = cause.made > cause.lost;
    const double joules = made ? cause.made : cause.lost;
    if (joules <= tolerated * of.reference_energy + std::sqrt(of.noise)) return;
    if (!made && kind == WarningKind::energy_integration && rule.damps() && of.moving < motion * of.reference_energy) return;
    const auto [from, to] = cause.when.densest(made ? -most_of_it * joules : most_of_it * joules);
    told.push_back({joules / of.reference_energy,
                    {kind, fmt::format("energy{}: {} {} {:.3g} J, {} of the most that was at play ({:.3g} J), most of it from t = {:.4g} to {:.4g} s: {}",
                                       group.empty() ? "" : " of " + group, what, made ? "made" : "lost", joules, percent(joules / of.reference_energy), of.reference_energy, from, to,
                                       advice(made, cause)), group}});
  };
  const auto of_areas = [](bool, const Cause&) { return areas_advice; };
  const auto of_repeats = [](bool, const Cause&) { return repeats_advice; };
  const auto of_rule = [&](bool made, const Cause& cause) { return rule.energy_advice(made, 2 * std::abs(cause.in_contact) > std::abs(cause.sum)); };
  const bool by_groups = !groups.empty() && groups.size() == group_names.size() && std::none_of(groups.begin(), groups.end(), [](const Group& g) { return g.met_another; });
  if (by_groups) {
    for (size_t g = 0; g < groups.size(); ++g) {
      // Areas of all contact changed the energy by more than they can have in the group.
      const bool areas_count = std::max(areas.lost, areas.made) > tolerated * groups[g].reference_energy;
      const char* what = areas_count ? "time integration and areas of contact" : "time integration";
      look(WarningKind::energy_integration, groups[g].integrator, groups[g], group_names[g], what, of_rule);
      look(WarningKind::energy_repeats, groups[g].repeated, groups[g], group_names[g], "repeated steps", of_repeats);
    }
  } else {
    look(WarningKind::energy_areas, areas, *this, "", "areas of contact", of_areas);
    look(WarningKind::energy_repeats, repeated, *this, "", "repeated steps", of_repeats);
    look(WarningKind::energy_integration, integrator, *this, "", "time integration", of_rule);
  }
  std::stable_sort(told.begin(), told.end(), [](const Told& a, const Told& b) { return a.fraction > b.fraction; });
  std::vector<Warning> warnings;
  for (const Told& t : told) {
    if (by_groups && warnings.size() == most_told) {
      warnings.emplace_back(WarningKind::energy_further_groups, fmt::format("energy: {} more groups of bodies lost or gained more than {:g}% of what was at play", told.size() - most_told, 100 * tolerated));
      break;
    }
    warnings.push_back(t.warning);
  }
  return warnings;
}

}  // namespace tack
