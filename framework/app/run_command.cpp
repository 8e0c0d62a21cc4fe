// tack run: an experiment from file to results.
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iostream>

#include "framework/app/commands.hpp"
#include "framework/app/problem_dump.hpp"
#include "framework/app/thread_limit.hpp"
#include "framework/app/version.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/describe.hpp"
#include "framework/core/interrupt.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "framework/experiment/stored_experiment.hpp"
#include "framework/experiment/tolerances.hpp"
#include "framework/output/checkpoints.hpp"
#include "framework/output/next_due.hpp"
#include "framework/output/progress.hpp"
#include "framework/output/recorder.hpp"
#include "framework/output/summary.hpp"
#include "framework/profile/profiler.hpp"
#include "framework/scene/resolution.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

extern "C" void request_interrupt(int) { interrupt_requested = true; }

void write_resolved(const RunFolder& folder, const Experiment& experiment) {
  std::ofstream out(folder.scene());
  out << to_yaml(fields_of(experiment));
  out.close();
  if (!out) throw InputError(fmt::format("cannot write {}", folder.scene().string()));
}

void warn_of_weak_wells(const World& world, Progress& progress) {
  for (const AdhesionSummary& a : world.adhesion)
    if (a.loss() > AdhesionSummary::tolerated_loss)
      progress.warning(fmt::format(
          "adhesion '{}' - '{}': the barrier's stiffness takes {:.0f}% of the work of adhesion "
          "({:.4g} of {:.4g} J/m^2 remain); lower contact.barrier.stiffness",
          a.between[0], a.between[1], 100 * a.loss(), a.effective, a.work_of_adhesion));
}

ProgressOptions progress_options(const RunOptions& options) {
  ProgressOptions p;
  if (options.quiet) p.verbosity = Verbosity::quiet;
  if (options.verbose) p.verbosity = Verbosity::verbose;
  p.live_width = terminal_width(STDOUT_FILENO);
  return p;
}

RunFolder folder_of(const RunOptions& options, const Experiment& experiment) {
  const std::filesystem::path root = RunFolder::chosen_root(options.output, experiment.name);
  return options.resume ? RunFolder::open(root) : RunFolder::create(root);
}

// What is to be measured writes no frames, unless it is told to.
std::vector<std::string> overrides_of(const RunOptions& options) {
  std::vector<std::string> overrides = options.scene.overrides;
  if (options.profile) overrides.insert(overrides.begin(), "output.frames=false");
  return overrides;
}

// A run under way: what the loop needs and what remains of it.
class Run {
 public:
  Run(const RunOptions& options, int threads)
      : options_(options), dump_(options.dump_problems),
        built_(load_experiment(options.scene.file, overrides_of(options))),
        probes_(probes_of(built_)), folder_(folder_of(options, experiment_)), checkpoint_(checkpoint()),
        log_(folder_.log(), checkpoint_ ? std::ios::app : std::ios::trunc),
        progress_(std::cout, &log_, progress_options(options)) {
    if (checkpoint_) set_totals(summary_, checkpoint_->totals);
    else write_resolved(folder_, experiment_);
    phases_before_ = summary_.phases;
    summary_.name = experiment_.name;
    summary_.version = TACK_VERSION;
    summary_.commit = TACK_COMMIT;
    summary_.threads = threads;
    summary_.dofs = world_.dofs.size();
    summary_.adhesion = world_.adhesion;
    if (options.profile) profiler_.emplace(world_, *experiment_.solver, clock_);
  }

