// (A + U C U^T)^-1 from A^-1, with few columns U and a diagonal C (Sherman, Morrison and Woodbury):
//     A^-1 - Z (C^-1 + U^T Z)^-1 Z^T,   Z = A^-1 U.
// For a positive definite A, the sum is positive definite if C^-1 + U^T Z and C have equal numbers
// of negative eigenvalues (Haynsworth's inertia additivity).
#pragma once

#include "framework/core/global_modes.hpp"

namespace tack {

/// Correction of an inverse for the global modes of a matrix.
class ModeUpdate {
 public:
  /// Prepares the update of a positive definite A. solve(b, x): x <- A^-1 b. Returns false if the
  /// sum is not positive definite or not finite.
  template <class Solve>
  bool prepare(const GlobalModes& modes, const Solve& solve) {
    return prepare_any(modes, solve) && definite();
  }
  /// Prepares the update of any invertible A; returns false if the sum is not invertible.
  template <class Solve>
  bool prepare_any(const GlobalModes& modes, const Solve& solve) {
    clear();
    VecX z;
    for (const GlobalMode& mode : modes) {
      if (mode.coefficient == 0 || mode.vector.isZero(0)) continue;
      solve(mode.vector, z);
      add(mode, z);
    }
    return finish();
  }
  void clear();
  bool empty() const { return columns_.empty(); }
  /// Replaces x = A^-1 b by (A + U C U^T)^-1 b.
  void apply(VecX& x) const;

 private:
  void add(const GlobalMode& mode, const VecX& solved);
  bool finish();
  bool definite() const;

  std::vector<VecX> columns_, solved_;  // U, Z
  std::vector<double> coefficients_;
  Eigen::MatrixXd inner_, inverse_;  // C^-1 + U^T Z, and its inverse
};

}  // namespace tack
