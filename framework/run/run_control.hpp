// Progress of a run, with pause and stop, for other threads. The running thread calls begin, step,
// iteration, wait_while_paused and end; any thread may call the others.
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
    int step = 0;               // last accepted step
    double time = 0;            // time at its end [s]
    int iterations = 0;         // its iterations
    int contacts = 0;
    double min_gap = std::numeric_limits<double>::infinity();  // m
    int iteration = 0;                                         // of the present step; 0: none yet
    double residual = 0;   // after that iteration, in units of the tolerance
    bool paused = false;   // a pause was requested
    bool waiting = false;  // the run waits
    bool stopped = false;  // a stop was requested
    bool over = false;     // the run has ended; nothing is written any more
  };

  void begin(double start, double end, int step);
  void step(const StepReport& report);
  void iteration(int iteration, double residual);
  // Called between two steps; returns once the run may continue or must end.
  void wait_while_paused();
  void end();

  void pause(bool paused);
  // Ends the run as Ctrl-C does; no effect on a run that has ended.
  void stop();
  Progress progress() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Progress progress_;
};

}  // namespace tack
