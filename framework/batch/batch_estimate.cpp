#include "framework/batch/batch_estimate.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <thread>

#include "framework/output/csv.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

struct Scratch {
  fs::path path = fs::temp_directory_path() / fmt::format("tack_trial_{}", ::getpid());
  Scratch() { fs::create_directories(path); }
  ~Scratch() {
    std::error_code none;
    fs::remove_all(path, none);
  }
};

// Returns the estimated seconds of a case from a trial run of its beginning.
double trial_of(const std::string& program, const BatchCase& one, const BatchLimits& limits, double trial) {
  const Scratch scratch;
  replace_file(scratch.path / "scene.yaml", one.scene);
  std::vector<std::string> arguments{program, "run", scratch.path / "scene.yaml", "-o", scratch.path / "run", "--threads",
                                     fmt::format("{}", limits.threads)};
  if (limits.memory) arguments.insert(arguments.end(), {"--memory", fmt::format("{}", *limits.memory)});
  arguments.insert(arguments.end(), {"--set", "output.frames=false", fmt::format("time.wall_limit={} s", trial)});
  ChildProcess process(arguments, scratch.path / "output.txt");
  // Its results are not needed: an interrupt kills it.
  while (!process.ended() && !interrupt_requested) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  if (interrupt_requested) throw Interrupted{"while the duration of a case was estimated; none was run"};
  try {
    const CsvTable steps = read_csv(scratch.path / "run" / "steps.csv");
    const auto time = steps.column("time");
    if (!time || steps.rows.empty() || steps.rows.back()[*time] <= 0) return process.seconds();
    return process.seconds() * std::max(1.0, one.duration / steps.rows.back()[*time]);
  } catch (const InputError&) {
    return process.seconds();
  }
}

}  // namespace

BatchEstimate estimate_of(const std::string& program, const BatchFolder& folder, const BatchPlan& plan, const BatchLimits& limits,
                          const std::vector<const BatchCase*>& open, double trial) {
  BatchEstimate estimate;
  std::map<std::string, int> known;
  for (const BatchCase& one : plan.cases) {
    const CaseState state = state_of(folder, one);
    if (state.status != CaseStatus::done && state.status != CaseStatus::expectation_failed) continue;
    double& mean = estimate.of_case[one.base];
    mean += (state.wall_seconds - mean) / ++known[one.base];
  }
  for (const BatchCase* one : open) {
    if (!estimate.of_case.contains(one->base)) {
      estimate.of_case[one->base] = trial_of(program, *one, limits, trial);
      estimate.at_most = estimate.at_most || (one->may_end_early && estimate.of_case[one->base] > trial);
    }
    estimate.seconds += estimate.of_case[one->base];
  }
  estimate.seconds /= std::min<double>(limits.jobs, std::max<size_t>(1, open.size()));
  return estimate;
}

}  // namespace tack
