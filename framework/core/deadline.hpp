// Limits of wall time: of a solve (solver.time_limit) and of a run (time.wall_limit). Parallel
// loops poll passed() and stop; the loops around them call check(), whose exception ends the solve.
// Minimisers report it as a status. Without a limit no clock is read.
// Limits: factorisations and orderings of external libraries, and a single front of our own
// factorisation, cannot be interrupted.
#pragma once

#include <algorithm>
#include <chrono>
#include <exception>
#include <optional>

namespace tack {

/// Thrown when the time limit of a solve or of the run has passed.
struct OutOfTime : std::exception {
  const char* what() const noexcept override { return "out of wall time"; }
};

/// Time limits of the current solve and of the run.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  /// Limits the run to `seconds` from `begun` on; none: no limit.
  void limit_run(Clock::time_point begun, std::optional<double> seconds) {
    end_ = run_end_ = seconds ? begun + duration(*seconds) : never;
  }
  void begin_solve(std::optional<double> seconds) {
    end_ = run_end_;
    if (seconds) end_ = std::min(end_, Clock::now() + duration(*seconds));
  }
  void end_solve() { end_ = run_end_; }

  bool passed() const { return after(end_); }
  bool run_passed() const { return after(run_end_); }
  void check() const {
    if (passed()) throw OutOfTime();
  }

 private:
  static constexpr Clock::time_point never = Clock::time_point::max();

  static bool after(Clock::time_point end) { return end != never && Clock::now() >= end; }
  static Clock::duration duration(double seconds) {
    constexpr double century = 3e9;  // s; more overflows
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(std::min(seconds, century)));
  }

  Clock::time_point run_end_ = never, end_ = never;
};

}  // namespace tack
