#include "framework/suite/leaderboard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/output/csv.hpp"
#include "framework/output/provenance_json.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

std::string cell(const std::optional<double>& number) { return number ? fmt::format("{}", *number) : ""; }
Json to_json(const std::optional<double>& number) { return number ? Json(*number) : Json(); }

Json to_json(const SuiteProblem& p) {
  return {{"name", p.name}, {"file", p.file}, {"program", p.program}, {"unknowns", to_json(p.unknowns)}, {"step_size", to_json(p.step_size)},
          {"quasi_static", p.quasi_static}, {"minimum_tolerance", to_json(p.minimum_tolerance)}};
}

Json to_json(const SolverScore& s) {
  Json json = {{"solver", s.solver}, {"tasks", s.tasks}};
  for (int i = 0; i < suite_outcomes; ++i) json[std::string(to_string(static_cast<SuiteOutcome>(i)))] = s.count[static_cast<size_t>(i)];
  json["other_minima"] = s.other_minima;
  json["penalized_seconds"] = s.penalized_seconds;
  return json;
}

}  // namespace

std::vector<SolverScore> scores_of(const std::vector<SuiteRow>& rows, double cpu_limit) {
  std::vector<SolverScore> scores;
  for (const SuiteRow& row : rows) {
    auto at = std::find_if(scores.begin(), scores.end(), [&](const SolverScore& s) { return s.solver == row.solver; });
    if (at == scores.end()) {
      scores.emplace_back().solver = row.solver;
      at = scores.end() - 1;
    }
    ++at->tasks;
    ++at->count[static_cast<size_t>(row.outcome)];
    at->other_minima += row.solved() && row.minimum == "another" ? 1 : 0;
    at->penalized_seconds += row.solved() ? row.seconds.value_or(0) : 2 * cpu_limit;
  }
  for (SolverScore& s : scores) s.penalized_seconds /= s.tasks;
  std::stable_sort(scores.begin(), scores.end(), [](const SolverScore& a, const SolverScore& b) {
    return a.solved() != b.solved() ? a.solved() > b.solved() : a.penalized_seconds < b.penalized_seconds;
  });
  return scores;
}

std::string score_table(const std::vector<SolverScore>& scores) {
  size_t width = 6;
  for (const SolverScore& s : scores) width = std::max(width, s.solver.size());
  std::string table = fmt::format("{:{}}  tasks", "solver", width);
  for (int i = 0; i < suite_outcomes; ++i) table += fmt::format("  {}", to_string(static_cast<SuiteOutcome>(i)));
  table += "  PAR2 [s]\n";
  for (const SolverScore& s : scores) {
    table += fmt::format("{:{}}  {:5}", s.solver, width, s.tasks);
    for (int i = 0; i < suite_outcomes; ++i)
      table += fmt::format("  {:{}}", s.count[static_cast<size_t>(i)], to_string(static_cast<SuiteOutcome>(i)).size());
    table += fmt::format("  {:8.3g}\n", s.penalized_seconds);
  }
  return table;
}

void write_leaderboard_csv(const std::filesystem::path& path, const std::vector<SuiteRow>& rows) {
  std::string out = "problem,solver,tolerance_scale,outcome,status,iterations,evaluations,linear_solves,seconds,wall_seconds,residual,judged_residual,"
                    "distance,error,minimum,energy_gap,intersections\n";
  for (const SuiteRow& r : rows)
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(r.problem), csv_cell(r.solver), r.tolerance_scale, to_string(r.outcome),
                       csv_cell(r.status), cell(r.iterations), cell(r.evaluations), cell(r.linear_solves), cell(r.seconds), cell(r.wall_seconds),
                       cell(r.residual), cell(r.judged_residual), cell(r.distance), cell(r.error), r.minimum, cell(r.energy_gap), cell(r.intersections));
  replace_file(path, out);
}

std::string leaderboard_json(const SuiteSettings& settings, const SuiteResult& result, const Provenance& provenance, double wall_seconds, bool complete) {
  Json problems = Json::array(), scores = Json::array();
  for (const SuiteProblem& p : result.problems) problems.push_back(to_json(p));
  for (const SolverScore& s : scores_of(result.rows, settings.cpu_limit)) scores.push_back(to_json(s));
  const Json json = {{"provenance", tack::to_json(provenance)}, {"complete", complete}, {"cpu_limit", settings.cpu_limit},
                     {"judged_residual_max", judged_residual_max}, {"tolerance_scales", settings.tolerance_scales}, {"threads", settings.threads},
                     {"jobs", settings.jobs}, {"wall_seconds", wall_seconds}, {"solvers", settings.solvers}, {"problems", problems}, {"scores", scores}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tack
