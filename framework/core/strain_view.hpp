// Access to the strains e(x) of a term whose energy is P(x) = 1/2 (e(x) - e_0)^T C (e(x) - e_0),
// e_0 the strains of its rest shape. Damping uses strain rates where positions alone do not
// determine the rotation of a stencil: for rods, whose frames are transported in time.
#pragma once

#include "framework/core/projection.hpp"
#include "geometry/types.hpp"

namespace tack {

/// Second base class of terms with strains.
class StrainView {
 public:
  /// e(x) of all stencils.
  virtual VecX strains(const VecX& x) const = 0;
  /// Compute P and its derivatives, in the slots of the term (Term::derivatives), with `rest` for
  /// e_0.
  virtual double value_from(const VecX& x, const VecX& rest) const = 0;
  virtual void derivatives_from(const VecX& x, const VecX& rest, Projection projection,
                                double* gradient, double* hessian) const = 0;

 protected:
  ~StrainView() = default;
};

}  // namespace tack
