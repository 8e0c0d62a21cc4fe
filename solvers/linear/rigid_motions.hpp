// Rigid motions of aggregates (aggregates.hpp) as a coarse space Z: the correction Z (Z^T A Z)^-1
// Z^T is added to a local preconditioner (Mandel 1993; Dryja and Widlund 1987; rigid modes:
// Brezina, Tong and Becker 2012). Long-wave strains are nearly rigid in each aggregate; they are
// the slowest modes of an iteration, and the residual hardly shows them. Motions of whole
// components are sums of aggregate motions, so that the residual in the preconditioner's norm
// bounds every component's momentum error (component_translations.hpp).
#pragma once

#include <optional>
#include <vector>

#include "framework/core/block_matrix.hpp"
#include "framework/core/deadline.hpp"
#include "solvers/linear/aggregates.hpp"
#include "solvers/linear/cholmod_analysis.hpp"
#include "solvers/linear/multifrontal_factor.hpp"

namespace tack {

class RigidMotions {
 public:
  // Prepares the coarse space. Returns false, with no correction, if the matrix has no positions or
  // Z^T A Z is not positive definite. Throws OutOfTime.
  bool update(const BlockMatrix& matrix, const Deadline& deadline = {});
  // z += Z (Z^T A Z)^-1 Z^T r. Returns r . (the correction).
  double add(const VecX& r, VecX& z);

 private:
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  void index(const BlockMatrix& matrix);
  void find_frames(const BlockMatrix& matrix);
  void sum_columns(const BlockMatrix& matrix, int aggregate);
  void list_coarse_blocks();
  void fill_coarse_matrix();

  Aggregates aggregates_;
  std::vector<int> component_;  // BlockMatrix::component when the aggregates were built
  std::uint64_t version_ = 0;
  // Per aggregate: columns are axes, scaled so that a vertex moves by 1 as by a translation; or
  // zero.
  std::vector<Mat3> rotations_;
  Eigen::Matrix3Xd arms_;  // per column: vector from the centre of its aggregate
  // Sums Z_r^T A Z_c over the blocks of an aggregate's columns whose rows belong to another
  // aggregate; those of column aggregate c begin at sum_start_[c].
  struct Sum {
    int row;     // aggregate of the rows
    int mirror;  // index of the sum with both aggregates exchanged
    Mat6 value;
  };
  std::vector<int> sum_start_;
  std::vector<Sum> sums_;
  std::vector<int> sum_of_;  // per block of the matrix; -1: none
  // Z^T A Z: two block columns per aggregate, translations and rotations.
  BlockMatrix coarse_;
  CholmodAnalysis analysis_{CholmodAnalysis::Ordering::amd};
  std::optional<SupernodeTree> tree_;
  MultifrontalFactor<double> factor_;
  VecX moments_, motions_;  // six numbers per aggregate
};

}  // namespace tack
