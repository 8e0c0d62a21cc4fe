#include "framework/app/experiment.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <unistd.h>

#include <fstream>
#include <iostream>

#include "framework/app/commands.hpp"
#include "framework/app/version.hpp"
#include "framework/config/describe.hpp"
#include "framework/output/progress.hpp"
#include "framework/output/recorder.hpp"
#include "framework/output/summary.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

void write_resolved(const RunFolder& folder, SceneConfig& scene) {
  std::ofstream out(folder.scene());
  out << to_yaml(fields_of(scene));
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

ProgressOptions progress_options(const ExperimentOptions& options) {
  ProgressOptions p;
  if (options.quiet) p.verbosity = Verbosity::quiet;
  if (options.verbose) p.verbosity = Verbosity::verbose;
  p.live_width = terminal_width(STDOUT_FILENO);
  return p;
}

std::filesystem::path root_of(const ExperimentOptions& options, const SceneConfig& scene) {
  if (options.output.empty()) return RunFolder::default_root(scene.name);
  return options.output;
}

// A run under way: what the loop needs and what remains of it.
class Run {
 public:
  Run(const ExperimentOptions& options, int threads)
      : options_(options), scene_(load_scene(options.scene.file, options.scene.overrides)),
        world_(build_world(scene_.config, scene_.root, clock_)),
        columns_(prepare_probes(scene_, *world_)),
        folder_(RunFolder::create(root_of(options, scene_.config))),
        log_(folder_.log()), progress_(std::cout, &log_, progress_options(options)) {
    write_resolved(folder_, scene_.config);
    summary_.name = scene_.config.name;
    summary_.version = TACK_VERSION;
    summary_.commit = TACK_COMMIT;
    summary_.threads = threads;
    summary_.dofs = world_->dofs.size();
    summary_.adhesion = world_->adhesion;
  }

  int execute() {
    if (folder_.moved_aside())
      progress_.message(fmt::format("earlier results moved to {}", folder_.moved_aside()->string()));
    progress_.message(fmt::format("{}: {} objects, {} vertices, {} unknowns, {} threads", summary_.name,
                                  world_->bodies.size(), world_->rest.size() / 3, summary_.dofs,
                                  summary_.threads));
    warn_of_weak_wells(*world_, progress_);
    Recorder recorder(scene_, *world_, folder_, columns_, clock_);
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
  void simulate(Recorder& recorder) {
    TimeStepper stepper(*world_, scene_.config, clock_,
                        [this](const std::string& line) { progress_.warning(line); });
    recorder.start(stepper.state());
    progress_.begin(0, scene_.config.time.duration);
    while (!stepper.finished() && (options_.steps == 0 || summary_.steps < options_.steps)) {
      const StepReport report = stepper.advance();
      if (stepper.interrupted()) {
        summary_.status = RunStatus::interrupted;
        return;
      }
      recorder.step(stepper.state(), report);
      summary_.add(report);
      tell_linear_solver();
      progress_.step(report);
    }
  }

  // Once it has seen a system, and again when it has changed its mind.
  void tell_linear_solver() {
    const std::string solver = scene_.config.solver->linear_solver();
    if (solver == summary_.linear_solver) return;
    summary_.linear_solver = solver;
    progress_.detail("linear solver: " + solver);
  }

  int finish(Recorder& recorder) {
    const bool complete = summary_.status == RunStatus::done && options_.steps == 0;
    if (complete) {
      for (const Expectation& expectation : scene_.config.expect) {
        summary_.expect.push_back(evaluate(expectation, recorder.series()));
        if (!summary_.expect.back().pass) summary_.status = RunStatus::expectation_failed;
      }
    }
    summary_.phases = clock_.seconds();
    for (const double s : summary_.phases) summary_.wall_seconds += s;
    write_summary(folder_.summary(), summary_);
    progress_.finish();
    progress_.message(phase_table(summary_));
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

  const ExperimentOptions& options_;
  PhaseClock clock_;
  LoadedScene scene_;
  std::unique_ptr<World> world_;
  std::vector<std::string> columns_;
  RunFolder folder_;
  std::ofstream log_;
  Progress progress_;
  RunSummary summary_;
};

}  // namespace

int run_experiment(const ExperimentOptions& options) {
  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<size_t>(threads));
  return Run(options, threads).execute();
}

}  // namespace tack
