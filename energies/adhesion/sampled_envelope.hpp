// The envelope of a damage law (damage_law.hpp) from any traction by opening: D as a monotone curve of the squared opening z, of which
// g(D) = K/2 (z D - integral of D) is exact. D = 1 - T(x) / (K x), K the largest T(x) / x.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "geometry/curves/cubic_curve.hpp"

namespace tack {

class SampledEnvelope {
 public:
  SampledEnvelope() = default;
  // traction(x) [Pa] of the openings 0 to end [m], beyond which there is none. Throws InputError, which begins with `what`, for a traction that does
  // not begin at 0, or that damage cannot follow because it gets stiffer.
  SampledEnvelope(const std::function<double(double)>& traction, double end, const char* what);

  double stiffness() const { return stiffness_; }  // K [Pa/m]

  double end() const { return end_; }
  double damage(double opening) const;
  double growth(double opening) const;
  double opening(double damage) const;
  double spent(double damage) const;

 private:
  double squared_opening(double damage) const;

  struct Knots {
    std::vector<double> squared, damage;
  };

  std::shared_ptr<const CubicCurve> damage_;  // by squared opening [m^2]
  std::shared_ptr<const Knots> knots_;        // of it
  double stiffness_ = 0, end_ = 0;
};

}  // namespace tack
