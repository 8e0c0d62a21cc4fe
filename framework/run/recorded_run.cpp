#include "framework/run/recorded_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/describe.hpp"
#include "framework/config/file_digest.hpp"
#include "framework/config/words.hpp"
#include "framework/config/yaml_text.hpp"
#include "framework/experiment/kept_expressions.hpp"
#include "framework/experiment/retired_key_warnings.hpp"
#include "framework/output/laws_csv.hpp"
#include "framework/output/measured_csv.hpp"
#include "framework/run/run_control.hpp"
#include "framework/run/scene_warnings.hpp"
#include "framework/setup/remesh_checks.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

// Sampling of mesh resolution, which changes little from step to step and is judged at the end.
constexpr int looks_at_first = 16, look_interval = 4;  // steps

// Returns the smallest gap between different objects, if any came near each other.
std::string smallest_gap_of(const RunSummary& s) {
  if (!std::isfinite(s.min_gap) && std::isfinite(s.min_distance)) return fmt::format("smallest gap of an object to itself {:.4g} m", s.min_distance);
  return fmt::format("smallest gap {:.4g} m", s.min_gap);
}

// Makes the gradients, with their errors, before anything is written.
std::optional<Gradients> gradients_of(BuiltExperiment& built) {
  if (built.experiment().output.gradients.empty()) return std::nullopt;
  return std::optional<Gradients>(std::in_place, built);
}

std::vector<std::string> object_names(const Experiment& experiment) {
  std::vector<std::string> names;
  for (const ObjectConfig& object : experiment.objects) names.push_back(object.name);
  return names;
}

// Checks the formats and opens the results folder.
RunFolder folder_of(const RunSettings& settings, const Experiment& experiment) {
  for (const auto& format : experiment.output.formats) format->check_objects(object_names(experiment));
  const std::filesystem::path root = RunFolder::chosen_root(settings.output, experiment.name);
  return settings.resume ? RunFolder::open(root) : RunFolder::create(root);
}

}  // namespace

RecordedRun::RecordedRun(LoadedExperiment loaded, const RunSettings& settings, const Provenance& provenance,
                         std::ostream& out, const ProgressOptions& progress)
    : settings_(settings), dump_(settings.dump_problems),
      simulation_(std::move(loaded), [this](const Warning& warning) { warn(warning); }),
      monitors_(std::in_place, simulation_.built()), gradients_(gradients_of(simulation_.built())), files_(file_digests(to_value(fields_of(experiment_)))), folder_(folder_of(settings, experiment_)), checkpoint_(checkpoint()),
      log_(folder_.log(), checkpoint_ ? std::ios::app : std::ios::trunc), progress_(out, &log_, progress) {
  if (settings.profile && any_remeshed(experiment_))
    throw InputError("a profile is of one world, and objects may be meshed anew (remesh); take that away (--set objects.NAME.remesh=null)");
  if (checkpoint_ && !checkpoint_->flowed.empty()) monitors_.emplace(simulation_.built());
  summary_.flows = EnergyFlows(world().records);
  if (checkpoint_) set_totals(summary_, checkpoint_->totals), summary_.warnings = checkpoint_->warnings, summary_.linear_solver = checkpoint_->linear_solver, summary_.remeshings = checkpoint_->remeshings;
  else replace_file(folder_.scene(), yaml_text(resolved_scene(simulation_.built().root(), experiment_)) + comments_of(used_stiffness(world()))), write_laws(folder_.laws(), world());
  phases_before_ = summary_.phases;
  summary_.name = experiment_.name;
  summary_.provenance = provenance;
  summary_.provenance.plugins = loaded_plugins();
  summary_.dofs = world().dofs.size();
  summary_.adhesion = world().adhesion;
  summary_.stiffness = used_stiffness(world());
  summary_.meeting_groups = meeting_names(world());
  if (settings.profile) profiler_.emplace(world(), *experiment_.solver, clock_, experiment_.contact ? experiment_.contact->contact_distance : 0.0, settings.cores);
  const auto report_iteration = [this](int iteration, double residual, double, double) {
    progress_.iteration(simulation_.state().step + 1, simulation_.state().time, iteration, residual);
    if (settings_.control) settings_.control->iteration(iteration, residual);
  };
  StepObservers observers{report_iteration, report_iteration, {}};
  if (gradients_) simulation_.observe_solved([this](const SolvedStep& step) { gradients_->follow_solve(step); });
  if (profiler_)
    observers.steps = [this](const VecX& x, const VecX& p, double feasible) { profiler_->tried(x, p, feasible); };
  simulation_.observe(std::move(observers));
}

