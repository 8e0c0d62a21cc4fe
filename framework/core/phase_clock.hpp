// Wall time by phase of a step (the paper's figure 17). Phases nest exclusively: entering one
// pauses the phase around it, so the times of all phases add up to the time measured. Only the
// driving thread enters phases; work inside a phase may run on all threads. The clock also holds
// the time limits (deadline.hpp), because all long computations receive it.
#pragma once

#include <array>
#include <chrono>
#include <string_view>
#include <utility>

#include "framework/core/deadline.hpp"

namespace tack {

class TermTimes;

/// Phases of a step.
enum class Phase {
  other,
  assembly,
  projection,
  factorize,
  solve,
  broad_phase,
  narrow_phase,
  ccd,
  line_search,
  check,
  io,
  count
};

inline constexpr int phase_count = static_cast<int>(Phase::count);
inline constexpr std::array<std::string_view, phase_count> phase_names = {
    "other",        "assembly", "projection",  "factorize", "solve", "broad_phase",
    "narrow_phase", "ccd",      "line_search", "check",     "io"};

/// Clock of a run: seconds per phase, time limits, times of terms.
class PhaseClock {
 public:
  using Seconds = std::array<double, phase_count>;

  using Clock = std::chrono::steady_clock;

  PhaseClock() : begun_(Clock::now()), start_(begun_) {}
  Clock::time_point begun() const { return begun_; }
  Deadline& deadline() { return deadline_; }

  /// Charges the time since the last change to the current phase; returns that phase.
  Phase enter(Phase phase) {
    const auto now = Clock::now();
    seconds_[static_cast<int>(current_)] += std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return std::exchange(current_, phase);
  }

  const Seconds& seconds() {
    enter(current_);
    return seconds_;
  }
  Phase current() const { return current_; }
  /// Excludes the time since the last change from all phases.
  void skip() { start_ = Clock::now(); }

  /// Counts numeric factorisations, those of preconditioners included.
  void count_factorization() { ++factorizations_; }
  long factorizations() const { return factorizations_; }
  /// Returns the table of the times of terms (term_times.hpp); null: terms are not timed.
  TermTimes* term_times() const { return term_times_; }
  void time_terms(TermTimes* times) { term_times_ = times; }

 private:
  Clock::time_point begun_, start_;
  Phase current_ = Phase::other;
  Seconds seconds_{};
  Deadline deadline_;
  long factorizations_ = 0;
  TermTimes* term_times_ = nullptr;
};

/// Enters a phase for the lifetime of a scope.
class PhaseScope {
 public:
  PhaseScope(PhaseClock& clock, Phase phase) : clock_(clock), outer_(clock.enter(phase)) {}
  ~PhaseScope() { clock_.enter(outer_); }
  PhaseScope(const PhaseScope&) = delete;
  PhaseScope& operator=(const PhaseScope&) = delete;

 private:
  PhaseClock& clock_;
  Phase outer_;
};

/// Excludes the lifetime of a scope from all phases. The scope must enter no phase.
class ClockPause {
 public:
  explicit ClockPause(PhaseClock& clock) : clock_(clock) { clock.seconds(); }
  ~ClockPause() { clock_.skip(); }
  ClockPause(const ClockPause&) = delete;
  ClockPause& operator=(const ClockPause&) = delete;

 private:
  PhaseClock& clock_;
};

}  // namespace tack
