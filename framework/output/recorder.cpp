#include "framework/output/recorder.hpp"

#include "framework/output/element_fields.hpp"
#include "framework/output/frame_fields.hpp"
#include "framework/output/frame_geometry.hpp"
#include "framework/output/next_due.hpp"

namespace tack {

Recorder::Recorder(const OutputConfig& output, const TimeConfig& time, ProbeSet& probes, World& world,
                   const RunFolder& folder, PhaseClock& clock, std::optional<double> resumed_at)
    : output_(output), time_(time), probe_set_(probes), world_(world), clock_(clock),
      steps_(resumed_at ? StepsCsv::continued(folder.steps(), *resumed_at) : StepsCsv(folder.steps())),
      probes_(resumed_at ? ProbesCsv::continued(folder.probes(), probes.columns(), *resumed_at)
                         : ProbesCsv(folder.probes(), probes.columns())),
      frames_(folder, resumed_at ? PvdFile::continued(folder.pvd(), *resumed_at) : PvdFile(folder.pvd()), frame_geometry(world)) {
  if (resumed_at) schedule_frame(*resumed_at);
}

void Recorder::schedule_frame(double time) {
  next_frame_ = next_due_from(output_.frames_from, output_.frame_interval, time, time_.step);
}

void Recorder::start(const State& state) {
  const PhaseScope scope(clock_, Phase::io);
  world_.participants.move_to(state.x);
  sample(state);
  if (output_.frames) write_frame(state);
}

void Recorder::step(const State& state, const StepReport& report, bool last) {
  const PhaseScope scope(clock_, Phase::io);
  steps_.add(report);
  sample(state);
  if (!output_.frames) return;
  last = last || state.time >= time_.duration - 1e-9 * time_.step;
  if (state.time >= next_frame_ - 1e-9 * time_.step || last) write_frame(state);
}

void Recorder::sample(const State& state) { probes_.add(state.time, probe_set_.sample(world_, state)); }

void Recorder::flush() {
  const PhaseScope scope(clock_, Phase::io);
  frames_.flush();
}

void Recorder::write_frame(const State& state) {
  const FrameGeometry& geometry = frames_.geometry();
  frames_.write(state.time, state.x.head(3 * geometry.vertices), vertex_fields(output_.frame_fields, world_, state, geometry),
                element_fields(output_.frame_fields, world_, state.x, geometry));
  schedule_frame(state.time);
}

}  // namespace tack
