// Writes the results of each step: frames, steps.csv, probes.csv.
#pragma once

#include "framework/output/frame_writer.hpp"
#include "framework/output/output_config.hpp"
#include "framework/output/probe_set.hpp"
#include "framework/output/probes_csv.hpp"
#include "framework/output/run_folder.hpp"
#include "framework/output/steps_csv.hpp"
#include "framework/stepping/time_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

class Recorder {
 public:
  // resumed_at: continues the files of a run up to that time [s]; then start() is not called.
  Recorder(const OutputConfig& output, const TimeConfig& time, ProbeSet& probes, World& world,
           const RunFolder& folder, PhaseClock& clock,
           std::optional<double> resumed_at = std::nullopt);

  void start(const State& state);  // records the state before the first step
  // Samples probes and starts to write frames that are due. The time for this is not in
  // `report.phases`. last: the run is over, whatever its duration.
  void step(const State& state, const StepReport& report, bool last = false);
  // Returns once all frames are written (frame_writer.hpp).
  void flush();
  const ProbeSeries& series() const { return probes_.series(); }

 private:
  void sample(const State& state);
  void write_frame(const State& state);
  void schedule_frame(double time);  // schedules the next frame after `time` [s]

  const OutputConfig& output_;
  const TimeConfig& time_;
  ProbeSet& probe_set_;
  World& world_;
  PhaseClock& clock_;
  StepsCsv steps_;
  ProbesCsv probes_;
  FrameWriter frames_;
  double next_frame_ = 0;  // s
};

}  // namespace tack
