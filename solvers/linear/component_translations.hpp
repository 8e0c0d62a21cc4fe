// Translations of the components of a system (BlockMatrix::component) as a coarse space Z: the
// correction Z (Z^T A Z)^-1 Z^T is added to a local preconditioner (Mandel 1993; Dryja and Widlund
// 1987). Without it, the motion of a free body is the slowest mode of an iteration, and the
// residual hardly shows it. With it, the residual in the preconditioner's norm bounds the momentum
// error of every component.
#pragma once

#include <Eigen/SparseCholesky>

#include <utility>
#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

class ComponentTranslations {
 public:
  void update(const BlockMatrix& matrix);
  // z += Z (Z^T A Z)^-1 Z^T r. Returns r . (the correction).
  double add(const VecX& r, VecX& z);

 private:
  using Sparse = Eigen::SparseMatrix<double>;
  void index(const BlockMatrix& matrix);

  std::uint64_t version_ = 0;
  int columns_ = -1;
  std::vector<int> component_of_;  // per column: component, renumbered without gaps; -1: too small
  int components_ = 0;
  std::vector<int> coarse_of_;  // per block of the matrix: index in coarse_; -1: none
  struct Coarse {
    int row, column;
    Mat3 sum;
  };
  std::vector<Coarse> coarse_;  // blocks of the lower triangle of Z^T A Z
  Eigen::SimplicialLLT<Sparse, Eigen::Lower> factor_;
  bool usable_ = false;
  struct Run {
    int first, last;  // consecutive columns of one component
    int component;
    Vec3 sum;  // of a vector over its columns
    std::vector<std::pair<int, Mat3>>
        coarse_sums;  // index in coarse_, sum of blocks of its columns
  };
  void sum_blocks(const BlockMatrix& matrix, Run& run) const;

  std::vector<Run> runs_;
  VecX sums_;
};

}  // namespace tack
