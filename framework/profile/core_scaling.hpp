// Prediction of a run's speed-up on several cores from a run with one. The chunks of each parallel
// loop are scheduled greedily (loop_trace.hpp); all other time is serial. The prediction is an
// upper bound: memory is as fast for all cores as for one, and loops start and end in no time.
#pragma once

#include <string>
#include <vector>

#include "framework/core/phase_clock.hpp"

namespace tack {

// Cost of a parallel loop in a phase, or of the serial code between two loops.
struct LoopCost {
  std::string name;  // the loop; of serial code: the loops around it
  Phase phase = Phase::other;
  bool serial = false;
  long runs = 0, chunks = 0;     // chunks: sum over all runs; 0 if serial
  long divided_runs = 0;         // with two or more chunks
  double seconds = 0;            // with one core
  double undivided = 0;          // part of `seconds`: runs of one chunk; all, if serial
  std::vector<double> on_cores;  // seconds with so many cores

  // Returns the seconds that `cores` cores lose to serial code and uneven chunks. k: index in
  // CoreScaling::cores.
  double lost(size_t k, int cores) const { return on_cores[k] - seconds / cores; }
};

struct CoreScaling {
  std::vector<int> cores;       // ascending, at least 2
  int asked = 0;                // number of cores that the losses refer to, one of `cores`
  std::vector<LoopCost> costs;  // largest loss first

  bool empty() const { return cores.empty(); }
  size_t index_of_asked() const;
  double seconds() const;         // of the steps, with one core
  double serial_seconds() const;  // in code outside loops, and in loops with one chunk
  double serial_seconds(Phase phase) const;
  double seconds(Phase phase) const;
  long divided_runs() const;
  // Returns the time with one core over the time with cores[k].
  double speed_up(size_t k) const;
  double speed_up(size_t k, Phase phase) const;
  // Returns the speed-up of loops with two or more chunks.
  double speed_up_of_loops(size_t k) const;
  // Returns the share of the time lost with the asked number of cores.
  double share_lost(const LoopCost& cost) const;
  // Sorts the costs by what the asked number of cores loses.
  void sort();
};

}  // namespace tack
