// An energy of rods or particles, whose elements roll by friction if the scene says so
// (contact_spins.hpp).
#pragma once

#include <algorithm>

#include "framework/config/field.hpp"
#include "framework/scene/scene_config.hpp"

namespace tack {

class RollingEnergy : public Energy {
 public:
  bool rolling() const { return rolling_; }

 protected:
  void rolling_field(Fields& f) {
    f.flag("rolling", rolling_,
           "friction exerts a torque with the lever arm contact_offset, so that it can roll; "
           "false: it slides without rotating");
  }

 private:
  bool rolling_ = false;
};

// Returns true if one of the object's energies is a rolling energy.
inline bool rolls(const ObjectConfig& object) {
  return std::any_of(object.energies.begin(), object.energies.end(), [](const auto& energy) {
    const auto* rolling = dynamic_cast<const RollingEnergy*>(energy.get());
    return rolling && rolling->rolling();
  });
}

}  // namespace tack
