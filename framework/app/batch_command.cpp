// tack batch: many experiments, side by side on this machine or as a Slurm job array, and one table
// of their results.
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <thread>

#include "framework/app/commands.hpp"
#include "framework/app/interrupt_signals.hpp"
#include "framework/batch/batch_estimate.hpp"
#include "framework/batch/batch_preparation.hpp"
#include "framework/batch/batch_progress.hpp"
#include "framework/batch/resolved_case.hpp"
#include "framework/batch/slurm.hpp"
#include "framework/batch/slurm_tasks.hpp"
#include "framework/config/read_file.hpp"
#include "framework/config/words.hpp"
#include "framework/output/progress.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

constexpr double trial_seconds_max = 3;
constexpr size_t shown_cases_max = 40;

std::string this_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

// Prints the progress of the work before the first case if it takes a while: on a terminal, in one
// line.
class Preparation {
 public:
  Preparation(int live_width, bool quiet) : live_(live_width > 0), quiet_(quiet) {}
  ~Preparation() {
    if (shown_ && live_) fmt::print("\r\x1b[K");
    std::fflush(stdout);
  }
  void report(const char* what, size_t done, size_t all) {
    if (interrupt_requested) throw Interrupted{"while cases were planned; none was run"};
    const auto now = std::chrono::steady_clock::now();
    if (quiet_ || now - reported_ < (live_ ? std::chrono::milliseconds(200) : std::chrono::seconds(5))) return;
    reported_ = now;
    shown_ = true;
    fmt::print("{}{} {} of {}{}", live_ ? "\r" : "", what, done, counted(all, "case"), live_ ? "\x1b[K" : "\n");
    std::fflush(stdout);
  }

 private:
  bool live_, quiet_, shown_ = false;
  std::chrono::steady_clock::time_point reported_ = std::chrono::steady_clock::now();
};

std::optional<BatchTable> chosen_table(const BatchOptions& options) {
  if (options.table.empty()) return std::nullopt;
  return options.table == "hdf5" ? BatchTable::hdf5 : BatchTable::csv;
}

// Returns the exit code for the cases named by `only`.
int report(const BatchFolder& folder, const BatchDescription& description, bool quiet, const std::vector<std::string>& only = {}) {
  const std::vector<CaseState> states = write_batch_table(folder, description);
  std::map<CaseStatus, size_t> counts;
  for (const CaseState& state : states) ++counts[state.status];
  std::vector<std::string> parts;
  for (const auto& [status, count] : counts) parts.push_back(fmt::format("{} {}", count, to_string(status)));
  bool all_done = true, expectations_only = true;
  for (size_t i = 0; i < states.size(); ++i) {
    if (!is_named(only, description.plan.cases[i])) continue;
    const CaseStatus status = states[i].status;
    all_done = all_done && status == CaseStatus::done;
    expectations_only = expectations_only && (status == CaseStatus::done || status == CaseStatus::expectation_failed);
  }
  if (!quiet)
    fmt::print("{}: {}: {}; table in {}\n", description.plan.name, counted(description.plan.cases.size(), "case"),
               fmt::join(parts, ", "), (description.table == BatchTable::hdf5 ? folder.hdf5() : folder.table()).string());
  if (all_done) return exit_done;
  return expectations_only ? exit_expectation_failed : exit_simulation_failed;
}

void show_plan(const BatchFolder& folder, const BatchDescription& d, const std::vector<const BatchCase*>& open) {
  for (size_t i = 0; i < std::min(d.plan.cases.size(), shown_cases_max); ++i) {
    const BatchCase& one = d.plan.cases[i];
    fmt::print("  {}  {}\n", one.name, to_string(state_of(folder, one).status));
  }
  if (d.plan.cases.size() > shown_cases_max) fmt::print("  and {} more\n", d.plan.cases.size() - shown_cases_max);
  fmt::print("{}: {}, {} to run; {} side by side with {} each\n", d.plan.name, counted(d.plan.cases.size(), "case"), open.size(),
             d.limits.jobs, counted(d.limits.threads, "thread"));
  if (open.empty()) return;
  const BatchEstimate estimate = estimate_of(this_program(), folder, d.plan, d.limits, open, trial_seconds_max);
  for (const auto& [base, seconds] : estimate.of_case) fmt::print("a case of {} takes {} {}\n", base, estimate.about(), short_duration(seconds));
  fmt::print("{} {} in all{}; nothing was run yet\n", estimate.about(), short_duration(estimate.seconds), estimate.condition());
}

