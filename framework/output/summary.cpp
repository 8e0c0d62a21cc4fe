#include "framework/output/summary.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framework/output/provenance_json.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson finite(double number) { return std::isfinite(number) ? OrderedJson(number) : OrderedJson(); }

OrderedJson phases_json(const PhaseClock::Seconds& phases) {
  OrderedJson json = OrderedJson::object();
  for (int i = 0; i < phase_count; ++i) json[std::string(phase_names[i])] = finite(phases[i]);
  return json;
}

OrderedJson adhesion_json(const std::vector<AdhesionSummary>& pairs) {
  OrderedJson list = OrderedJson::array();
  for (const AdhesionSummary& a : pairs) {
    list.push_back({{"between", a.between},
                    {"work_of_adhesion", finite(a.work_of_adhesion)},
                    {"effective", finite(a.effective)},
                    {"rest_gap", finite(a.rest_gap)},
                    {"peak_traction", finite(a.peak_traction)}});
    if (a.region_pair >= 0) list.back()["parts"] = true;
  }
  return list;
}

OrderedJson stiffness_json(const UsedStiffness& used) {
  OrderedJson barriers = OrderedJson::array(), affine = OrderedJson::array();
  for (const auto& b : used.barriers) barriers.push_back({{"between", b.between}, {"pairs", finite(b.pairs)}, {"stiffness", finite(b.stiffness)}});
  for (const auto& a : used.affine) affine.push_back({{"object", a.object}, {"objects", a.objects}, {"stiffness", finite(a.stiffness)}});
  return {{"barriers", std::move(barriers)}, {"affine", std::move(affine)}};
}

OrderedJson expect_json(const std::vector<ExpectationResult>& results) {
  OrderedJson list = OrderedJson::array();
  for (const ExpectationResult& r : results) {
    list.push_back({{"name", r.name},
                    {"value", finite(r.value)},
                    {"target", finite(r.target)},
                    {"tolerance", finite(r.tolerance)},
                    {"at_least", finite(r.at_least)},
                    {"at_most", finite(r.at_most)},
                    {"pass", r.pass},
                    {"text", r.text}});
  }
  return list;
}

OrderedJson warnings_json(const std::vector<WarningCount>& warnings) {
  OrderedJson list = OrderedJson::array();
  for (const WarningCount& w : warnings) list.push_back({{"kind", entry_of(w.first.kind).key}, {"text", w.first.text}, {"times", w.times}});
  return list;
}

OrderedJson remeshings_json(const std::vector<Remeshing>& all) {
  OrderedJson list = OrderedJson::array();
  for (const Remeshing& r : all)
    list.push_back({{"object", r.object}, {"step", r.step}, {"time", r.time}, {"quality_before", finite(r.before)}, {"quality_after", finite(r.after)},
                    {"tets_before", r.tets_before}, {"tets_after", r.tets_after}, {"lost", finite(r.lost)}});
  return list;
}

OrderedJson stages_json(const std::vector<StageVisit>& visits) {
  OrderedJson list = OrderedJson::array();
  for (const StageVisit& v : visits)
    list.push_back({{"protocol", v.protocol}, {"stage", v.stage}, {"number", v.number}, {"begin", finite(v.begin)}, {"end", finite(v.end)},
                    {"ended_by", v.ended_by}, {"value", finite(v.value)}, {"repeated", v.repeated}});
  return list;
}

OrderedJson totals_json(const RunSummary& s) {
  return {{"newton_iterations", s.newton_iterations},
          {"linear_solves", s.linear_solves},
          {"linear_iterations", s.linear_iterations},
          {"line_search_evaluations", s.line_search_evaluations},
          {"broad_phase_builds", s.broad_phase_builds}};
}

OrderedJson energy_json(const RunSummary& s) {
  OrderedJson json = OrderedJson::object();
  EnergyFlows::for_each(s.flows, [&](const std::string& name, double sum) { json[name] = finite(sum); });
  json["at_play"] = finite(s.losses.reference_energy);
  OrderedJson& causes = json["causes"] = OrderedJson::object();
  EnergyLosses::for_each(s.losses, [&](const char* name, const EnergyLosses::Cause& cause) {
    causes[name] = {{"lost", finite(cause.lost)}, {"made", finite(cause.gained)}, {"sum", finite(cause.sum)}, {"in_contact", finite(cause.in_contact)}};
  });
  OrderedJson& groups = json["groups"] = OrderedJson::array();
  for (size_t g = 0; g < std::min(s.losses.groups.size(), s.group_names.size()); ++g) {
    const EnergyLosses::Group& group = s.losses.groups[g];
    groups.push_back({{"objects", s.group_names[g]},
                      {"at_play", finite(group.reference_energy)},
                      {"lost", finite(std::max(group.integrator.lost, group.repeated.lost))},
                      {"made", finite(std::max(group.integrator.gained, group.repeated.gained))}});
  }
  json["damped_steps"] = s.damped_steps;
  json["refined_steps"] = s.refined_steps;
  json["gains"] = s.energy_gains;
  return json;
}

