// The translations of whole parts of a system (BlockMatrix::part) as a coarse space Z of a preconditioner:
// Z (Z^T A Z)^-1 Z^T, to be added to one that works locally (Mandel 1993; Dryja and Widlund 1987). Without it, what moves
// a free body is the slowest mode of an iteration and the one that its residual shows least; with it, the residual in
// the preconditioner's norm bounds the error of every part's momentum.
#pragma once

#include <Eigen/SparseCholesky>

#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

class PartTranslations {
 public:
  void update(const BlockMatrix& matrix);
  // z += Z (Z^T A Z)^-1 Z^T r. Returns r times what is added.
  double add(const VecX& r, VecX& z);

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  void index(const BlockMatrix& matrix);

  std::uint64_t version_ = 0;
  int columns_ = -1;
  std::vector<int> part_of_;    // of each column: a number without gaps; -1: its part is too small to count
  int parts_ = 0;
  std::vector<int> coarse_of_;  // of each block of the matrix: where its sum is; -1: nowhere
  struct Coarse {
    int row, column;
    Mat3 sum;
  };
  std::vector<Coarse> coarse_;  // blocks of the lower triangle of Z^T A Z
  Eigen::SimplicialLLT<Sparse, Eigen::Lower> factor_;
  bool usable_ = false;
  struct Run {
    int first, last;  // columns of one part, one after the other
    int part;
    Vec3 sum;
  };
  std::vector<Run> runs_;
  VecX sums_;
};

}  // namespace tack
