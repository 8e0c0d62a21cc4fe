// tack solve: one stored step with one or several solvers, a line for each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/app/commands.hpp"
#include "framework/app/interrupt_signals.hpp"
#include "framework/app/thread_limit.hpp"
#include "framework/config/parse.hpp"
#include "framework/plugin/plugins.hpp"
#include "framework/run/stored_step.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

std::string minimum_text(const StoredStep& step, const SolveOptions& options, bool found) {
  if (options.no_minimum && !step.has_minimum()) return "no minimum is known";
  if (!step.has_minimum()) return "no minimum was found";
  const std::string tolerance = fmt::format("to {:.0e} m/s", step.minimum_tolerance());
  if (!found) return "its minimum is stored " + tolerance;
  if (options.store_minimum) return "its minimum was found " + tolerance + " and stored";
  return "its minimum was found " + tolerance + " (--store-minimum keeps it)";
}

using Json = nlohmann::ordered_json;

Json to_json(std::optional<double> number) { return number && std::isfinite(*number) ? Json(*number) : Json(); }

// Returns one solve for --json; units as in StoredSolve. check: null without --check.
Json to_json(const std::string& solver, const StoredSolve& s, const StoredCheck* check) {
  Json json = {{"solver", solver}, {"status", s.status}, {"converged", s.converged}, {"iterations", s.iterations}, {"evaluations", s.evaluations},
               {"linear_solves", s.linear_solves}, {"cpu_seconds", s.cpu_seconds}, {"wall_seconds", s.wall_seconds}, {"residual", to_json(s.residual)},
               {"judged_residual", to_json(s.judged_residual)}, {"distance", to_json(s.distance)}, {"energy_gap", to_json(s.energy_gap)},
               {"intersections", s.x.size() > 0 ? Json(s.intersections) : Json()}};
  if (check) json["check"] = {{"minimum", to_string(check->minimum)}, {"error", to_json(check->error)}};
  return json;
}

}  // namespace

int solve_command(const SolveOptions& options) {
  let_signals_interrupt();
  const ThreadLimit threads(options.threads);
  for (const std::string& plugin : options.plugins) load_plugin(std::filesystem::absolute(plugin).string());
  if (options.store_minimum && !options.step.overrides.empty())
    throw InputError("--store-minimum: the minimum of another problem than the stored one is not kept; leave --set away");
  StoredStep step(options.step.file, options.step.overrides);
  std::vector<Value> solvers;
  for (const std::string& text : options.solvers) solvers.push_back(parse_string(text, "--solver " + text));
  if (solvers.empty()) solvers.emplace_back();
  const bool found = !step.has_minimum() && !options.no_minimum && step.find_minimum();
  if (found && options.store_minimum) step.store_minimum();
  fmt::print("{}: {} unknowns, step of {:.6g} s; {}\n", options.step.file, step.unknowns(), step.step_size(), minimum_text(step, options, found));

  size_t width = 6;
  for (const std::string& text : options.solvers) width = std::max(width, text.size());
  fmt::print("{:{}}  iterations  evaluations     CPU s  distance  residual  status\n", "solver", width);
  bool all = true;
  Json solves = Json::array();
  for (size_t i = 0; i < solvers.size(); ++i) {
    const StoredSolve solved = step.solve(solvers[i], {options.cpu_limit, options.tolerance_scale, options.check, {}});
    const std::string distance = solved.distance ? fmt::format("{:.1e}", *solved.distance) : "-";
    const std::string name = options.solvers.empty() ? "scene" : options.solvers[i];
    const std::string crossing = solved.intersections > 0 ? ", and intersects" : "";
    fmt::print("{:{}}  {:10}  {:11}  {:8.4f}  {:>8}  {:8.2g}  {}{}\n", name, width, solved.iterations, solved.evaluations, solved.cpu_seconds, distance,
               solved.residual, solved.status, crossing);
    all &= solved.converged && solved.intersections == 0;
    StoredCheck check;
    if (options.check) {
      check = step.check(solved, options.cpu_limit);
      fmt::print("{:{}}  minimum: {}; error {}, residual of the Newton direction {}\n", "", width, check.minimum == Minimum::unknown ? "not found" : to_string(check.minimum),
                 check.error ? fmt::format("{:.1e}", *check.error) : "-", solved.judged_residual ? fmt::format("{:.2g}", *solved.judged_residual) : "-");
    }
    solves.push_back(to_json(name, solved, options.check ? &check : nullptr));
  }
  const Json result = {{"problem", options.step.file}, {"program", step.program()}, {"unknowns", step.unknowns()}, {"step_size", step.step_size()},
                       {"quasi_static", step.quasi_static()}, {"minimum_tolerance", step.has_minimum() ? Json(step.minimum_tolerance()) : Json()},
                       {"solves", solves}};
  if (!options.json.empty()) replace_file(options.json, result.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return all ? exit_done : exit_simulation_failed;
}

}  // namespace tack
