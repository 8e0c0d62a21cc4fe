// Parts of a symmetric matrix that couple everything with everything, and are of low rank: sum_k c_k u_k u_k^T. What depends on all of a
// surface by one number has such a Hessian: a gas by the volume that is enclosed, -p'(V) grad V grad V^T. They are neither assembled
// nor dropped: products add them, and who has an inverse without them corrects it (mode_update.hpp).
#pragma once

#include <vector>

#include "framework/core/projection.hpp"
#include "geometry/types.hpp"

namespace tack {

struct GlobalMode {
  double coefficient = 0;  // c, of either sign
  VecX vector;             // u
};
using GlobalModes = std::vector<GlobalMode>;

// y += sum_k c_k u_k (u_k . x)
inline void add_product(const GlobalModes& modes, const VecX& x, VecX& y) {
  for (const GlobalMode& mode : modes) y += mode.coefficient * mode.vector.dot(x) * mode.vector;
}

// What a term derives from as well whose Hessian has such parts.
class GlobalModeSource {
 public:
  // Adds them, over all vertices (3n), with coefficients that are projected as eigenvalues are.
  virtual void add_global_modes(const VecX& x, Projection projection, GlobalModes& modes) const = 0;

 protected:
  ~GlobalModeSource() = default;
};

}  // namespace tack
