#include "framework/calibrate/calibrate_run.hpp"

#include <fmt/format.h>

#include <chrono>

#include "framework/batch/batch_estimate.hpp"
#include "framework/calibrate/case_evaluator.hpp"
#include "framework/output/run_folder.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"

namespace tack {

BatchDescription calibration_description(const CalibrateConfig& config, const FittedScenes& scenes, const std::string& file, const Provenance& provenance, int jobs,
                                         int threads) {
  BatchDescription d;
  d.plan.name = config.name + " - evaluations";
  d.plan.about = config.about;
  if (scenes.runs() > 1) d.plan.columns.push_back("base");
  for (const FittedParameter& n : scenes.parameters()) {
    d.plan.columns.push_back(n.name);
    if (n.unit != "1") d.plan.units[n.name] = n.unit;
  }
  d.file = file;
  d.limits.threads = threads > 0 ? threads : config.threads;
  d.limits.jobs = jobs_that_fit(jobs > 0 ? jobs : config.jobs, d.limits.threads, config.memory);
  d.limits.memory = config.memory;
  d.limits.time_limit = config.time_limit;
  d.provenance = provenance_text(provenance);
  return d;
}

CalibrationRun run_calibration(const CalibrateConfig& config, FittedScenes& scenes, const CalibrationSettings& settings, const CalibrationObserver& observer) {
  const auto begun = std::chrono::steady_clock::now();
  const auto print = [&](const std::string& line) {
    if (observer.print) observer.print(line);
  };
  CalibrationRecord record{config, settings.file, settings.provenance, 0, 0};
  CalibrationRun run{CalibrationFolder::opened(RunFolder::chosen_root(settings.output, config.name), config.name), {}, 0};
  if (run.folder.moved_aside) print(fmt::format("what was there is moved to {}", run.folder.moved_aside->string()));
  CaseEvaluator evaluator(scenes, {settings.program, run.folder.evaluations, settings.cases, settings.slurm ? std::optional(config.slurm) : std::nullopt,
                                   settings.rerun_failed,
                                   [&](const PointEvaluation& e) {
                                     if (observer.evaluated) observer.evaluated(e);
                                   },
                                   [&] {
                                     if (observer.tick) observer.tick();
                                   }});
  evaluator.write_tables();
  try {
    run.calibration = calibrate(scenes, config.search, evaluator, [&](const std::string& phase, int points, const PointEvaluation* best) {
      if (observer.phase) observer.phase(phase, points, best);
    });
  } catch (const Interrupted&) {
    evaluator.write_tables();
    const std::string& jobs = evaluator.running_jobs();
    print(fmt::format("interrupted: {}call it again{} to continue; finished runs are kept in {}", jobs.empty() ? "" : jobs + "; ", jobs.empty() ? "" : " when that has ended",
                      run.folder.evaluations.root.string()));
    throw;
  } catch (const SimulationError&) {
    evaluator.write_tables();
    throw;
  }
  evaluator.write_tables();
  record.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  run.started = record.started = evaluator.started();
  write_calibration(run.folder, record, run.calibration, scenes, evaluator.run_folders(run.calibration.search.best));
  for (const std::string& failure : draw_calibration(run.folder, run.calibration, scenes)) print(failure);
  return run;
}

}  // namespace tack
