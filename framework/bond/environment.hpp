// The temperature of a scene: a schedule, and a profile over the positions at rest. Bond laws that
// depend on the temperature read it (site_state.hpp), and energies (Energy).
#pragma once

#include <map>
#include <optional>
#include <string>

#include "framework/bond/site_state.hpp"
#include "framework/config/field.hpp"
#include "framework/config/formula.hpp"

namespace tack {

class Environment {
 public:
  void fields(Fields& f);
  /// Returns the temperature [K] of a material point, given its position at rest [m]. Throws
  /// SimulationError unless it is finite and above zero. Not thread-safe.
  double temperature(double time, const Vec3& rest_position) const;
  /// Returns true if the temperature is that of the schedule everywhere.
  bool uniform() const { return !compiled_; }

 private:
  std::string compile();

  Schedule temperature_ = room_temperature;  // K
  std::string profile_;                      // K; empty: none
  std::map<std::string, Quantity> parameters_;
  std::optional<Formula> compiled_;
};

}  // namespace tack
