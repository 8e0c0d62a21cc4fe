// Potential W(V) of the volume V that a surface encloses. Every point of the surface feels the
// pressure p = -W'(V) along its normal, for any shape (geometry/mesh/oriented_surface.hpp):
//     gradient -p grad V,    Hessian -p grad^2 V + W'' grad V grad V^T.
// The first summand of the Hessian belongs to edges and is projected in closed form, the second is
// a global mode.
//
// A surface with a boundary encloses no volume and takes only pressures that do not depend on one.
// V is then the volume of the cone from a point that is lagged; its gradient is the area except
// along the boundary. If the boundary is fixed, -p V is the potential. Along a moving boundary, the
// difference is lagged at the start of the step: the force there is that of the end of the step,
// except for the rotation and stretch of the boundary edges within the step.
#pragma once

#include <string>

#include "framework/core/global_modes.hpp"
#include "framework/load/following_load.hpp"
#include "geometry/mesh/oriented_surface.hpp"

namespace tack {

struct VolumeSample {
  double energy = 0;     // W [J]
  double pressure = 0;   // -W' [Pa]
  double stiffness = 0;  // W'', not negative [Pa/m^3]
};

class VolumeTerm : public FollowingLoad, public GlobalModeSource {
 public:
  // label: name in messages, probes and histories. The gas is on the side that the normals of the
  // triangles point away from.
  VolumeTerm(std::string name, std::string label, OrientedSurface surface)
      : FollowingLoad(std::move(name)), label_(std::move(label)), surface_(std::move(surface)) {
    for (const auto& e : surface_.edges()) ends_.insert(ends_.end(), {e.a, e.b});
  }
  const std::string& label() const { return label_; }
  const OrientedSurface& surface() const { return surface_; }

  // For probes, at an accepted state.
  // Returns the volume [m^3].
  double volume(const VecX& x) const { return surface_.volume(x, surface_.mean_position(x)); }
  // Returns the pressure on the surface [Pa].
  virtual double pressure(const VecX& x, double time) const = 0;
  // Returns the target volume [m^3]; NaN without one.
  virtual double target(double time) const;
  // Returns the amount of gas over that at rest; NaN without gas.
  virtual double amount() const;

  void begin_step(const StepStart& start) override;
  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override {
    return {{2, static_cast<int>(surface_.edges().size()), ends_.data()}};
  }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  void add_global_modes(const VecX& x, Projection projection, GlobalModes& modes) const override;
  void add_forces(const VecX& x, double fraction, VecX& forces) const override;

 protected:
  // Returns the potential and its derivatives at a fraction of the current step.
  virtual VolumeSample sample(double volume, double fraction) const = 0;

 private:
  // Returns the volume; of an open surface, that of its cone less that at the start of the step.
  double enclosed(const VecX& x) const;

  std::string label_;
  OrientedSurface surface_;
  std::vector<int> ends_;
  Vec3 origin_ = Vec3::Zero();
  // Lagged (a - origin) x (b - origin) / 6 of boundary edges; zero for others; empty without any
  std::vector<Vec3> boundary_;
  double cone_volume_t0_ = 0;  // of an open surface: its cone at the start of the step [m^3]
};

}  // namespace tack
