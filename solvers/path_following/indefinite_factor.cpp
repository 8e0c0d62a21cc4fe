#include "solvers/path_following/indefinite_factor.hpp"

#include "geometry/errors.hpp"

namespace tack {

bool IndefiniteFactor::factorize(const BlockMatrix& matrix, PhaseClock& clock) {
  if (!matrix.modes.empty()) throw SimulationError("path_following: the Hessian of a term has global modes, which it cannot factorise; take that term out of the scene");
  if (!factor_.factorize(matrix, clock)) return false;
  const VecX pivots = factor_.pivots();
  negative_pivots_ = static_cast<int>((pivots.array() < 0).count());
  return pivots.allFinite();
}

}  // namespace tack
