// Objective of a minimiser: a smooth function of the unknowns q (3m). The objective stores a
// current point and evaluates everything there, so that no quantity of a point (the active
// contacts, above all) is computed twice.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/core/block_matrix.hpp"
#include "framework/core/projection.hpp"
#include "geometry/types.hpp"

namespace tack {

struct LeastSquares;

/// Choice of a Hessian. Its dynamic part (Term::dynamic) changes with the contacts of the point;
/// the rest is inertia and elasticity.
struct HessianRequest {
  Projection projection = Projection::none;           // of every stencil
  std::optional<Projection> dynamic_projection = {};  // of dynamic stencils; none: `projection`
  // Flags of blocks of 3 unknowns. Stencils that touch a flagged block are clamped after
  // `projection`.
  const std::vector<char>* clamp_at = nullptr;
  bool without_dynamic = false;  // omits the dynamic part of the Hessian, not of the gradient
};

/// Part of an objective: inertia, or one term of the potential.
struct ObjectivePart {
  std::string name;      // "inertia", or that of the term
  bool dynamic = false;  // its stencils change with the contacts of the point (Term::dynamic)
  bool stores = true;    // a stored energy, not the dissipation of a step (Term::stores)
};

/// A smooth function of the unknowns with a current point.
class Objective {
 public:
  virtual ~Objective() = default;
  virtual int size() const = 0;

  virtual void move_to(const VecX& q) = 0;  // makes q the current point
  virtual double value() = 0;  // the incremental potential [J s^2 = kg m^2; quasi-static: J]
  /// Returns a bound of the rounding error of value(), which tells descent from noise.
  virtual double value_noise() const = 0;
  virtual const VecX& gradient() = 0;
  /// Returns the Hessian and updates the gradient. The next call overwrites the matrix.
  virtual const BlockMatrix& hessian(const HessianRequest& request) = 0;
  /// Returns the parts, the same for all points of a step; none: the objective is not divided.
  /// Methods that treat contact, friction and elasticity differently choose among them.
  virtual std::vector<ObjectivePart> parts() const { return {}; }
  /// Returns the value of a part at the current point; those of all parts add up to value(). Throws
  /// InputError if the objective is not divided.
  virtual double part_value(int part);
  /// Returns the gradient of a part; those of all parts add up to gradient().
  virtual VecX part_gradient(int part);
  /// Returns the least-squares form at the current point (residual_view.hpp). Throws InputError if
  /// the objective is no sum of squares.
  virtual LeastSquares least_squares() const;
  /// Returns the objective as a function of some blocks of 3 unknowns (ascending), the others at
  /// the current point: the same value but for a constant, the rows of these blocks of gradient and
  /// Hessian. Its cost is that of the stencils that these blocks move. It must not outlive this
  /// objective, whose current point is undefined until its next move_to(). The default throws
  /// InputError.
  virtual std::unique_ptr<Objective> restricted(std::span<const int> blocks);
  virtual int value_count() const = 0;  // evaluations of value() so far
};

}  // namespace tack
