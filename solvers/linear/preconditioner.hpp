// An approximate inverse M^-1 of a symmetric positive definite block matrix, itself symmetric positive
// definite.
#pragma once

#include "framework/config/registry.hpp"
#include "framework/core/block_matrix.hpp"
#include "framework/core/deadline.hpp"

namespace tack {

class MatrixSweeps;

class Preconditioner : public Component {
 public:
  static constexpr const char* kind_name = "preconditioner";
  static constexpr const char* kind_doc = "Approximate inverse that speeds up conjugate gradients.";

  // For this matrix; false where a 3x3 block on its diagonal is not positive definite, so neither is it. May throw
  // OutOfTime.
  virtual bool update(const BlockMatrix& matrix, const Deadline& deadline) = 0;
  virtual void apply(const VecX& r, VecX& z) = 0;  // z <- M^-1 r
  // Applies it and multiplies by the matrix in the same passes, if it is made of matrix sweeps.
  virtual MatrixSweeps* sweeps() { return nullptr; }
};

}  // namespace tack
