// Root search of a step under control: the velocity v of a drive for which the probe at the end of
// the step is at its target,
//    f(v) = probe(v) - target = 0,   |v| <= speed.
// Secant steps until the root is bracketed, then regula falsi (Illinois; Dowell and Jarratt 1971).
// The sign of `speed` says how the probe follows the drive: a secant of the wrong sign, as where an
// adhesive contact lets go, is replaced by the largest velocity towards the target, which is what
// the control of a testing machine does.
#pragma once

#include <optional>

namespace tack {

class ControlSearch {
 public:
  // Begins a step of size h [s]. velocity: first try; slope: of the probe by the drive, or 0.
  void begin(double h, double velocity, double slope, double speed, double tolerance);
  double velocity() const { return velocity_; }
  // Returns the last slope of the probe by the drive; 0: unknown.
  double slope() const { return slope_; }
  // Judges the error f of the velocity. Returns false if the velocity stays; otherwise velocity()
  // is the next one.
  bool next(double error);

 private:
  struct Try {
    double velocity, error;
  };
  double secant(double error) const;

  double h_ = 0, velocity_ = 0, slope_ = 0, speed_ = 0, tolerance_ = 0;
  std::optional<Try> before_, below_, above_;  // the last try; the bracket: f < 0 and f > 0
  int tries_ = 0;
};

}  // namespace tack