RecordedRun::Monitors::Monitors(const BuiltExperiment& built)
    : probes(probes_of(built)), bent(built.experiment(), built.world()), quality(built.world()) {
  const Experiment& experiment = built.experiment();
  const World& world = built.world();
  if (!world.adhesion.empty()) adhesion.emplace(experiment, world);
  if (world.contact && !experiment.time.integrator->inertia()) approach.emplace(experiment, world);
}

const RunSummary& RecordedRun::execute() {
  report_start();
  std::optional<double> resumed_at;
  if (checkpoint_) resumed_at = checkpoint_->state.time;
  std::optional<Recorder> recorder(std::in_place, experiment_.output, experiment_.time, monitors_->probes, world(), folder_, clock_, resumed_at);
  try {
    simulate(recorder);
    recorder->flush();
  } catch (const SimulationError& error) {
    summary_.status = RunStatus::simulation_failed;
    summary_.error = error.what();
    progress_.failure(fmt::format("error: {}", error.what()));
  } catch (const std::bad_alloc&) {
    summary_.status = RunStatus::simulation_failed;
    summary_.error = fmt::format("not enough memory after {} steps; use fewer cells, or let the run have more", summary_.steps);
    progress_.failure("error: " + summary_.error);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    summary_.status = RunStatus::simulation_failed;
    summary_.error =
        fmt::format("step {} at t = {:.6g} s: a component failed: {}", simulation_.state().step + 1,
                    simulation_.state().time, error.what());
    progress_.failure("error: " + summary_.error);
  }
  if (recorder) recorder->flush();
  finish(recorder ? &recorder->series() : nullptr);
  export_frames();
  return summary_;
}

// Makes the further formats of output.formats from the frames. A run that failed reports an export
// that fails as a warning, because its own error is the one to look at.
void RecordedRun::export_frames() {
  std::error_code none;
  if (!std::filesystem::exists(folder_.pvd(), none)) return;
  for (const auto& format : experiment_.output.formats) try {
    const Exported made = format->write(folder_.root(), {});
    for (const std::string& note : made.notes) progress_.message("note: " + note);
    for (const auto& path : made.paths) progress_.message(fmt::format("{}: {}", format->type(), path.string()));
  } catch (const InputError& error) {
    if (summary_.status != RunStatus::simulation_failed) throw;
    progress_.warning(error.what());
  }
}

void RecordedRun::report_start() {
  if (folder_.moved_aside())
    progress_.message(fmt::format("earlier results moved to {}", folder_.moved_aside()->string()));
  progress_.message(fmt::format("{}: {} objects, {} vertices, {} unknowns, {} threads", summary_.name,
                                world().bodies.size(), world().rest.size() / 3, summary_.dofs, summary_.provenance.threads));
  for (const std::string& line : world().start_notes) progress_.message(line);
  for (const Warning& warning : retired_key_warnings(simulation_.built().root(), experiment_)) warn(warning);
  for (const Warning& warning : scene_warnings(experiment_, world())) warn(warning);
}

// Adds the warning to the summary as well.
void RecordedRun::warn(const Warning& warning) {
  summary_.add(warning);
  progress_.warning(warning.text);
}

std::optional<StateFile> RecordedRun::checkpoint() {
  if (!settings_.resume) return std::nullopt;
  StateFile file = newest_checkpoint(folder_, to_yaml(fields_of(experiment_)), world(), files_);
  if (!file.flowed.empty()) simulation_.rebuild(file.flowed);
  check_size(file, world().rest.size() / 3, folder_.checkpoints().string());
  return file;
}

