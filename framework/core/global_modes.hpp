// Global modes: a dense summand of low rank, sum_k c_k u_k u_k^T, of a symmetric matrix. A
// potential that depends on a whole surface by one number has such a Hessian: a gas, by the
// enclosed volume V, has -p'(V) grad V grad V^T. Modes are not assembled: matrix products add them,
// and inverses computed without them are corrected (mode_update.hpp).
#pragma once

#include <vector>

#include "framework/core/projection.hpp"
#include "geometry/types.hpp"

namespace tack {

/// One summand c u u^T.
struct GlobalMode {
  double coefficient = 0;  // c, of either sign
  VecX vector;             // u
};
using GlobalModes = std::vector<GlobalMode>;

/// y += sum_k c_k u_k (u_k . x)
inline void add_product(const GlobalModes& modes, const VecX& x, VecX& y) {
  for (const GlobalMode& mode : modes) y += mode.coefficient * mode.vector.dot(x) * mode.vector;
}

/// Second base class of a term whose Hessian has global modes.
class GlobalModeSource {
 public:
  /// Appends the modes over all vertices (3n). Coefficients are projected like eigenvalues.
  virtual void add_global_modes(const VecX& x, Projection projection, GlobalModes& modes) const = 0;

 protected:
  ~GlobalModeSource() = default;
};

}  // namespace tack