// Follows the states that the tasks of the job array write, until all tasks have ended.
void follow(SlurmJobs& jobs, const BatchFolder& folder, const std::vector<const BatchCase*>& open, BatchProgress& progress) {
  const BatchObserver observer = progress.observer();
  std::set<const BatchCase*> ended;
  const auto report_ended_cases = [&] {
    for (const BatchCase* one : open) {
      const CaseState state = state_of(folder, *one);
      if (finished(state.status) && ended.insert(one).second) observer.ended(*one, state);
    }
  };
  while (!jobs.ended() && !interrupt_requested) {
    report_ended_cases();
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  report_ended_cases();
}

int run_by_slurm(const BatchOptions& options, const BatchConfig& config, const BatchFolder& folder, const BatchDescription& d,
                 const std::vector<const BatchCase*>& open) {
  if (config.slurm.requeues > 0)
    for (const BatchCase* one : open)
      if (!one->checkpoints)
        throw InputError(fmt::format("slurm.requeues: case '{}' writes no checkpoints and would start from the beginning each time; "
                                     "give `set: [output.checkpoint_interval=...]`", one->name));
  std::vector<size_t> tasks;
  for (const BatchCase* one : open) {
    tasks.push_back(static_cast<size_t>(one - d.plan.cases.data()));
    replace_file(folder.scene(one->name), one->scene);
    // The failed cases run again: without their states, their tasks do not skip them.
    std::filesystem::remove(folder.state(one->name));
  }
  SlurmJobs jobs = submit(this_program(), folder, config.slurm, d, tasks, !options.no_wait);
  const std::string later = fmt::format("the table is made by `tack batch --collect {}`", folder.root.string());
  if (interrupt_requested) {
    fmt::print("interrupted: {}; another call submits the cases that are left; {}\n", jobs.running_text(), later);
    return exit_interrupted;
  }
  if (options.no_wait) {
    fmt::print("{} submitted: {}; {}\n", jobs.names(), counted(open.size(), "case"), later);
    return exit_done;
  }
  if (!options.quiet) fmt::print("{} submitted: {}\n", jobs.names(), counted(open.size(), "case"));
  {
    BatchProgress progress(std::cout, d.plan.cases.size(), open.size(), d.limits.jobs, 0, options.quiet);
    follow(jobs, folder, open, progress);
  }
  if (interrupt_requested) {
    fmt::print("interrupted: {}; {}\n", jobs.running_text(), later);
    return exit_interrupted;
  }
  return report(folder, d, options.quiet, options.only);
}

PreparedBatch prepared(const BatchConfig& config, const BatchSettings& settings, bool quiet) {
  Preparation preparation(terminal_width(STDOUT_FILENO), quiet);
  PreparationObserver observer;
  observer.progress = [&](const char* what, size_t done, size_t all) { preparation.report(what, done, all); };
  observer.print = [&](const std::string& line) {
    if (!quiet) fmt::print("{}\n", line);
  };
  return prepare_batch(config, settings, observer);
}

std::atomic<bool> time_limit_reached = false;

extern "C" void end_at_time_limit(int) {
  time_limit_reached = true;
  interrupt_requested = true;
}

// Queues the task of a case again, unless Slurm has restarted it `requeues` times.
void requeue(int requeues, const BatchFolder& folder, const BatchCase& one) {
  const char* restarts = std::getenv("SLURM_RESTART_COUNT");  // not set in the first run
  if (restarts && std::atoi(restarts) >= requeues) {
    fmt::print("{}: not queued again after {}\n", one.name, counted(static_cast<size_t>(requeues), "restart"));
    return;
  }
  fmt::print("{}: queued again\n", one.name);
  std::fflush(stdout);  // Slurm kills this process
  requeue_this_job(folder.root / "output" / "requeue.txt");
}

// Runs one case, as a task of a job array.
int run_task(const BatchOptions& options) {
  const BatchFolder folder = BatchFolder::found(options.output);
  SlurmTask task = read_task(folder, *options.task);
  BatchCase& one = task.one;
  if (!one.digest.ends_with(" " + program_digest()))
    throw InputError(fmt::format("{}: was planned by another build of tack; call `tack batch` again", folder.description().string()));
  one.scene = read_file(folder.scene(one.name), std::uintmax_t{1} << 30);
  if (finished(state_of(folder, one).status)) return exit_done;
  if (options.requeues > 0) std::signal(SIGUSR1, end_at_time_limit);
  run_cases(this_program(), folder, task.limits, {&one}, {});
  const CaseState state = state_of(folder, one);
  fmt::print("{}: {} {}\n", one.name, to_string(state.status), state.error);
  if (time_limit_reached && state.status == CaseStatus::interrupted) requeue(options.requeues, folder, one);
  return exit_done;  // the case's state file records how it ended
}

}  // namespace

int batch_command(const BatchOptions& options) {
  let_signals_interrupt();
  if (options.task) return run_task(options);
  if (!options.collect.empty()) {
    const BatchFolder folder = BatchFolder::found(options.collect);
    BatchDescription d = read_description(folder);
    d.table = chosen_table(options).value_or(d.table);
    return report(folder, d, options.quiet);
  }
  const BatchConfig config = load_batch(options.file.file, options.file.overrides);
  BatchSettings settings;
  settings.file = std::filesystem::absolute(options.file.file).lexically_normal().string();
  settings.output = options.output;
  settings.jobs = options.jobs;
  settings.threads = options.threads;
  settings.provenance = provenance_of(options.command_line, options.threads > 0 ? options.threads : config.threads);
  settings.table = chosen_table(options);
  settings.only = options.only;
  settings.rerun_failed = options.failed;
  settings.dry_run = options.dry_run;
  const PreparedBatch batch = prepared(config, settings, options.quiet);
  const BatchFolder& folder = batch.folder;
  const BatchDescription& d = batch.description;
  const std::vector<const BatchCase*>& open = batch.open;
  const size_t done = batch.done;
  if (options.dry_run) {
    show_plan(folder, d, open);
    return exit_done;
  }
  if (done > 0 && !options.quiet) fmt::print("{} of {} are done already\n", done, counted(d.plan.cases.size(), "case"));
  if (options.slurm && !open.empty()) return run_by_slurm(options, config, folder, d, open);
  {
    BatchProgress progress(std::cout, done + open.size(), open.size(), d.limits.jobs, terminal_width(STDOUT_FILENO), options.quiet);
    run_cases(this_program(), folder, d.limits, open, progress.observer());
  }
  const int code = report(folder, d, options.quiet, options.only);
  return interrupt_requested ? exit_interrupted : code;
}

}  // namespace tack
