// The Delassus operator W = J A^-1 J^T [1/kg] of rows that are appended in ascending order.
// Diagonal blocks of limited size are stored densely. Coupling between blocks is not stored: it
// takes one solve with A per block and sweep.
#pragma once

#include <vector>

#include "solvers/lcp/linearized_step.hpp"
#include "solvers/lcp/rows.hpp"

namespace tack {

class Delassus {
 public:
  struct Block {
    int first = 0;      // first row
    Eigen::MatrixXd w;  // W among the rows of the block
    int rows() const { return static_cast<int>(w.rows()); }
    int end() const { return first + rows(); }
  };

  // most: limit of the rows of a block. The other arguments must outlive the operator.
  Delassus(LinearizedStep& step, const Rows& rows, int most)
      : step_(step), rows_(rows), most_(most) {}

  // Appends the rows made since the last call. A block may end only at an entry of `ends`
  // (ascending).
  void extend(const std::vector<int>& ends);
  const std::vector<Block>& blocks() const { return blocks_; }
  // Returns A^-1 J^T impulses of rows first .. last - 1: velocities of the unknowns [m/s].
  VecX velocities(const VecX& impulses, int first, int last) const;
  long solves() const { return solves_; }

 private:
  void grow(Block& block, int end);

  LinearizedStep& step_;
  const Rows& rows_;
  int most_;
  std::vector<Block> blocks_;
  mutable long solves_ = 0;
};

}  // namespace tack