  int execute() {
    if (folder_.moved_aside())
      progress_.message(fmt::format("earlier results moved to {}", folder_.moved_aside()->string()));
    progress_.message(fmt::format("{}: {} objects, {} vertices, {} unknowns, {} threads", summary_.name,
                                  world_.bodies.size(), world_.rest.size() / 3, summary_.dofs,
                                  summary_.threads));
    warn_of_weak_wells(world_, progress_);
    for (const std::string& line : resolution_warnings(experiment_, world_)) progress_.warning(line);
    for (const std::string& line : doubtful_tolerances(experiment_, world_)) progress_.warning(line);
    std::optional<double> resumed_at;
    if (checkpoint_) resumed_at = checkpoint_->state.time;
    Recorder recorder(experiment_.output, experiment_.time, probes_, world_, folder_, clock_, resumed_at);
    try {
      simulate(recorder);
    } catch (const SimulationError& error) {
      summary_.status = RunStatus::simulation_failed;
      summary_.error = error.what();
      progress_.warning(fmt::format("error: {}", error.what()));
    }
    return finish(recorder);
  }

 private:
  std::optional<StateFile> checkpoint() {
    if (!options_.resume) return std::nullopt;
    StateFile file = newest_checkpoint(folder_, to_yaml(fields_of(experiment_)), world_);
    check_size(file, world_.rest.size() / 3, folder_.checkpoints().string());
    return file;
  }

  // Goes on from a state as a program would that was started there: with a solver and candidates of
  // their own.
  void start_from(State state) {
    world_.start = std::move(state);
    world_.participants.forget();
    solver_ = instance_of(*experiment_.solver);
    stepper_.emplace(world_, experiment_, experiment_.time, *solver_, clock_,
                     [this](const std::string& line) { progress_.warning(line); });
    const auto tell = [this](int iteration, double residual, double, double) {
      progress_.iteration(stepper_->state().step + 1, stepper_->state().time, iteration, residual);
    };
    stepper_->observe(tell, tell);
    if (profiler_)
      stepper_->observe_steps([this](const VecX& x, const VecX& p, double feasible) { profiler_->tried(x, p, feasible); });
  }

  void simulate(Recorder& recorder) {
    if (checkpoint_) {
      progress_.message(fmt::format("resumed at step {}, t = {:.6g} s", checkpoint_->state.step,
                                    checkpoint_->state.time));
      start_from(checkpoint_->state);
    } else {
      start_from(world_.start);
      recorder.start(stepper_->state());
    }
    next_checkpoint_ = next_checkpoint_after(stepper_->state().time);
    progress_.begin(stepper_->state().time, experiment_.time.duration);
    while (!stepper_->finished() && (options_.steps == 0 || summary_.steps < options_.steps)) {
      prepare_dump();
      const StepReport report = stepper_->advance();
      if (stepper_->interrupted()) {
        summary_.status = RunStatus::interrupted;
        return;
      }
      if (profiler_) profiler_->step(stepper_->state(), report);
      dump_.after(report.solve.iterations);
      recorder.step(stepper_->state(), report);
      summary_.add(report);
      tell_linear_solver();
      progress_.step(report);
      write_checkpoint();
    }
  }

  // Once it has seen a system, and again when it has changed its mind.
  void tell_linear_solver() {
    const std::string solver = solver_->linear_solver();
    if (solver == summary_.linear_solver) return;
    summary_.linear_solver = solver;
    progress_.detail("linear solver: " + solver);
  }

  void prepare_dump() {
    if (!dump_.wants(stepper_->state().step + 1)) return;
    start_from(stepper_->state());
    dump_.before(world_.start, stepper_->next_step_size(),
                 [this](const State& state, double h, int iterations) { store_problem(state, h, iterations); });
  }

  void finish_dump() {
    dump_.finish([this](const State& state, double h, int iterations) { store_problem(state, h, iterations); });
    for (const int step : dump_.missed())
      progress_.warning(fmt::format("step {} was not reached: its problem is not stored", step));
  }

  StateFile state_file(StateFile::Kind kind, const State& state) {
    StateFile file = state_file_of(kind, experiment_);
    file.program = TACK_VERSION;
    file.commit = TACK_COMMIT;
    if (kind == StateFile::Kind::checkpoint) file.file_meshes = file_meshes_of(world_);
    file.state = state;
    return file;
  }

