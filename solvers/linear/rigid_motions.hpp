// The rigid motions of pieces of bodies (aggregates.hpp) as a coarse space Z of a preconditioner: Z (Z^T A Z)^-1 Z^T, to be added to one
// that works locally (Mandel 1993; Dryja and Widlund 1987; rigid modes: Brezina, Tong and Becker 2012). What strains a body over many
// elements is nearly rigid in each piece: the slowest modes of an iteration, and those that its residual shows least. The motions of whole
// bodies are sums of them, so that the residual in the preconditioner's norm bounds the error of every part's momentum
// (part_translations.hpp).
#pragma once

#include <Eigen/SparseCholesky>

#include <vector>

#include "framework/core/block_matrix.hpp"
#include "solvers/linear/aggregates.hpp"

namespace tack {

class RigidMotions {
 public:
  // False, and nothing to add, without places, or where Z^T A Z is not positive definite.
  bool update(const BlockMatrix& matrix);
  // z += Z (Z^T A Z)^-1 Z^T r. Returns r times what is added.
  double add(const VecX& r, VecX& z);

 private:
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  using Sparse = Eigen::SparseMatrix<double>;
  void index(const BlockMatrix& matrix);
  void find_frames(const BlockMatrix& matrix);
  void sum_columns(const BlockMatrix& matrix, int piece);
  bool factorize();

  Aggregates pieces_;
  std::vector<int> part_;         // of the matrix, when it was cut
  std::uint64_t version_ = 0;
  std::vector<Mat3> rotations_;   // of each piece: columns are axes, scaled so that a vertex moves by 1 as by a translation; or zero
  Eigen::Matrix3Xd arms_;         // of each column: from the centre of its piece
  // Sums over the blocks of a piece's columns whose rows are another's, Z_r^T A Z_c: from `sum_start_` of the columns' piece on.
  struct Sum {
    int row;      // the piece of the rows
    int mirror;   // the sum with both pieces exchanged
    Mat6 value;
  };
  std::vector<int> sum_start_;
  std::vector<Sum> sums_;
  std::vector<int> sum_of_;       // of each block of the matrix; -1: nowhere
  Sparse coarse_;                 // lower triangle of Z^T A Z
  Eigen::SimplicialLLT<Sparse, Eigen::Lower> factor_;
  VecX moments_;                  // six numbers a piece
};

}  // namespace tack