void RecordedRun::simulate(std::optional<Recorder>& recorder) {
  if (checkpoint_) {
    progress_.message(fmt::format("resumed at step {}, t = {:.6g} s", checkpoint_->state.step,
                                  checkpoint_->state.time));
    if (gradients_) gradients_->start_from(checkpoint_->state);
    simulation_.start_from(checkpoint_->state);
    if (gradients_) gradients_csv_ = ProbesCsv::continued(folder_.gradients(), gradients_->columns(monitors_->probes.columns()), checkpoint_->state.time);
  } else {
    simulation_.start();
    recorder->start(simulation_.state());
    warn_of_lost_probes();
    if (gradients_) begin_gradients(*recorder);
  }
  next_checkpoint_ = next_checkpoint_after(simulation_.state().time);
  progress_.begin(simulation_.state().time, experiment_.time.duration, !experiment_.protocols.empty());
  if (settings_.control) settings_.control->begin(simulation_.state().time, experiment_.time.duration, simulation_.state().step);
  report_stages();
  while (!simulation_.finished() && (settings_.steps == 0 || summary_.steps < settings_.steps)) {
    wait_while_paused();
    prepare_dump();
    const StepReport report = simulation_.step();
    if (simulation_.interrupted()) {
      summary_.status = RunStatus::interrupted;
      store_interrupted(*recorder);
      return;
    }
    if (profiler_) profiler_->step(simulation_.state(), report);
    dump_.after(report.solve.iterations);
    recorder->step(simulation_.state(), report, simulation_.finished());
    report_stages();
    warn_of_lost_probes();
    if (gradients_) gradients_->accept(simulation_.state()), add_gradients(*recorder);
    summary_.add(report);
    summary_.group_names = simulation_.stepper().energy_groups();
    if (report.step <= looks_at_first || report.step % look_interval == 0) {
      monitors_->bent.examine(simulation_.state().x);
      update_lowest_quality();
      if (monitors_->adhesion) monitors_->adhesion->examine(simulation_.state().x, report.step_size);
      if (monitors_->approach) monitors_->approach->examine(simulation_.state().x);
    }
    report_linear_solver();
    progress_.step(report);
    if (settings_.control) settings_.control->step(report);
    simulation_.check_stages();
    remesh(recorder);
    write_checkpoint(*recorder);
  }
}

// Reports a stage that begins.
void RecordedRun::report_stages() {
  const ProtocolRun* protocols = simulation_.protocols();
  if (!protocols) return;
  const bool first = ended_stages_ < 0;
  if (protocols->ended_stages() == ended_stages_) return;
  ended_stages_ = protocols->ended_stages();
  progress_.message(fmt::format("t = {:.6g} s, {}", simulation_.state().time, protocols->stages_text()));
  if (!first) write_stages_so_far();
}

void RecordedRun::write_stages_so_far() {
  if (!simulation_.protocols() || !simulation_.started()) return;
  summary_.stages = simulation_.protocols()->visits(simulation_.state().time);
  write_stages(folder_.stages(), summary_.stages);
}

// Remeshes worn tetrahedra. Monitors of the world start again, as in a resumed run.
void RecordedRun::remesh(std::optional<Recorder>& recorder) {
  if (simulation_.finished()) return;
  std::vector<NewElements> elements = simulation_.due_elements();
  if (elements.empty()) return;
  const int step = simulation_.state().step;
  const double time = simulation_.state().time;
  std::vector<Remeshing> remeshings;
  for (const NewElements& e : elements) {
    const Body& body = world().bodies[e.body];
    remeshings.push_back({body.name, step, time, e.before, e.after, static_cast<int>(body.tets.size()), static_cast<int>(e.mesh.mesh.tets.size()), 0});
  }
  update_lowest_quality();
  warn_of_coarse_elements();
  recorder->flush();
  recorder.reset();
  monitors_.reset();
  double lost = 0;
  try {
    lost = simulation_.exchange(std::move(elements));
    monitors_.emplace(simulation_.built());
  } catch (const InputError& error) {  // a selection that is empty now
    throw SimulationError(fmt::format("after objects were meshed anew (t = {:.6g} s): {}", time, error.what()));
  }
  recorder.emplace(experiment_.output, experiment_.time, monitors_->probes, world(), folder_, clock_, time);
  for (Remeshing& r : remeshings) {
    r.lost = lost;
    progress_.message(fmt::format("object '{}' meshed anew after step {}, t = {:.6g} s: lowest mean ratio {:.3g}, was {:.3g}; {} tets, were {}", r.object, r.step, r.time,
                                  r.after, r.before, r.tets_after, r.tets_before));
    summary_.remeshings.push_back(std::move(r));
  }
  summary_.dofs = world().dofs.size();
}

// Waits while the run is paused; the time does not count as run time.
void RecordedRun::wait_while_paused() {
  if (!settings_.control) return;
  const ClockPause pause(clock_);
  settings_.control->wait_while_paused();
}

void RecordedRun::begin_gradients(const Recorder& recorder) {
  gradients_->start();
  gradients_csv_.emplace(folder_.gradients(), gradients_->columns(monitors_->probes.columns()));
  add_gradients(recorder);
}

