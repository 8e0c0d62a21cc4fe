// Linear potentials of a world: weight and the loads on its objects.
#pragma once

#include <vector>

#include "framework/body/body.hpp"
#include "framework/core/linear_term.hpp"

namespace tack {

class Drive;
class Load;

// Potential m g . (x_start - x) of gravity.
class GravityTerm : public LinearTerm {
 public:
  GravityTerm() : LinearTerm("gravity") {}
  // Sets the masses per vertex [kg] and gravity [m/s^2].
  void set_up(const VecX& mass, const Vec3& gravity);
  void begin_step(const StepStart& start) override { set_reference(start.x); }
};

// Potential of the loads, with the forces at the end of the step.
class LoadTerm : public LinearTerm {
 public:
  LoadTerm() : LinearTerm("loads") {}
  // Adds a load. All arguments must outlive the term. rest: 3n [m]; mass: per vertex [kg]; factor:
  // drive of a protocol, or null.
  void add(const Load& load, const Body& body, const VecX& rest, const VecX& mass,
           const Drive* factor) {
    loads_.push_back({&load, &body, &rest, &mass, factor});
  }
  std::vector<double> abrupt_times() const override;
  bool empty() const { return loads_.empty(); }
  // Returns the forces at time t [s] as a vector of this size [N].
  VecX forces_at(double t, Eigen::Index size) const;
  void begin_step(const StepStart& start) override;

 private:
  struct Acting {
    const Load* load;
    const Body* body;
    const VecX *rest, *mass;
    const Drive* factor;
  };
  std::vector<Acting> loads_;
};

}  // namespace tack
