// tack compare: speed against error of several solvers on the same problems.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>

#include "framework/app/commands.hpp"
#include "framework/app/thread_limit.hpp"
#include "framework/compare/compare_csv.hpp"
#include "framework/compare/compare_json.hpp"
#include "framework/compare/plots.hpp"
#include "framework/compare/report.hpp"
#include "framework/config/retired_keys.hpp"
#include "framework/output/run_folder.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

// Prints warnings of a scene; a stored problem has the keys of the program that stored it.
void warn_of_retired_keys(const CompareCase& c) {
  if (c.problem) return;
  const LoadedExperiment loaded = c.load();
  for (const std::string& line : retired_key_texts(loaded.root, fields_of(loaded.experiment))) fmt::print("warning: {}\n", line);
}

}  // namespace

int compare_command(const CompareOptions& options) {
  const auto started = std::chrono::steady_clock::now();
  const ThreadLimit threads(options.threads);
  Provenance provenance = provenance_of(options.command_line, threads.count());
  const CompareConfig config = load_comparison(options.file.file, options.file.overrides);
  const std::vector<CompareCase> cases = cases_of(config);
  for (const CompareCase& c : cases) warn_of_retired_keys(c);
  const RunFolder folder =
      RunFolder::create(RunFolder::chosen_root(options.output, config.name));
  if (folder.moved_aside() && !options.quiet) fmt::print("earlier results moved to {}\n", folder.moved_aside()->string());
  const Comparison result = compare(config, cases, [&](const std::string& line) {
    if (!options.quiet) fmt::print("{}\n", line);
    std::fflush(stdout);
  });
  write_compare_csv(folder.root() / "compare.csv", result.rows);
  provenance.plugins = loaded_plugins();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
  replace_file(folder.root() / "compare.md", compare_report(config, result, provenance, wall.count()));
  replace_file(folder.root() / "compare.json", compare_json(config, result, provenance, wall.count()));
  for (const std::string& failure : draw_plots(result, folder.root())) fmt::print("{}\n", failure);
  if (!options.quiet) fmt::print("results in {}\n", folder.root().string());
  return exit_done;
}

}  // namespace tack
