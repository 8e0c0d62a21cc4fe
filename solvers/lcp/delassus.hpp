// The Delassus operator W = J A^-1 J^T [1/kg] of rows that are added in the order of their numbers:
// dense in blocks of at most so many rows. What rows of different blocks do to each other goes
// through A itself, with a solve for each block in each sweep, and is not stored.
#pragma once

#include <vector>

#include "solvers/lcp/linearized_step.hpp"
#include "solvers/lcp/rows.hpp"

namespace tack {

class Delassus {
 public:
  struct Block {
    int first = 0;         // row
    Eigen::MatrixXd w;     // of its rows
    int rows() const { return static_cast<int>(w.rows()); }
    int end() const { return first + rows(); }
  };

  // most: rows of a block. Both others must outlive it.
  Delassus(LinearizedStep& step, const Rows& rows, int most)
      : step_(step), rows_(rows), most_(most) {}

  // Takes the rows that have been made since, which end where a block may end: at one of `ends`
  // (ascending).
  void extend(const std::vector<int>& ends);
  const std::vector<Block>& blocks() const { return blocks_; }
  // A^-1 J^T impulses, of rows first .. last - 1: velocities in the unknowns [m/s].
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
