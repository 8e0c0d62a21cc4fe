// A scalar function of time, piecewise linear between points and constant outside them. In a scene
// file: a number, or a list of [time, value] pairs with increasing times.
#pragma once

#include <vector>

namespace tack {

class Schedule {
 public:
  struct Point {
    double time;   // s
    double value;  // in the unit of its parameter

    bool operator==(const Point&) const = default;
  };

  Schedule(double constant = 0);  // NOLINT: a number is a schedule

  // Throws InputError, without a source location, if there is no point or the times do not
  // increase.
  explicit Schedule(std::vector<Point> points);

  double at(double time) const;
  bool constant() const { return points_.size() == 1; }
  const std::vector<Point>& points() const { return points_; }
  std::vector<double> corners() const;  // times at which the slope changes [s]; none for a constant
  bool operator==(const Schedule&) const = default;

 private:
  std::vector<Point> points_;  // never empty
};

}  // namespace tack
