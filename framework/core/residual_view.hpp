// A term as least squares: P(x) = constant + 1/2 |r(x)|^2 + rest(x), for methods of Gauss-Newton
// type. The rest contains energies without residuals: linear potentials, and stencils of negative
// weight, whose energy has no lower bound. Its force is the gradient of the term minus J^T r.
// Methods that use the view keep this force constant at its value at one point.
//
// Like Term, a view computes all its stencils in one call. They are the current stencils of the
// term, at the configuration to which the contact system was last moved, and do not change with x.
#pragma once

#include <string>
#include <vector>

#include "framework/core/dof_map.hpp"

namespace tack {

/// Stencils of one kind: stencil s has `residuals` residuals of the vertices[arity * s +
/// (0..arity-1)].
struct ResidualBatch {
  int arity = 0;
  int residuals = 0;
  int count = 0;
  const int* vertices = nullptr;
};

/// Access to the residuals of a term.
class ResidualView {
 public:
  virtual ~ResidualView() = default;
  virtual std::vector<ResidualBatch> residual_batches() const = 0;
  /// Writes the residuals [J^1/2] of all stencils, batch by batch, and unless `jacobian` is null,
  /// for each stencil a row-major matrix [J^1/2 / m] of residuals x (3 arity). False where the
  /// energy is not finite; the written values are void then.
  virtual bool residuals(const VecX& x, double* r, double* jacobian) const = 0;
};

class Term;

/// An incremental potential at its present point, as
///     E(q) = 1/2 |q - prediction|_M^2 + sum over views of scale (1/2 |r|^2 + rest).
struct LeastSquares {
  std::vector<const ResidualView*> views;
  std::vector<double> scales;  // per view: s^2, or 1
  const DofMap& dofs;
  const VecX& x;           // 3n: the present configuration
  const VecX& block_mass;  // per free block [kg]; zero without inertia
};

/// Returns the view of each term. Throws InputError with the name of the first term without a view
/// and of the method `who` that needs it.
std::vector<const ResidualView*> residual_views(const std::vector<const Term*>& terms,
                                                const std::string& who);

}  // namespace tack
