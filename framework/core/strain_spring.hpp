// Access to a term whose energy is P(x) = 1/2 (e(x) - e_0)^T C (e(x) - e_0) in strains e, and whose
// rest strains e_0 may change: the spring of a Maxwell branch, in which e_0 flows.
#pragma once

#include "geometry/types.hpp"

namespace tack {

/// Second base class of such terms.
class StrainSpring {
 public:
  /// Returns e(x) of all stencils; the step has begun.
  virtual VecX spring_strains(const VecX& x) const = 0;
  virtual VecX rest_strains() const = 0;
  /// Sets e_0. Between steps, or in begin_step.
  virtual void set_rest_strains(const VecX& rest) = 0;
  /// Returns 1/2 e^T C e [J].
  virtual double energy_of(const VecX& strains) const = 0;

 protected:
  ~StrainSpring() = default;
};

}  // namespace tack
