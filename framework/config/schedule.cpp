#include "framework/config/schedule.hpp"

#include <fmt/format.h>

#include "framework/config/piecewise_linear.hpp"
#include "geometry/errors.hpp"

namespace tack {

Schedule::Schedule(double constant) : points_{{0.0, constant}} {}

Schedule::Schedule(std::vector<Point> points) : points_(std::move(points)) {
  if (points_.empty()) throw InputError("a schedule needs at least one [time, value] pair");
  for (std::size_t i = 1; i < points_.size(); ++i) {
    if (points_[i].time > points_[i - 1].time) continue;
    throw InputError(fmt::format("the times of a schedule must increase, but {} s follows {} s",
                                 points_[i].time, points_[i - 1].time));
  }
}

double Schedule::at(double time) const {
  return piecewise_linear(points_.size(), [&](std::size_t i) { return points_[i].time; }, [&](std::size_t i) { return points_[i].value; }, time);
}

std::vector<double> Schedule::corners() const {
  std::vector<double> times;
  if (constant()) return times;
  for (const Point& p : points_) times.push_back(p.time);
  return times;
}

}  // namespace tack
