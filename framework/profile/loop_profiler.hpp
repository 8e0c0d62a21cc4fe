// Times the chunks of all parallel loops of a run with one thread, and the serial code between
// loops, by phase. Loops inside a chunk of another one are scheduled with it and belong to its
// cost. Seconds are processor time of the thread; time that measuring takes is in no phase.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "framework/core/phase_clock.hpp"
#include "framework/profile/core_scaling.hpp"
#include "framework/profile/loop_trace.hpp"
#include "geometry/chunk_order.hpp"
#include "geometry/loop_observer.hpp"

namespace tack {

class LoopProfiler final : public LoopObserver {
 public:
  // Observes the loops of this thread from now on. cores: numbers of cores to predict for, at least
  // one; the first is the one that losses refer to. `clock` must outlive it.
  LoopProfiler(PhaseClock& clock, const std::vector<int>& cores);

  void run(const SourcePosition& loop, int chunks, const ChunkCall& chunk) override;
  // Inside a chunk of another loop, a loop with dependencies counts as serial.
  void run(const SourcePosition& loop, int chunks, const ChunkCall& chunk,
           const ChunkOrder& order) override;
  // Ends the measurement.
  CoreScaling finish();

  // Measures nothing during the lifetime of a scope. profiler: may be null.
  class Pause {
   public:
    explicit Pause(LoopProfiler* profiler);
    ~Pause();
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    LoopProfiler* profiler_;
    LoopObserverScope scope_{nullptr};
  };

 private:
  // A position in the source. Strings are compared by address: equal ones are added up at the end.
  using Position = std::tuple<const char*, const char*, unsigned>;  // file, function, line
  struct Loop {
    SourcePosition position;
    LoopCost cost;
  };
  void run_outermost(const SourcePosition& loop, int chunks, const ChunkCall& chunk,
                     const ChunkOrder* order);
  void run_chunks(int chunks, const ChunkCall& chunk);
  void end_segment();
  void charge_serial();
  void mark();
  Loop& loop_at(const SourcePosition& position);

  PhaseClock& clock_;
  int asked_;
  std::vector<int> cores_;
  double read_cost_, thread_read_cost_;  // s, of reading a clock
  double mark_ = 0;                      // processor time at which serial code began [s]
  PhaseClock::Seconds phases_{};         // at that time
  PhaseClock::Seconds serial_{};         // by phase, since the last loop
  std::map<std::pair<Position, Phase>, Loop> loops_;
  const SourcePosition* last_ = nullptr;  // loop
  std::map<std::tuple<const SourcePosition*, const SourcePosition*, Phase>, LoopCost> between_;
  LoopTrace trace_;  // of the outermost loop that runs
  bool in_loop_ = false;
  std::chrono::steady_clock::time_point segment_;  // begin of the segment that runs
  std::optional<LoopObserverScope> active_;
};

}  // namespace tack
