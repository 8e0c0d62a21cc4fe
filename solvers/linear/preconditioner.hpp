// Interface of preconditioners: a symmetric positive definite approximation M^-1 of the inverse of
// a symmetric positive definite block matrix.
#pragma once

#include "framework/config/registry.hpp"
#include "framework/core/block_matrix.hpp"
#include "framework/core/deadline.hpp"

namespace tack {

class MatrixSweeps;

/// Interface of preconditioners: update() for a matrix, then apply().
class Preconditioner : public Component {
 public:
  static constexpr const char* kind_name = "preconditioner";
  static constexpr const char* kind_doc = "Approximate inverse that speeds up conjugate gradients.";

  /// Prepares M for this matrix. Returns false if a 3x3 diagonal block is not positive definite;
  /// the matrix is not either then. May throw OutOfTime.
  virtual bool update(const BlockMatrix& matrix, const Deadline& deadline) = 0;
  virtual void apply(const VecX& r, VecX& z) = 0;  ///< z <- M^-1 r
  /// Returns the sweeps that apply M^-1 and multiply by the matrix in the same passes, or null if
  /// the preconditioner is not made of sweeps.
  virtual MatrixSweeps* sweeps() { return nullptr; }
};

}  // namespace tack
