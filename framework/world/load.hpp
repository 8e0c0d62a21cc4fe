// External load on an object: nodal forces that depend on time only, or a term for loads that
// depend on the configuration.
#pragma once

#include <vector>

#include "framework/body/body.hpp"
#include "framework/config/registry.hpp"

namespace tack {

class FollowingLoad;

/// Base of loads, which implement add_forces() or make_term().
class Load : public Component {
 public:
  static constexpr const char* kind_name = "load";
  static constexpr const char* kind_doc = "An external force on an object.";

  /// Adds the forces [N] at time t (3n). rest: 3n [m]; mass: per vertex [kg].
  virtual void add_forces(const Body& /*body*/, const VecX& /*rest*/, const VecX& /*mass*/,
                          double /*t*/, VecX& /*force*/) const {}
  /// Makes a term that replaces the forces, or returns null. The load and the arguments must
  /// outlive the term.
  virtual std::unique_ptr<FollowingLoad> make_term(const Body& /*body*/, const VecX& /*rest*/,
                                                   const VecX& /*mass*/) const;
  /// Returns the times of abrupt changes [s], at which adaptive steps end.
  virtual std::vector<double> corners() const { return {}; }
  /// Returns the drive of a protocol that is a factor of the forces; empty: none.
  virtual std::string drive() const { return {}; }
};

}  // namespace tack
