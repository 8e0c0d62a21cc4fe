// Linear potentials of a world: weight and the loads on its objects.
#pragma once

#include <vector>

#include "framework/body/body.hpp"
#include "framework/core/linear_term.hpp"

namespace tack {

class Load;

// m g . (x_start - x).
class GravityTerm : public LinearTerm {
 public:
  GravityTerm() : LinearTerm("gravity") {}
  // mass: per vertex [kg]; gravity [m/s^2].
  void set_up(const VecX& mass, const Vec3& gravity);
  void begin_step(const StepStart& start) override { set_reference(start.x); }
};

// Loads, with the forces at the end of the step.
class LoadTerm : public LinearTerm {
 public:
  LoadTerm() : LinearTerm("loads") {}
  // All must outlive the term. rest: 3n [m]; mass: per vertex [kg].
  void add(const Load& load, const Body& body, const VecX& rest, const VecX& mass) {
    loads_.push_back({&load, &body, &rest, &mass});
  }
  std::vector<double> abrupt_times() const override;
  bool empty() const { return loads_.empty(); }
  VecX forces_at(double t, Eigen::Index size) const;  // forces as a vector of that size [N]
  void begin_step(const StepStart& start) override;

 private:
  struct Acting {
    const Load* load;
    const Body* body;
    const VecX *rest, *mass;
  };
  std::vector<Acting> loads_;
};

}  // namespace tack
