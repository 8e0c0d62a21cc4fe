// Search for the time at which a stage ends, by repeated steps from one state. Each end has an
// excess g(t) that is below zero before it is met and not afterwards: the probe less its limit.
// Tried steps bracket the earliest end; the next size is that of regula falsi, aimed a little past
// the end, and of bisection in every third try and where g is no number. An end is found where |g|
// is within its error, or where the bracket is shorter than the time tolerance: where the probe
// jumps.
#pragma once

#include <optional>
#include <vector>

namespace tack {

class EndSearch {
 public:
  // State of an end after a try.
  struct Excess {
    double value;  // g; below zero: not met. -infinity: not met, and not to be interpolated
    double error;  // accepted |g|; 0: found by the time alone
  };

  explicit EndSearch(double time_tolerance) : tolerance_(time_tolerance) {}
  // Begins a step at time t [s] with the excesses there.
  void begin(double t, std::vector<Excess> start);
  // Judges a try to time t. Returns the time at which the next try ends; nothing: it is accepted.
  std::optional<double> next(double t, const std::vector<Excess>& excess);
  // Returns the index of the end that the accepted try has met; -1: none.
  int met() const { return met_; }

 private:
  std::optional<double> inside();

  double tolerance_;
  double low_ = 0;              // s: no end is met there
  std::optional<double> high_;  // s: an end is met there; none: not yet
  std::vector<Excess> at_low_, at_high_;
  bool last_ = false;  // the try ends at the end of the bracket
  int tries_ = 0, met_ = -1;
};

}  // namespace tack
