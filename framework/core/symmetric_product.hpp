// y = A x for a symmetric block matrix stored by its lower triangle. Every block is read once, for
// the sum of its row and, transposed, for that of its column: products with large matrices take as
// long as reading them. Parallel over runs of columns; sums for rows of later runs are kept apart
// and added in the order of the runs, so that the bits do not depend on the number of threads.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

/// Parallel product of a block matrix with a vector.
class SymmetricProduct {
 public:
  void multiply(const BlockMatrix& matrix, const VecX& x, VecX& y);

 private:
  void index(const BlockMatrix& matrix);
  void multiply_run(const BlockMatrix& matrix, const VecX& x, int run, int first, int last);

  std::uint64_t version_ = 0;
  int columns_ = -1;
  std::vector<int> sum_start_;  // the sums of each run: those of its own rows, then those of later
                                // ones; one more
  std::vector<int> sum_of_;     // of each block: the one of its run that its row belongs to
  std::vector<int> later_start_, later_;  // by row: its sums in earlier runs, in their order
  std::vector<double> sums_;              // four numbers each, of which three count
};

}  // namespace tack
