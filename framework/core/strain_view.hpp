// A term whose energy is quadratic in strains, P(x) = 1/2 (e(x) - e_0)^T C (e(x) - e_0), and that
// offers them, e_0 those of its rest shape. Damping takes their rates where vertices alone do not
// tell how a stencil has turned: of rods, whose frames are carried along.
#pragma once

#include "framework/core/projection.hpp"
#include "geometry/types.hpp"

namespace tack {

class StrainView {
 public:
  // e(x) of all stencils.
  virtual VecX strains(const VecX& x) const = 0;
  // P and its derivatives in the slots of the term (Term::derivatives), with `rest` in the place of
  // e_0.
  virtual double value_from(const VecX& x, const VecX& rest) const = 0;
  virtual void derivatives_from(const VecX& x, const VecX& rest, Projection projection,
                                double* gradient, double* hessian) const = 0;

 protected:
  ~StrainView() = default;
};

}  // namespace tack
