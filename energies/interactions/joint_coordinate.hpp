// Free coordinate of a hinge or a slider: one number as a function of vertices, with its history.
// Angles count whole turns.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "framework/core/history.hpp"
#include "geometry/types.hpp"

namespace tack {

// Rotation of the object about the axis, relative to the other object [rad]. Vertices: a point of
// the axis, another point of it in its direction, an arm of the other object and one of the object.
struct HingeAngle {
  static constexpr int arity = 4;
  template <class T>
  static T of(const std::array<Eigen::Matrix<T, 3, 1>, 4>& x) {
    using std::atan2;
    const Eigen::Matrix<T, 3, 1> axis = x[1] - x[0], from = x[2] - x[0], arm = x[3] - x[0];
    const T length = axis.norm();
    const T across = (from.dot(arm) * length * length - from.dot(axis) * arm.dot(axis)) / length;
    return atan2(axis.dot(from.cross(arm)), across);
  }
  // Returns the whole turns [rad] that bring `angle` nearest to `near`.
  static double turns(double angle, double near) {
    return 2 * std::numbers::pi * std::round((near - angle) / (2 * std::numbers::pi));
  }
};

// Displacement of a point of the object along a line [m]. Vertices: the point, a point of the line,
// another point of the line in its direction.
struct SliderDisplacement {
  static constexpr int arity = 3;
  template <class T>
  static T of(const std::array<Eigen::Matrix<T, 3, 1>, 3>& x) {
    const Eigen::Matrix<T, 3, 1> line = x[2] - x[1];
    return (x[0] - x[1]).dot(line) / line.norm();
  }
  static double turns(double, double) { return 0; }
};

template <class Coordinate>
class JointCoordinate {
 public:
  static constexpr int arity = Coordinate::arity;

  // history_name: name of the history array of the value; offset: the value at the start.
  JointCoordinate(const std::array<int, arity>& vertices, double offset, std::string history_name)
      : vertices_(vertices), offset_(offset), last_(offset),
        history_name_(std::move(history_name)) {}

  const std::array<int, arity>& vertices() const { return vertices_; }
  double offset() const { return offset_; }
  double last() const { return last_; }  // at the end of the last accepted step
  // Value nearest to last(), and its difference from the value of the formula.
  double at(const VecX& x) const { return plain(x) + shift(x); }
  double shift(const VecX& x) const {
    return offset_ + Coordinate::turns(plain(x) + offset_, last_);
  }

  void load_history(const History& history) {
    const std::vector<double>* value = history_values(history, history_name_, 1, 1);
    last_ = value ? value->front() : offset_;
  }
  void commit(const VecX& x, History& history) const { history[history_name_] = {1, {at(x)}, {}}; }

 private:
  double plain(const VecX& x) const {
    std::array<Vec3, arity> positions;
    for (int i = 0; i < arity; ++i) positions[i] = vertex(x, vertices_[i]);
    return Coordinate::of(positions);
  }

  std::array<int, arity> vertices_;
  double offset_, last_;
  std::string history_name_;
};

}  // namespace tack
