// What a minimiser sees: a smooth function of the unknowns q (3m). The objective holds a current
// point; everything is evaluated there, so nothing about a point (active contacts, above all) is
// computed twice.
#pragma once

#include <optional>
#include <vector>

#include "framework/core/block_matrix.hpp"
#include "framework/core/projection.hpp"
#include "geometry/types.hpp"

namespace tack {

struct LeastSquares;

// Which Hessian. The dynamic part is what changes with the point's contacts; the rest is inertia and elasticity.
struct HessianRequest {
  Projection projection = Projection::none;           // of every stencil
  std::optional<Projection> dynamic_projection = {};  // of the dynamic ones, if it is another
  // Flags of unknown blocks (3 unknowns): stencils that touch one with a flag are clamped, after `projection`.
  const std::vector<char>* clamp_at = nullptr;
  bool without_dynamic = false;  // leaves the dynamic part out; the gradient has it all the same
};

class Objective {
 public:
  virtual ~Objective() = default;
  virtual int size() const = 0;

  virtual void move_to(const VecX& q) = 0;  // makes q the current point
  virtual double value() = 0;               // the incremental potential [J s^2 = kg m^2; quasi-static: J]
  // A bound on the rounding error of value(), to tell descent from noise.
  virtual double value_noise() const = 0;
  virtual const VecX& gradient() = 0;
  // The gradient too is up to date afterwards. One matrix: the next call overwrites it.
  virtual const BlockMatrix& hessian(const HessianRequest& request) = 0;
  // At the present point (residual_view.hpp). Throws InputError if the objective is no sum of squares.
  virtual LeastSquares least_squares() const;
  virtual int value_count() const = 0;  // evaluations of value() so far
};

}  // namespace tack