  void store_problem(const State& state, double h, int iterations) {
    const PhaseScope scope(clock_, Phase::io);
    StateFile file = state_file(StateFile::Kind::problem, state);
    file.step_size = h;
    std::filesystem::create_directories(folder_.problems());
    const std::string name = RunFolder::default_root(experiment_.name).filename();
    const auto path = folder_.problems() / fmt::format("{}.step{}.problem", name, state.step + 1);
    write_state_file(path, file);
    const std::string effort = iterations < 0 ? "" : fmt::format(" ({} iterations)", iterations);
    progress_.message(fmt::format("step {}{} stored as {}", state.step + 1, effort, path.string()));
  }

  double next_checkpoint_after(double time) const {
    const auto interval = experiment_.output.checkpoint_interval;
    if (!interval) return std::numeric_limits<double>::infinity();
    return next_due(*interval, time, experiment_.time.step);
  }

  void write_checkpoint() {
    const State& state = stepper_->state();
    if (state.time < next_checkpoint_ - 1e-9 * experiment_.time.step) return;
    next_checkpoint_ = next_checkpoint_after(state.time);
    const PhaseScope scope(clock_, Phase::io);
    StateFile file = state_file(StateFile::Kind::checkpoint, state);
    add_up_phases();
    file.totals = totals_of(summary_);
    write_state_file(checkpoint_path(folder_, state.step), file);
    start_from(state);
  }

  void add_up_phases() {
    const PhaseClock::Seconds& seconds = clock_.seconds();
    for (int i = 0; i < phase_count; ++i) summary_.phases[i] = phases_before_[i] + seconds[i];
  }

  std::string profile_of_run() {
    const Profile profile = profiler_->finish(stepper_->state(), summary_);
    write_profile(folder_.profile(), profile);
    return profile_tables(profile);
  }

  int finish(Recorder& recorder) {
    const bool complete = summary_.status == RunStatus::done && options_.steps == 0;
    if (complete) {
      for (const Expectation& expectation : experiment_.expect) {
        summary_.expect.push_back(evaluate(expectation, recorder.series()));
        if (!summary_.expect.back().pass) summary_.status = RunStatus::expectation_failed;
      }
    }
    finish_dump();
    add_up_phases();
    for (const double s : summary_.phases) summary_.wall_seconds += s;
    write_summary(folder_.summary(), summary_);
    progress_.finish();
    progress_.message(profiler_ && stepper_ ? profile_of_run() : phase_table(summary_));
    if (complete) progress_.message(expect_table(summary_.expect));
    progress_.message(fmt::format("{}: {} steps, {} Newton iterations, smallest gap {:.4g} m; results in {}",
                                  to_string(summary_.status), summary_.steps, summary_.newton_iterations,
                                  summary_.min_distance, folder_.root().string()));
    switch (summary_.status) {
      case RunStatus::done: return exit_done;
      case RunStatus::expectation_failed: return exit_expectation_failed;
      case RunStatus::simulation_failed: return exit_simulation_failed;
      case RunStatus::interrupted: return exit_interrupted;
    }
    return exit_done;
  }

  const RunOptions& options_;
  ProblemDump dump_;
  BuiltExperiment built_;
  const Experiment& experiment_ = built_.experiment();
  World& world_ = built_.world();
  PhaseClock& clock_ = built_.clock();
  ProbeSet probes_;
  RunFolder folder_;
  std::optional<StateFile> checkpoint_;  // that the run goes on from
  std::ofstream log_;
  Progress progress_;
  RunSummary summary_;
  PhaseClock::Seconds phases_before_{};  // of the run that is resumed
  std::optional<Profiler> profiler_;
  std::unique_ptr<Minimizer> solver_;
  std::optional<TimeStepper> stepper_;
  double next_checkpoint_ = 0;  // s
};

}  // namespace

int run_command(const RunOptions& options) {
  std::signal(SIGINT, request_interrupt);
  std::signal(SIGTERM, request_interrupt);
  const ThreadLimit threads(options.threads);
  return Run(options, threads.count()).execute();
}

}  // namespace tack
