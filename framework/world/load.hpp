// An external load on an object: forces on vertices that depend on time and not on the configuration, or a term for what follows it.
#pragma once

#include <vector>

#include "framework/body/body.hpp"
#include "framework/config/registry.hpp"

namespace tack {

class FollowingLoad;

class Load : public Component {
 public:
  static constexpr const char* kind_name = "load";
  static constexpr const char* kind_doc = "An external force on an object.";

  // Adds the forces [N] at time t (3n). rest: 3n [m]; mass: per vertex [kg].
  virtual void add_forces(const Body& /*body*/, const VecX& /*rest*/, const VecX& /*mass*/, double /*t*/, VecX& /*force*/) const {}
  // Or makes the term that acts in their place; the load, and what it is given, must outlive it. Null: there are forces.
  virtual std::unique_ptr<FollowingLoad> make_term(const Body& /*body*/, const VecX& /*rest*/, const VecX& /*mass*/) const;
  // The times at which it changes abruptly [s]: steps that adapt end there.
  virtual std::vector<double> corners() const { return {}; }
};

}  // namespace tack
