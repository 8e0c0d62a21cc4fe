// An external load on an object: a force on vertices that depends on time, not on the configuration.
#pragma once

#include <vector>

#include "framework/config/registry.hpp"
#include "framework/scene/body.hpp"

namespace tack {

class Load : public Component {
 public:
  static constexpr const char* kind_name = "load";
  static constexpr const char* kind_doc = "An external force on an object.";

  // Adds the forces [N] at time t (3n). rest: 3n [m]; mass: per vertex [kg].
  virtual void add_forces(const Body& body, const VecX& rest, const VecX& mass, double t,
                          VecX& force) const = 0;
  // The times at which it changes abruptly [s]: steps that adapt end there.
  virtual std::vector<double> corners() const { return {}; }
};

}  // namespace tack
