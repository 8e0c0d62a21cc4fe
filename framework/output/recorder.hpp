// Everything that a run writes step by step: frames, steps.csv, probes.csv.
#pragma once

#include "framework/output/probes_csv.hpp"
#include "framework/output/pvd.hpp"
#include "framework/output/run_folder.hpp"
#include "framework/output/steps_csv.hpp"
#include "framework/output/vtu.hpp"
#include "framework/scene/load_scene.hpp"
#include "framework/scene/world.hpp"

namespace tack {

// Prepares every probe and checks every expectation against their columns; returns the columns.
// Throws InputError with the place in the scene file.
std::vector<std::string> prepare_probes(const LoadedScene& scene, const World& world);

class Recorder {
 public:
  // `columns`: of the probes, as prepare_probes returned them. `resumed_at`: continues what a run
  // wrote up to that time [s]; start() is not called then.
  Recorder(const LoadedScene& scene, const World& world, const RunFolder& folder,
           const std::vector<std::string>& columns, PhaseClock& clock,
           std::optional<double> resumed_at = std::nullopt);

  void start(const State& state);  // the state before the first step
  // Samples probes and writes frames that are due; `report.phases` lacks the time that this takes.
  void step(const State& state, const StepReport& report);
  const ProbeSeries& series() const { return probes_.series(); }

 private:
  void sample(const State& state);
  void write_frame(const State& state);
  void schedule_frame(double time);  // the next one after `time` [s]
  std::vector<PointField> point_fields(const State& state) const;

  const SceneConfig& scene_;
  const World& world_;
  RunFolder folder_;
  PhaseClock& clock_;
  StepsCsv steps_;
  ProbesCsv probes_;
  PvdFile pvd_;
  FrameGeometry geometry_;
  double next_frame_ = 0;  // s
};

}  // namespace tack
