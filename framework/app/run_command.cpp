// tack run, tack profile: runs an experiment file and writes its results.
#include <unistd.h>

#include <iostream>

#include "framework/app/commands.hpp"
#include "framework/app/interrupt_signals.hpp"
#include "framework/app/memory_limit.hpp"
#include "framework/app/thread_limit.hpp"
#include "geometry/errors.hpp"

namespace tack {

ProgressOptions progress_options(const RunOptions& options) {
  ProgressOptions p;
  if (options.quiet) p.verbosity = Verbosity::quiet;
  if (options.verbose) p.verbosity = Verbosity::verbose;
  p.live_width = terminal_width(STDOUT_FILENO);
  return p;
}

int exit_code(RunStatus status) {
  switch (status) {
    case RunStatus::done: return exit_done;
    case RunStatus::expectation_failed: return exit_expectation_failed;
    case RunStatus::simulation_failed: return exit_simulation_failed;
    case RunStatus::interrupted: return exit_interrupted;
  }
  return exit_done;
}

namespace {

// Returns the overrides of a run: with `profile`, no frames are written unless overrides ask for
// them.
std::vector<std::string> overrides_of(const RunOptions& options) {
  std::vector<std::string> overrides = overrides_with_plugins(options.scene);
  if (options.profile) overrides.insert(overrides.begin(), "output.frames=false");
  return overrides;
}

}  // namespace

int run_command(const RunOptions& options) {
  let_signals_interrupt();
  if (!options.cores.empty() && options.threads > 1)
    throw InputError("--cores predicts from a run with one thread: take --threads away");
  const ThreadLimit threads(options.cores.empty() ? options.threads : 1);
  check_address_space(threads.count());
  if (options.memory > 0) limit_memory(options.memory * 1e9, threads.count());
  RecordedRun run(load_experiment(options.scene.file, overrides_of(options)), options,
                  provenance_of(options.command_line, threads.count()), std::cout, progress_options(options));
  return exit_code(run.execute().status);
}

}  // namespace tack
