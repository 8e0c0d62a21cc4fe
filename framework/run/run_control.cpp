#include "framework/run/run_control.hpp"

#include <chrono>

#include "geometry/interrupt.hpp"

namespace tack {
namespace {

// Signals only set a flag, which must be polled.
constexpr std::chrono::milliseconds signal_interval{50};

}  // namespace

void RunControl::begin(double start, double end, int step) {
  const std::lock_guard lock(mutex_);
  progress_.start = progress_.time = start;
  progress_.end = end;
  progress_.step = step;
}

void RunControl::step(const StepReport& report) {
  const std::lock_guard lock(mutex_);
  progress_.step = report.step;
  progress_.time = report.time;
  progress_.iterations = report.solve.iterations;
  progress_.contacts = report.contacts;
  progress_.min_gap = report.min_gap;
  progress_.iteration = 0;
  progress_.residual = report.solve.residual;
}

void RunControl::iteration(int iteration, double residual) {
  const std::lock_guard lock(mutex_);
  progress_.iteration = iteration;
  progress_.residual = residual;
}

void RunControl::wait_while_paused() {
  std::unique_lock lock(mutex_);
  progress_.waiting = progress_.paused;
  while (progress_.paused && !interrupt_requested) changed_.wait_for(lock, signal_interval);
  progress_.waiting = false;
}

void RunControl::end() {
  const std::lock_guard lock(mutex_);
  progress_.over = true;
}

void RunControl::pause(bool paused) {
  const std::lock_guard lock(mutex_);
  progress_.paused = paused && !progress_.stopped;
  changed_.notify_all();
}

void RunControl::stop() {
  const std::lock_guard lock(mutex_);
  if (progress_.over) return;
  progress_.stopped = true;
  progress_.paused = false;
  interrupt_requested = true;
  changed_.notify_all();
}

RunControl::Progress RunControl::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

}  // namespace tack
