// What a minimiser sees: a smooth function of the unknowns q (3m). The objective holds a current
// point; everything is evaluated there, so nothing about a point (active contacts, above all) is
// computed twice.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"
#include "framework/core/spd_filter.hpp"
#include "geometry/types.hpp"

namespace tack {

struct LeastSquares;

class Objective {
 public:
  virtual ~Objective() = default;
  virtual int size() const = 0;

  virtual void move_to(const VecX& q) = 0;  // makes q the current point
  virtual double value() = 0;               // the incremental potential [J s^2 = kg m^2; quasi-static: J]
  // A bound on the rounding error of value(), to tell descent from noise.
  virtual double value_noise() const = 0;
  virtual const VecX& gradient() = 0;
  // The gradient too is up to date afterwards. One matrix: the next call of any of these overwrites it.
  virtual const BlockMatrix& hessian(SpdFilter filter) = 0;
  // Clamps the stencils that touch an unknown block (3 unknowns) with block[b] != 0, and only those.
  virtual const BlockMatrix& partly_clamped_hessian(const std::vector<char>& /*block*/) {
    return hessian(SpdFilter::clamp);
  }
  // Filters only what changes with the point's contacts: elements stay exact, and it may be indefinite.
  virtual const BlockMatrix& hessian_of_exact_elements(SpdFilter filter) { return hessian(filter); }
  // Clamped, of what does not change with the point's contacts: inertia and elasticity.
  virtual const BlockMatrix& contactless_hessian() { return hessian(SpdFilter::clamp); }
  // At the present point (residual_view.hpp). Throws InputError if the objective is no sum of squares.
  virtual LeastSquares least_squares() const;
  virtual int value_count() const = 0;  // evaluations of value() so far
};

}  // namespace tack
