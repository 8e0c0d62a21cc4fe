// Sums of a run so far as named numbers, for checkpoints.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "framework/output/summary.hpp"

namespace tack {
namespace {

const std::string stepper_prefix = "stepper_";
const std::string group_prefix = "group_";  // of bodies, by number

// Calls act(name, number) for every sum over the steps of a run.
template <class Summary, class Act>
void for_each_total(Summary& s, const Act& act) {
  act("steps", s.steps);
  act("converged_steps", s.converged_steps);
  act("failed_solves", s.failed_solves);
  act("smallest_step", s.smallest_step);
  act("largest_step", s.largest_step);
  act("stepped_time", s.stepped_time);
  act("repeated_steps", s.repeated_steps);
  act("unconverged_lags", s.unconverged_lags);
  act("newton_iterations", s.newton_iterations);
  act("linear_solves", s.linear_solves);
  act("linear_iterations", s.linear_iterations);
  act("line_search_evaluations", s.line_search_evaluations);
  act("broad_phase_builds", s.broad_phase_builds);
  act("max_contacts", s.max_contacts);
  act("min_distance", s.min_distance);
  act("min_gap", s.min_gap);
  act("max_unbalanced_force", s.max_unbalanced_force);
  act("unbalanced_steps", s.unbalanced_steps);
  act("max_affine_strain", s.max_affine_strain);
  act("lowest_quality", s.lowest_quality);
  act("intersections", s.intersections);
  act("inverted_tets", s.inverted_tets);
  EnergyFlows::for_each(s.flows, act);
  act("damped_steps", s.damped_steps);
  act("refined_steps", s.refined_steps);
  act("energy_at_play", s.losses.reference_energy);
  act("energy_moving", s.losses.moving);
  act("energy_noise", s.losses.noise);
  const auto of_cause = [&](const std::string& cause, auto& c) {
    const auto add_total = [&](const char* name, auto& number) { act(fmt::format("energy_{}_{}", cause, name), number); };
    add_total("lost", c.lost);
    add_total("made", c.gained);
    add_total("losing", c.losing);
    add_total("making", c.gaining);
    add_total("sum", c.sum);
    add_total("in_contact", c.in_contact);
    add_total("bin", c.over_time.width);
    for (std::size_t i = 0; i < c.over_time.sums.size(); ++i) act(fmt::format("energy_{}_in_bin_{}", cause, i), c.over_time.sums[i]);
  };
  EnergyLosses::for_each(s.losses, of_cause);
  for (std::size_t g = 0; g < s.losses.groups.size(); ++g) {
    auto& group = s.losses.groups[g];
    const std::string name = fmt::format("{}{}_", group_prefix, g);
    of_cause(name + "integrator", group.integrator);
    of_cause(name + "repeated", group.repeated);
    act("energy_" + name + "at_play", group.reference_energy);
    act("energy_" + name + "moving", group.moving);
    act("energy_" + name + "noise", group.noise);
    act("energy_" + name + "met_another", group.met_another);
  }
  act("energy_gains", s.energy_gains);
  for (int i = 0; i < phase_count; ++i) act(fmt::format("seconds_{}", phase_names[i]), s.phases[i]);
}

}  // namespace

std::map<std::string, double> totals_of(const RunSummary& summary) {
  std::map<std::string, double> totals;
  for_each_total(summary, [&](const std::string& name, auto number) { totals[name] = static_cast<double>(number); });
  for (const auto& [name, number] : summary.stepper) totals[stepper_prefix + name] = number;
  return totals;
}

void set_totals(RunSummary& summary, const std::map<std::string, double>& totals) {
  const std::string prefix = "energy_" + group_prefix;
  for (const auto& [name, total] : totals)
    if (name.starts_with(prefix)) summary.losses.groups.resize(std::max(summary.losses.groups.size(), std::stoul(name.substr(prefix.size())) + 1));
  // Flows that a stepper publishes are unknown before the stepper exists.
  const std::map<std::string, double> known = totals_of(summary);
  for (const auto& [name, total] : totals) {
    const bool lost = name.starts_with("dissipated_");
    if ((lost || name.starts_with("work_")) && !known.contains(name)) summary.flows.amount(name, lost ? FlowKind::dissipated : FlowKind::within);
  }
  for_each_total(summary, [&]<class Number>(const std::string& name, Number& number) {
    if (const auto found = totals.find(name); found != totals.end()) number = static_cast<Number>(found->second);
  });
  for (const auto& [name, number] : totals)
    if (name.starts_with(stepper_prefix)) summary.stepper[name.substr(stepper_prefix.size())] = number;
}

}  // namespace tack
