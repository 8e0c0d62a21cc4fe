// Runs the scenes of experiments/hard.
//   tack_hard check NAME             with the default solver; fails unless it ends as its scene says
//   tack_hard table FILE [--plugin LIBRARY]... [--solver SOLVER]... [NAME...]
//                                    all, or those named, with every solver of the page, or with
//                                    these (hard_solver()); writes the page
//   tack_hard covers FILE            fails unless the page has a row for every scene
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <thread>

#include "tests/hard/robustness_table.hpp"
#include "tests/support/program.hpp"

namespace tack {
namespace {

int check(const std::string& name) {
  const HardCase c = read_hard_case(TACK_SOURCE_DIR "/experiments/hard/" + name + ".yaml");
  const HardOutcome outcome = run_hard_case(c, hard_solvers().front());
  const std::string error = fault(c, outcome);
  fmt::print("{}{}: {}\n", outcome.output, name, error.empty() ? "ends as it must" : error);
  return error.empty() ? 0 : 1;
}

struct TableOptions {
  std::vector<std::string> names, plugins;
  std::vector<HardSolver> solvers;
};

// Reads the words after `table FILE`. Throws std::runtime_error for an unknown option.
TableOptions table_options(const std::vector<std::string>& words) {
  TableOptions options;
  for (size_t i = 0; i < words.size(); ++i) {
    const bool plugin = words[i] == "--plugin", solver = words[i] == "--solver";
    if ((plugin || solver) && i + 1 < words.size()) {
      const std::string& value = words[++i];
      if (plugin) options.plugins.push_back(std::filesystem::absolute(value).string());
      else options.solvers.push_back(hard_solver(value));
    } else if (words[i].starts_with("-")) {
      throw std::runtime_error("unknown option " + words[i]);
    } else {
      options.names.push_back(words[i]);
    }
  }
  if (options.solvers.empty()) options.solvers = hard_solvers();
  return options;
}

// Runs all cases, two at a time, each on one thread.
void run_all(std::vector<HardRow>& rows, const TableOptions& options) {
  const size_t solvers = options.solvers.size();
  std::atomic<size_t> next = 0;
  const auto work = [&] {
    for (size_t i; (i = next++) < rows.size() * solvers;) {
      HardRow& row = rows[i / solvers];
      const HardSolver& solver = options.solvers[i % solvers];
      row.outcomes[i % solvers] = run_hard_case(row.hard, solver, options.plugins);
      fmt::print("{}, {}: {}\n", row.hard.name, solver.name, row.outcomes[i % solvers].exit_code);
      std::fflush(stdout);
    }
  };
  std::jthread other(work);
  work();
}

int table(const std::string& file, const std::vector<std::string>& words) {
  const TableOptions options = table_options(words);
  std::vector<HardRow> rows;
  for (const HardCase& c : hard_cases())
    if (options.names.empty() || std::find(options.names.begin(), options.names.end(), c.name) != options.names.end())
      rows.push_back({c, std::vector<HardOutcome>(options.solvers.size())});
  if (rows.empty()) throw std::runtime_error("no scene of experiments/hard has such a name");
  run_all(rows, options);
  write_file(file, robustness_page(rows, options.solvers));
  return 0;
}

int covers(const std::string& file) {
  const std::vector<std::string> missing = missing_rows(file_text(file), hard_cases());
  for (const std::string& name : missing) fmt::print("{} has no row for {}; rewrite it with `table`\n", file, name);
  return missing.empty() ? 0 : 1;
}

}  // namespace
}  // namespace tack

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.size() == 2 && words[0] == "check") return tack::check(words[1]);
    if (words.size() >= 2 && words[0] == "table") return tack::table(words[1], {words.begin() + 2, words.end()});
    if (words.size() == 2 && words[0] == "covers") return tack::covers(words[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  }
  fmt::print(stderr, "usage: tack_hard check NAME | table FILE [--plugin LIBRARY]... [--solver SOLVER]... [NAME...] | covers FILE\n");
  return 2;
}
