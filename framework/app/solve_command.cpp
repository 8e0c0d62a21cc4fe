// tack solve: one stored step with one or several solvers, a line for each.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/app/interrupt_signals.hpp"
#include "framework/app/thread_limit.hpp"
#include "framework/config/parse.hpp"
#include "framework/plugin/plugins.hpp"
#include "framework/run/stored_step.hpp"
#include "geometry/errors.hpp"

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
  for (size_t i = 0; i < solvers.size(); ++i) {
    const StoredSolve solved = step.solve(solvers[i]);
    const std::string distance = solved.distance ? fmt::format("{:.1e}", *solved.distance) : "-";
    fmt::print("{:{}}  {:10}  {:11}  {:8.4f}  {:>8}  {:8.2g}  {}\n", options.solvers.empty() ? "scene" : options.solvers[i], width, solved.iterations,
               solved.evaluations, solved.cpu_seconds, distance, solved.residual, solved.status);
    all &= solved.converged;
  }
  return all ? exit_done : exit_simulation_failed;
}

}  // namespace tack
