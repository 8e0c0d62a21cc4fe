// A simulation with recorded results: a folder with the resolved experiment, steps, probes, frames,
// checkpoints, stored problems, a profile and a summary, and messages.
#pragma once

#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/checks/adhesion_resolution.hpp"
#include "framework/checks/bent_solids.hpp"
#include "framework/checks/contact_approach.hpp"
#include "framework/checks/flow_quality.hpp"
#include "framework/output/checkpoints.hpp"
#include "framework/output/progress.hpp"
#include "framework/output/recorder.hpp"
#include "framework/output/summary.hpp"
#include "framework/profile/profiler.hpp"
#include "framework/run/problem_dump.hpp"
#include "framework/run/simulation.hpp"
#include "framework/sensitivity/gradients.hpp"

namespace tack {

class RunControl;

struct RunSettings {
  std::string output;                      // folder; empty: results/<name>
  int steps = 0;                           // limit of steps; 0: none
  bool resume = false;                     // from the newest checkpoint of the folder
  std::vector<std::string> dump_problems;  // "step=K", "hardest=N"
  bool profile = false;                    // print the cost of the run
  std::vector<int> cores;                  // with `profile`: numbers of cores to predict for
  RunControl* control = nullptr;           // observer that may pause or stop the run; null: none
};

class RecordedRun {
 public:
  // Throws InputError before anything is written. out: stream for messages.
  RecordedRun(LoadedExperiment loaded, const RunSettings& settings, const Provenance& provenance,
              std::ostream& out, const ProgressOptions& progress);

  // Runs to the end or to a step that fails, which the summary reports. Throws InputError for
  // results that cannot be written.
  const RunSummary& execute();
  const std::filesystem::path& folder() const { return folder_.root(); }

 private:
  std::optional<StateFile> checkpoint();
  void report_start();
  void warn(const Warning& warning);
  void simulate(std::optional<Recorder>& recorder);
  void report_stages();
  void write_stages_so_far();
  void remesh(std::optional<Recorder>& recorder);
  void wait_while_paused();
  void begin_gradients(const Recorder& recorder);
  void restart_gradients();
  void add_gradients(const Recorder& recorder);
  void report_linear_solver();
  void warn_of_lost_probes();
  void update_lowest_quality();
  void warn_of_resolution();
  void warn_of_coarse_elements();
  void prepare_dump();
  void finish_dump();
  StateFile state_file(StateFile::Kind kind, const State& state) const;
  void store_problem(const State& state, double h, int iterations);
  double next_checkpoint_after(double time) const;
  void write_checkpoint(Recorder& recorder);
  void store_interrupted(Recorder& recorder);
  void store_checkpoint(const std::filesystem::path& path, Recorder& recorder);
  void add_up_phases();
  std::string profile_of_run();
  void finish(const ProbeSeries* series);  // null: probes were lost
  void export_frames();

  RunSettings settings_;
  ProblemDump dump_;
  Simulation simulation_;
  const Experiment& experiment_ = simulation_.experiment();
  World& world() { return simulation_.world(); }
  const World& world() const { return simulation_.world(); }
  PhaseClock& clock_ = simulation_.clock();
  // Observers of the world, which is replaced when objects are remeshed.
  struct Monitors {
    explicit Monitors(const BuiltExperiment& built);
    ProbeSet probes;
    BentSolids bent;
    FlowQuality quality;
    std::optional<AdhesionResolution> adhesion;  // only with adhesion
    std::optional<ContactApproach> approach;     // only with contact and a check of force balance
  };
  std::optional<Monitors> monitors_;
  std::optional<Gradients> gradients_;  // only if the experiment has gradients
  std::optional<ProbesCsv> gradients_csv_;
  // Digests by path of the files that the scene has read, computed at that time.
  std::map<std::string, std::string> files_;
  RunFolder folder_;
  std::optional<StateFile> checkpoint_;  // the checkpoint that is resumed
  std::ofstream log_;
  Progress progress_;
  RunSummary summary_;
  PhaseClock::Seconds phases_before_{};  // of the resumed run
  std::optional<Profiler> profiler_;
  double next_checkpoint_ = 0;  // s
  int ended_stages_ = -1;       // of protocols, as reported; -1: none yet
};

}  // namespace tack
