// tack suite: all problems of folders with all solvers, and a leaderboard.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/app/interrupt_signals.hpp"
#include "framework/config/registry.hpp"
#include "framework/core/minimizer.hpp"
#include "framework/output/run_folder.hpp"
#include "framework/plugin/plugins.hpp"
#include "framework/report/report.hpp"
#include "framework/suite/leaderboard.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/io/replace_file.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// Returns the suite of the source tree in the working directory, or that of the installation.
std::string shipped_suite() {
  if (const fs::path here = "experiments/suite"; fs::is_directory(here)) return here.string();
  const fs::path shared = shared_file("experiments/suite");
  if (fs::is_directory(shared)) return shared.string();
  throw InputError("there is no folder experiments/suite here; name a folder with stored steps (*.problem)");
}

SuiteSettings settings_of(const SuiteOptions& options) {
  SuiteSettings settings;
  for (const std::string& plugin : options.plugins) {
    settings.plugins.push_back(fs::absolute(plugin).string());
    load_plugin(settings.plugins.back());
  }
  settings.problems = problem_files(options.paths.empty() ? std::vector{shipped_suite()} : options.paths);
  settings.solvers = options.solvers.empty() ? Registry<Minimizer>::kind().names() : options.solvers;
  if (!options.tolerance_scales.empty()) settings.tolerance_scales = options.tolerance_scales;
  settings.cpu_limit = options.cpu_limit;
  settings.threads = options.threads;
  settings.jobs = options.jobs;
  return settings;
}

void print_row(const SuiteRow& row, size_t done, size_t all) {
  const std::string scale = row.tolerance_scale == 1 ? "" : fmt::format(" at {:g} of the tolerances", row.tolerance_scale);
  fmt::print("{} of {}: {}, {}{}: {}", done, all, row.problem, row.solver, scale, to_string(row.outcome));
  if (row.iterations && row.seconds) fmt::print(", {} iterations, {:.3g} s", *row.iterations, *row.seconds);
  fmt::print("{}\n", row.solved() || row.status.empty() ? "" : " (" + row.status + ")");
  std::fflush(stdout);
}

}  // namespace

int suite_command(const SuiteOptions& options) {
  let_signals_interrupt();
  const auto started = std::chrono::steady_clock::now();
  Provenance provenance = provenance_of(options.command_line, options.threads);
  const SuiteSettings settings = settings_of(options);
  provenance.plugins = loaded_plugins();
  const RunFolder folder = RunFolder::create(RunFolder::chosen_root(options.output, "suite"));
  if (folder.moved_aside() && !options.quiet) fmt::print("earlier results moved to {}\n", folder.moved_aside()->string());
  const fs::path solves = folder.root() / "solves";
  fs::create_directories(solves);
  const size_t all = settings.problems.size() * settings.tolerance_scales.size() * settings.solvers.size();
  size_t done = 0;
  const auto write = [&](const SuiteResult& result) {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
    write_leaderboard_csv(folder.root() / "leaderboard.csv", result.rows);
    replace_file(folder.root() / "leaderboard.json", leaderboard_json(settings, result, provenance, wall.count(), done == all));
  };
  const SuiteResult result = run_suite(settings, fs::read_symlink("/proc/self/exe").string(), solves, [&](const SuiteResult& so_far, const SuiteRow& row) {
    ++done;
    if (!options.quiet) print_row(row, done, all);
    write(so_far);
  });
  write(result);
  fs::remove_all(solves);
  fmt::print("{}", score_table(scores_of(result.rows, settings.cpu_limit)));
  try {
    ReportSettings report;
    report.folders = {folder.root()};
    report.version = this_build().version;
    report.commit = this_build().revision();
    write_report(report);
  } catch (const InputError& error) {
    fmt::print("no page: {}\n", error.what());
  }
  if (!options.quiet) fmt::print("results in {}\n", folder.root().string());
  return interrupt_requested ? exit_interrupted : exit_done;
}

}  // namespace tack
