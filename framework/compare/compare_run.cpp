#include "framework/compare/compare_run.hpp"

#include <fmt/format.h>

#include <chrono>

#include "framework/compare/compare_csv.hpp"
#include "framework/compare/compare_json.hpp"
#include "framework/compare/plots.hpp"
#include "framework/compare/report.hpp"
#include "framework/config/retired_keys.hpp"
#include "framework/output/run_folder.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

// Returns warnings of a scene; a stored problem has the keys of the program that stored it.
std::vector<std::string> retired_keys_of(const CompareCase& c) {
  if (c.problem) return {};
  const LoadedExperiment loaded = c.load();
  return retired_key_texts(loaded.root, fields_of(loaded.experiment));
}

}  // namespace

std::filesystem::path run_comparison(const ComparisonSettings& settings, const std::function<void(const std::string&)>& print) {
  const auto started = std::chrono::steady_clock::now();
  const CompareConfig config = load_comparison(settings.file, settings.overrides);
  const std::vector<CompareCase> cases = cases_of(config);
  for (const CompareCase& c : cases)
    for (const std::string& line : retired_keys_of(c)) print("warning: " + line);
  const RunFolder folder = RunFolder::create(RunFolder::chosen_root(settings.output, config.name));
  if (folder.moved_aside()) print(fmt::format("earlier results moved to {}", folder.moved_aside()->string()));
  const Comparison result = compare(config, cases, print);
  write_compare_csv(folder.root() / "compare.csv", result.rows);
  Provenance provenance = settings.provenance;
  provenance.plugins = loaded_plugins();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - started;
  replace_file(folder.root() / "compare.md", compare_report(config, result, provenance, wall.count()));
  replace_file(folder.root() / "compare.json", compare_json(config, result, provenance, wall.count()));
  for (const std::string& failure : draw_plots(result, folder.root())) print(failure);
  return folder.root();
}

}  // namespace tack
