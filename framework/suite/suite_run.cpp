#include "framework/suite/suite_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "framework/batch/child_process.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds poll_interval{5};
// Processor time of a process beside that of its solve and its check, each up to the limit [s].
constexpr double loading_seconds_max = 60;
// Wall time of a process over its processor time, above which it hangs.
constexpr double wall_per_cpu_max = 20;

struct Solve {
  size_t row = 0;
  std::string file;  // of the problem
  fs::path json, output;
  std::optional<ChildProcess> process;
  bool killed = false;
};

std::optional<double> number(const nlohmann::json& json, const char* key) {
  const auto at = json.find(key);
  return at != json.end() && at->is_number() ? std::optional<double>(at->get<double>()) : std::nullopt;
}

// Returns the text after the last "error: " of the output of a process; its last line otherwise.
std::string error_in(const fs::path& output) {
  std::ifstream in(output, std::ios::binary);
  std::string error, last;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
    if (const size_t at = line.find("error: "); at != line.npos) error = line.substr(at + 7);
  }
  return error.empty() ? last : error;
}

ChildProcess started(const SuiteSettings& settings, const std::string& program, const Solve& solve, const SuiteRow& row) {
  std::vector<std::string> arguments{program, "solve", solve.file, "--solver", row.solver, "--no-minimum", "--check", "--json", solve.json.string(),
                                     "--cpu-limit", fmt::format("{}", settings.cpu_limit), "--threads", fmt::format("{}", settings.threads),
                                     "--tolerance-scale", fmt::format("{}", row.tolerance_scale)};
  for (const std::string& plugin : settings.plugins) arguments.insert(arguments.end(), {"--plugin", plugin});
  return {arguments, solve.output};
}

void read_result(const nlohmann::json& solved, const SuiteSettings& settings, SuiteRow& row) {
  row.status = solved.value("status", "");
  row.iterations = number(solved, "iterations");
  row.evaluations = number(solved, "evaluations");
  row.linear_solves = number(solved, "linear_solves");
  row.seconds = number(solved, "cpu_seconds");
  row.wall_seconds = number(solved, "wall_seconds");
  row.residual = number(solved, "residual");
  row.judged_residual = number(solved, "judged_residual");
  row.distance = number(solved, "distance");
  row.energy_gap = number(solved, "energy_gap");
  row.intersections = number(solved, "intersections");
  if (const auto check = solved.find("check"); check != solved.end()) {
    row.error = number(*check, "error");
    row.minimum = check->value("minimum", "");
  }
  const bool converged = solved.value("converged", false);
  if (row.intersections.value_or(0) > 0) row.outcome = SuiteOutcome::intersects;
  else if (row.seconds.value_or(0) > settings.cpu_limit) row.outcome = SuiteOutcome::time_limit;
  else if (!converged) row.outcome = SuiteOutcome::failed;
  else row.outcome = row.judged_residual.value_or(0) > judged_residual_max ? SuiteOutcome::inexact : SuiteOutcome::solved;
  if (row.outcome == SuiteOutcome::time_limit && converged) row.status = "converged after the time limit";
}

void read_problem(const nlohmann::json& json, SuiteProblem& problem) {
  problem.program = json.value("program", "");
  problem.unknowns = number(json, "unknowns");
  problem.step_size = number(json, "step_size");
  problem.minimum_tolerance = number(json, "minimum_tolerance");
  problem.quasi_static = json.value("quasi_static", false);
}

// Fills the row of a process that has ended.
void settle(const Solve& solve, const SuiteSettings& settings, SuiteRow& row, SuiteProblem& problem) {
  std::ifstream in(solve.json);
  const nlohmann::json json = in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
  const int code = solve.process->exit_code(), signal = solve.process->signal();
  if (solve.killed) {
    row.outcome = SuiteOutcome::time_limit;
    row.status = "killed: it did not end at its time limit";
  } else if (json.is_object() && json.contains("solves") && !json["solves"].empty()) {
    read_problem(json, problem);
    read_result(json["solves"][0], settings, row);
  } else if (signal != 0) {
    row.status = fmt::format("ended by signal {} ({})", signal, ::strsignal(signal));
  } else {
    row.status = error_in(solve.output);
    if (code == 2) row.outcome = SuiteOutcome::refused;
    else if (code == 3 && !row.status.empty()) row.outcome = SuiteOutcome::failed;
    else row.status = fmt::format("ended with code {}: {}", code, row.status);
  }
}

