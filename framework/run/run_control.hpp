// How far a run is, and a hand on it, for another thread: pause and stop. Who runs it calls begin, step, iteration, hold and end; all others may be called from anywhere.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <limits>
#include <mutex>

#include "framework/stepping/step_report.hpp"

namespace tack {

class RunControl {
 public:
  struct Progress {
    double start = 0, end = 0;  // of the run [s, simulated]
    int step = 0;               // the last one that was accepted
    double time = 0;            // at its end [s]
    int iterations = 0;         // that it took
    int contacts = 0;
    double min_gap = std::numeric_limits<double>::infinity();  // m
    int iteration = 0;          // of the step under way; 0: of none
    double residual = 0;        // after it, in tolerances
    bool paused = false;        // asked to hold
    bool holding = false;       // and holds
    bool stopped = false;       // asked to end
    bool over = false;          // nothing is written any more
  };

  void begin(double start, double end, int step);
  void step(const StepReport& report);
  void iteration(int iteration, double residual);
  // Between two steps: returns once the run may go on, or has to end.
  void hold();
  void end();

  void pause(bool paused);
  // As Ctrl-C does; of a run that is over, nothing.
  void stop();
  Progress progress() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Progress progress_;
};

}  // namespace tack
