// States that a run stores: checkpoints, and problems of single steps.
#include <fmt/format.h>

#include <limits>

#include "framework/experiment/stored_experiment.hpp"
#include "framework/output/next_due.hpp"
#include "framework/run/recorded_run.hpp"

namespace tack {

void RecordedRun::prepare_dump() {
  if (!dump_.wants(simulation_.state().step + 1)) return;
  simulation_.start_from(simulation_.state());
  dump_.before(world().start, simulation_.stepper().next_step_size(),
               [this](const State& state, double h, int iterations) { store_problem(state, h, iterations); });
}

void RecordedRun::finish_dump() {
  dump_.finish([this](const State& state, double h, int iterations) { store_problem(state, h, iterations); });
  for (const int step : dump_.missed())
    warn({WarningKind::problem_not_stored, fmt::format("step {} was not reached: its problem is not stored", step)});
}

StateFile RecordedRun::state_file(StateFile::Kind kind, const State& state) const {
  StateFile file = state_file_of(kind, experiment_);
  file.program = summary_.provenance.build.version;
  file.commit = summary_.provenance.build.revision();
  file.objects = state_objects(world());
  file.flowed = simulation_.built().flowed();
  if (kind == StateFile::Kind::checkpoint) {
    file.file_meshes = file_meshes_of(world());
    file.plugins = plugin_checksums();
    file.files = files_;
  }
  file.state = state;
  return file;
}

void RecordedRun::store_problem(const State& state, double h, int iterations) {
  const PhaseScope scope(clock_, Phase::io);
  StateFile file = state_file(StateFile::Kind::problem, state);
  file.step_size = h;
  std::filesystem::create_directories(folder_.problems());
  const std::string name = RunFolder::default_root(experiment_.name).filename();
  const size_t stages = experiment_.time.integrator->stages().size();
  const auto path = folder_.problems() / fmt::format("{}.step{}{}.problem", name, state.step + 1, stages > 1 ? ".stage1" : "");
  write_state_file(path, file);
  const std::string effort = iterations < 0 ? "" : fmt::format(" ({} iterations{})", iterations, stages > 1 ? " in all stages" : "");
  const std::string stage = stages > 1 ? fmt::format(", the first of {} stages,", stages) : "";
  progress_.message(fmt::format("step {}{}{} stored as {}", state.step + 1, effort, stage, path.string()));
}

double RecordedRun::next_checkpoint_after(double time) const {
  const auto interval = experiment_.output.checkpoint_interval;
  if (!interval) return std::numeric_limits<double>::infinity();
  return next_due(*interval, time, experiment_.time.step);
}

void RecordedRun::write_checkpoint(Recorder& recorder) {
  const State& state = simulation_.state();
  if (state.time < next_checkpoint_ - 1e-9 * experiment_.time.step) return;
  next_checkpoint_ = next_checkpoint_after(state.time);
  store_checkpoint(checkpoint_path(folder_, state.step), recorder);
  if (gradients_) restart_gradients();
  simulation_.start_from(state);
}

// Writes a checkpoint if the run has no checkpoint interval. With an interval, resuming repeats the
// steps since the last checkpoint and has the bits of an uninterrupted run, because its solver
// starts afresh there, too.
void RecordedRun::store_interrupted(Recorder& recorder) {
  if (experiment_.output.checkpoint_interval || summary_.steps == 0) return;
  const int step = simulation_.state().step;
  store_checkpoint(interrupted_path(folder_, step), recorder);
  progress_.message(fmt::format("state of step {} is kept: --resume goes on from there", step));
}

// A resumed run continues the list of frames up to the checkpoint, so they are written first.
void RecordedRun::store_checkpoint(const std::filesystem::path& path, Recorder& recorder) {
  const PhaseScope scope(clock_, Phase::io);
  recorder.flush();
  StateFile file = state_file(StateFile::Kind::checkpoint, simulation_.state());
  if (gradients_) gradients_->store(file.state.history);
  add_up_phases();
  file.totals = totals_of(summary_);
  file.warnings = summary_.warnings;
  file.linear_solver = summary_.linear_solver;
  file.remeshings = summary_.remeshings;
  std::error_code failed;  // writing reports the error
  std::filesystem::create_directory(path.parent_path(), failed);
  write_state_file(path, file);
}

}  // namespace tack