// Restarts gradients as in a run resumed here.
void RecordedRun::restart_gradients() {
  State state = simulation_.state();
  gradients_->store(state.history);
  gradients_->start_from(state);
}

void RecordedRun::add_gradients(const Recorder& recorder) {
  const std::vector<double>& sample = recorder.series().rows.back();
  gradients_csv_->add(sample.front(), gradients_->values({sample.begin() + 1, sample.end()}));
}

// Reports each lost probe once.
void RecordedRun::warn_of_lost_probes() {
  for (const std::string& what : monitors_->probes.take_invalid())
    warn({WarningKind::probe_not_finite, fmt::format("probe {} at t = {:.6g} s, and no number that charts, statistics or an expectation could use", what,
                     simulation_.state().time)});
}

void RecordedRun::update_lowest_quality() {
  monitors_->quality.examine(simulation_.state().x, simulation_.state().time);
  if (const auto lowest = monitors_->quality.lowest()) summary_.lowest_quality = std::min(summary_.lowest_quality, *lowest);
}

// Reports effects that elements were too coarse for.
void RecordedRun::warn_of_resolution() {
  if (!monitors_) return;
  if (simulation_.started()) update_lowest_quality();
  for (const Warning& warning : monitors_->quality.warnings()) warn(warning);
  warn_of_coarse_elements();
}

void RecordedRun::warn_of_coarse_elements() {
  for (const Warning& warning : monitors_->bent.warnings()) warn(warning);
  if (monitors_->adhesion)
    for (const Warning& warning : monitors_->adhesion->warnings()) warn(warning);
  if (monitors_->approach)
    for (const Warning& warning : monitors_->approach->warnings()) warn(warning);
}

// Reports the linear solver after the first system and after each change.
void RecordedRun::report_linear_solver() {
  const std::string solver = simulation_.solver().linear_solver();
  if (solver.empty() || solver == summary_.linear_solver) return;
  summary_.linear_solver = solver;
  progress_.detail("linear solver: " + solver);
}

void RecordedRun::add_up_phases() {
  const PhaseClock::Seconds& seconds = clock_.seconds();
  for (int i = 0; i < phase_count; ++i) summary_.phases[i] = phases_before_[i] + seconds[i];
}

std::string RecordedRun::profile_of_run() {
  const Profile profile = profiler_->finish(simulation_.state(), summary_);
  write_profile(folder_.profile(), profile);
  return profile_tables(profile);
}

void RecordedRun::finish(const ProbeSeries* series) {
  write_stages_so_far();
  const bool complete = series && summary_.status == RunStatus::done && settings_.steps == 0;
  if (complete) {
    for (const Expectation& expectation : experiment_.expect) {
      summary_.expect.push_back(evaluate(expectation, *series, summary_.stages));
      if (!summary_.expect.back().pass) summary_.status = RunStatus::expectation_failed;
    }
    write_measured(folder_.measured(), experiment_.expect, *series, summary_.stages);
  }
  finish_dump();
  if (gradients_)
    for (const Warning& warning : gradients_->warnings()) warn(warning);
  for (const Warning& warning : summary_.losses.warnings(*experiment_.time.integrator, summary_.group_names)) warn(warning);
  warn_of_resolution();
  add_up_phases();
  for (const double s : summary_.phases) summary_.wall_seconds += s;
  write_summary(folder_.summary(), summary_);
  progress_.finish();
  progress_.message(profiler_ && simulation_.started() ? profile_of_run() : phase_table(summary_));
  if (complete && summary_.status == RunStatus::done) progress_.message(expect_table(summary_.expect));
  else if (complete) progress_.failure(expect_table(summary_.expect));
  const std::string warned = summary_.warnings.empty() ? "" : fmt::format(", {}", counted(summary_.warnings.size(), "warning"));
  const char* iterations = summary_.stepper.contains("sweeps") ? "sweeps" : "Newton iterations";
  const std::string sizes = experiment_.time.adaptive && summary_.steps > 0
                                ? fmt::format(" of {:.3g} to {:.3g} s (mean {:.3g} s, {} repeated for their error)", summary_.smallest_step,
                                              summary_.largest_step, summary_.stepped_time / summary_.steps, summary_.repeated_steps)
                                : "";
  progress_.message(fmt::format("{}: {} steps{}, {} {}, {}{}; results in {}", to_string(summary_.status), summary_.steps, sizes, summary_.newton_iterations, iterations,
                                smallest_gap_of(summary_), warned, folder_.root().string()));
}

}  // namespace tack