// Kills a process that has used more than loading, its solve and its check may take.
void enforce_limits(Solve& solve, const SuiteSettings& settings) {
  const double limit = loading_seconds_max + 2.5 * settings.cpu_limit;
  if (solve.killed || (solve.process->cpu_seconds() < limit && solve.process->seconds() < wall_per_cpu_max * limit)) return;
  solve.killed = true;
  solve.process->send(SIGKILL);
}

}  // namespace

std::string_view to_string(SuiteOutcome outcome) {
  switch (outcome) {
    case SuiteOutcome::solved: return "solved";
    case SuiteOutcome::inexact: return "inexact";
    case SuiteOutcome::intersects: return "intersects";
    case SuiteOutcome::failed: return "failed";
    case SuiteOutcome::time_limit: return "time limit";
    case SuiteOutcome::refused: return "refused";
    case SuiteOutcome::crashed: return "crashed";
  }
  return "";
}

SuiteResult run_suite(const SuiteSettings& settings, const std::string& program, const fs::path& scratch,
                      const std::function<void(const SuiteResult&, const SuiteRow&)>& ended) {
  SuiteResult result;
  std::vector<Solve> solves;
  std::vector<size_t> problem_of;  // per row
  for (const std::string& file : settings.problems) {
    result.problems.push_back({fs::path(file).stem().string(), file, "", {}, {}, {}, false});
    for (const double scale : settings.tolerance_scales)
      for (const std::string& solver : settings.solvers) {
        SuiteRow row;
        row.problem = result.problems.back().name;
        row.solver = solver;
        row.tolerance_scale = scale;
        const std::string stem = fmt::format("{}", result.rows.size());
        Solve solve;
        solve.row = result.rows.size();
        solve.file = file;
        solve.json = scratch / (stem + ".json");
        solve.output = scratch / (stem + ".txt");
        solves.push_back(std::move(solve));
        problem_of.push_back(result.problems.size() - 1);
        result.rows.push_back(std::move(row));
      }
  }
  std::vector<SuiteRow> rows = std::exchange(result.rows, {});
  std::vector<bool> done(rows.size(), false);
  size_t next = 0, appended = 0;
  std::vector<size_t> running;
  while ((next < solves.size() || !running.empty()) && !interrupt_requested) {
    while (next < solves.size() && running.size() < static_cast<size_t>(std::max(settings.jobs, 1))) {
      solves[next].process.emplace(started(settings, program, solves[next], rows[next]));
      running.push_back(next++);
    }
    std::erase_if(running, [&](size_t i) {
      if (!solves[i].process->ended()) {
        enforce_limits(solves[i], settings);
        return false;
      }
      settle(solves[i], settings, rows[i], result.problems[problem_of[i]]);
      done[i] = true;
      // Rows keep their order, whichever process ends first.
      for (; appended < rows.size() && done[appended]; ++appended) result.rows.push_back(rows[appended]);
      ended(result, rows[i]);
      solves[i].process.reset();
      return true;
    });
    std::this_thread::sleep_for(poll_interval);
  }
  return result;
}

std::vector<std::string> problem_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!fs::exists(path)) throw InputError(fmt::format("{}: there is no such file or folder", path));
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    const size_t before = files.size();
    for (const auto& entry : fs::directory_iterator(path))
      if (entry.path().extension() == ".problem") files.push_back(entry.path().string());
    if (files.size() == before)
      throw InputError(fmt::format("{}: has no stored step (*.problem); `tack run FILE --dump-problem hardest=1` stores one", path));
  }
  const auto name = [](const std::string& file) { return fs::path(file).stem().string(); };
  std::sort(files.begin(), files.end(), [&](const std::string& a, const std::string& b) { return std::pair(name(a), a) < std::pair(name(b), b); });
  for (size_t i = 1; i < files.size(); ++i)
    if (name(files[i]) == name(files[i - 1]))
      throw InputError(fmt::format("{} and {} have one name; rename one of them", files[i - 1], files[i]));
  return files;
}

}  // namespace tack