OrderedJson to_json(const RunSummary& s) {
  OrderedJson json = {{"name", s.name},
          {"version", s.provenance.build.version},
          {"commit", s.provenance.build.revision()},
          {"provenance", to_json(s.provenance)},
          {"status", to_string(s.status)},
          {"error", s.error},
          {"threads", s.provenance.threads},
          {"dofs", s.dofs},
          {"linear_solver", s.linear_solver},
          {"steps", s.steps},
          {"step_size", {{"smallest", finite(s.smallest_step)}, {"largest", finite(s.largest_step)}, {"mean", finite(s.stepped_time / s.steps)}}},
          {"converged_steps", s.converged_steps},
          {"failed_solves", s.failed_solves},
          {"repeated_steps", s.repeated_steps},
          {"unconverged_lags", s.unconverged_lags},
          {"wall_seconds", finite(s.wall_seconds)},
          {"phases", phases_json(s.phases)},
          {"totals", totals_json(s)},
          {"max_contacts", s.max_contacts},
          {"min_distance", finite(s.min_distance)},
          {"min_gap", finite(s.min_gap)},
          {"max_unbalanced_force", finite(s.max_unbalanced_force)},
          {"unbalanced_steps", s.unbalanced_steps},
          {"max_affine_strain", finite(s.max_affine_strain)},
          {"lowest_quality", finite(s.lowest_quality)},
          {"intersections", s.intersections},
          {"inverted_tets", s.inverted_tets},
          {"stepper", s.stepper},
          {"energy", energy_json(s)},
          {"adhesion", adhesion_json(s.adhesion)},
          {"stiffness", stiffness_json(s.stiffness)},
          {"meeting_groups", s.meeting_groups},
          {"remeshings", remeshings_json(s.remeshings)},
          {"warnings", warnings_json(s.warnings)},
          {"expect", expect_json(s.expect)}};
  if (!s.stages.empty()) json["stages"] = stages_json(s.stages);
  return json;
}

}  // namespace

std::string_view to_string(RunStatus status) {
  switch (status) {
    case RunStatus::done:
      return "done";
    case RunStatus::expectation_failed:
      return "expectation failed";
    case RunStatus::simulation_failed:
      return "simulation failed";
    case RunStatus::interrupted:
      return "interrupted";
  }
  return "";
}

bool RunSummary::add(const Warning& warning) {
  const auto same = std::find_if(warnings.begin(), warnings.end(), [&](const WarningCount& w) { return counted_together(w.first, warning); });
  if (same != warnings.end()) {
    same->times += entry_of(warning.kind).recurs ? 1 : 0;
    return false;
  }
  warnings.push_back({warning});
  return true;
}

void RunSummary::add(const StepReport& report) {
  ++steps;
  converged_steps += report.converged ? 1 : 0;
  failed_solves += report.rejections.cutbacks();
  repeated_steps += report.rejections[Rejection::error];
  smallest_step = std::min(smallest_step, report.step_size);
  largest_step = std::max(largest_step, report.step_size);
  stepped_time += report.step_size;
  unconverged_lags += report.lag_converged ? 0 : 1;
  newton_iterations += report.solve.iterations;
  linear_solves += report.solve.linear_solves;
  linear_iterations += report.solve.linear_iterations;
  line_search_evaluations += report.solve.line_search_evaluations;
  broad_phase_builds += report.broad_phase_builds;
  max_contacts = std::max(max_contacts, report.contacts);
  min_distance = std::min(min_distance, report.min_distance);
  min_gap = std::min(min_gap, report.min_gap);
  max_unbalanced_force = std::max(max_unbalanced_force, report.unbalanced_force);
  unbalanced_steps += report.converged && report.unbalanced_force > report.tolerated_force ? 1 : 0;
  max_affine_strain = std::max(max_affine_strain, report.affine_strain);
  intersections += report.intersections;
  inverted_tets += report.inverted_tets;
  for (const StepMetric& metric : report.metrics) {
    double& all = stepper[metric.name];
    all = metric.run_value == StepMetric::RunValue::sum ? all + metric.value : std::max(all, metric.value);
  }
  flows += report.flows;
  losses.add(report);
  refined_steps += report.flows.refined ? 1 : 0;
  damped_steps += report.flows.damped ? 1 : 0;
  energy_gains += report.flows.gained ? 1 : 0;
}

void write_summary(const std::filesystem::path& path, const RunSummary& summary) {
  // Names and paths in error texts need not be UTF-8.
  constexpr auto lenient = OrderedJson::error_handler_t::replace;
  replace_file(path, to_json(summary).dump(2, ' ', false, lenient) + "\n");
}

}  // namespace tack
