// Shift factors of the relaxation times of the elements of a body (temperature_shift.hpp), at the
// temperatures of their centres at rest.
#pragma once

#include <vector>

#include "framework/body/body.hpp"
#include "framework/bond/environment.hpp"
#include "framework/bond/temperature_shift.hpp"

namespace tack {

class ShiftedTimes {
 public:
  ShiftedTimes() = default;  // without shifts
  // elements: arrays of vertices. rest: of all vertices (3n) [m].
  template <class Elements>
  ShiftedTimes(const TemperatureShift& shift, const Body& body, const Elements& elements,
               const VecX& rest)
      : shift_(shift), environment_(body.environment) {
    if (!shift.shifts() || !environment_ || environment_->uniform()) return;
    for (const auto& element : elements) {
      Vec3 sum = Vec3::Zero();
      for (const int v : element) sum += vertex(rest, v);
      centres_.push_back(sum / static_cast<double>(element.size()));
    }
  }

  // Returns the factors at a time [s]: of each element, one for all, or none if nothing is shifted.
  std::vector<double> at(double time) const {
    if (!shift_.shifts()) return {};
    if (centres_.empty())
      return {shift_.factor(environment_ ? environment_->temperature(time, Vec3::Zero())
                                         : room_temperature)};
    std::vector<double> factors;
    for (const Vec3& centre : centres_)
      factors.push_back(shift_.factor(environment_->temperature(time, centre)));
    return factors;
  }

 private:
  TemperatureShift shift_;
  const Environment* environment_ = nullptr;
  std::vector<Vec3> centres_;  // of elements at rest [m]; empty: one factor for all
};

}  // namespace tack
