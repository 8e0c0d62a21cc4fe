// A simulation whose results are kept: a folder with the experiment as it is resolved, steps, probes, frames,
// checkpoints, stored problems, a profile and a summary; and what is told of it on the way.
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
  std::string output;                      // the folder; empty: results/<name>
  int steps = 0;                           // 0: to the end
  bool resume = false;                     // from the newest checkpoint of the folder
  std::vector<std::string> dump_problems;  // "step=K", "hardest=N"
  bool profile = false;                    // tell what the run cost
  RunControl* control = nullptr;           // who looks on and may hold it; null: nobody
};

class RecordedRun {
 public:
  // Throws InputError before anything is written. `out` gets what is told.
  RecordedRun(LoadedExperiment loaded, const RunSettings& settings, const Provenance& provenance, std::ostream& out,
              const ProgressOptions& progress);

  // To the end, or as far as it gets: a step that fails is told of in the summary. Throws InputError for results
  // that cannot be written.
  const RunSummary& execute();
  const std::filesystem::path& folder() const { return folder_.root(); }

 private:
  std::optional<StateFile> checkpoint();
  void tell_beginning();
  void warn(const Warning& warning);
  void simulate(std::optional<Recorder>& recorder);
  void remesh(std::optional<Recorder>& recorder);
  void hold();
  void begin_gradients(const Recorder& recorder);
  void restart_gradients();
  void add_gradients(const Recorder& recorder);
  void tell_linear_solver();
  void tell_lost_probes();
  void look_at_quality();
  void tell_resolution();
  void tell_coarse();
  void prepare_dump();
  void finish_dump();
  StateFile state_file(StateFile::Kind kind, const State& state) const;
  void store_problem(const State& state, double h, int iterations);
  double next_checkpoint_after(double time) const;
  void write_checkpoint();
  void keep_interrupted();
  void store_checkpoint(const std::filesystem::path& path);
  void add_up_phases();
  std::string profile_of_run();
  void finish(const ProbeSeries* series);  // of probes; null: they were lost

  RunSettings settings_;
  ProblemDump dump_;
  Simulation simulation_;
  const Experiment& experiment_ = simulation_.experiment();
  World& world() { return simulation_.world(); }
  const World& world() const { return simulation_.world(); }
  PhaseClock& clock_ = simulation_.clock();
  // All that looks at the world, which is another one once objects were meshed anew.
  struct Watch {
    explicit Watch(const BuiltExperiment& built);
    ProbeSet probes;
    BentSolids bent;
    FlowQuality quality;
    std::optional<AdhesionResolution> adhesion;  // if anything adheres
    std::optional<ContactApproach> approach;     // with contact, if forces are in balance
  };
  std::optional<Watch> watch_;
  std::optional<Gradients> gradients_;  // if the experiment asks for any
  std::optional<ProbesCsv> gradients_csv_;
  // Digests of the files that the scene reads, taken when it read them, by path.
  std::map<std::string, std::string> files_;
  RunFolder folder_;
  std::optional<StateFile> checkpoint_;  // that the run goes on from
  std::ofstream log_;
  Progress progress_;
  RunSummary summary_;
  PhaseClock::Seconds phases_before_{};  // of the run that is resumed
  std::optional<Profiler> profiler_;
  double next_checkpoint_ = 0;  // s
};

}  // namespace tack
