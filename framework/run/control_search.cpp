#include "framework/run/control_search.hpp"

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

constexpr int control_tries_max = 50;
constexpr double shortest_bracket = 1e-9;  // of the speed: the probe jumps there
// A try stays this fraction of the bracket away from its ends: where the probe is nearly flat on one
// side, a secant returns to an end, and the bracket would not shrink.
constexpr double end_fraction = 0.01;

}  // namespace

void ControlSearch::begin(double h, double velocity, double slope, double speed, double tolerance) {
  h_ = h;
  speed_ = speed;
  tolerance_ = tolerance;
  velocity_ = std::clamp(velocity, -std::abs(speed), std::abs(speed));
  slope_ = slope;
  before_.reset(), below_.reset(), above_.reset();
  tries_ = 0;
}

double ControlSearch::secant(double error) const {
  const double limit = std::abs(speed_);
  if (slope_ == 0 || (slope_ > 0) != (speed_ > 0)) return error < 0 ? speed_ : -speed_;
  return std::clamp(velocity_ - error / (slope_ * h_), -limit, limit);
}

bool ControlSearch::next(double error) {
  if (before_ && before_->velocity != velocity_) {
    const double slope = (error - before_->error) / ((velocity_ - before_->velocity) * h_);
    if (std::isfinite(slope)) slope_ = slope;
  }
  if (std::abs(error) <= tolerance_ || !std::isfinite(error) || ++tries_ >= control_tries_max) return false;
  // Illinois: the error of an end that stays is halved.
  std::optional<Try>&now = error < 0 ? below_ : above_, &other = error < 0 ? above_ : below_;
  if (other && before_ && (before_->error < 0) == (error < 0)) other->error /= 2;
  now = before_ = Try{velocity_, error};
  if (!other) {
    const double next = secant(error);
    if (next == velocity_) return false;  // at the largest speed
    velocity_ = next;
    return true;
  }
  const double width = other->velocity - now->velocity;
  if (std::abs(width) <= shortest_bracket * std::abs(speed_)) return false;
  double fraction = now->error / (now->error - other->error);
  if (!std::isfinite(fraction)) fraction = 0.5;
  velocity_ = now->velocity + std::clamp(fraction, end_fraction, 1 - end_fraction) * width;
  return true;
}

}  // namespace tack
