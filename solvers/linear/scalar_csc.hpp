// The lower triangle of a block matrix as scalar compressed columns, the format of sparse solvers.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

struct ScalarCsc {
  std::vector<int> column_start, row;
  std::vector<double> values;

  void set_structure(const BlockMatrix& blocks);  // for a new pattern
  void set_values(const BlockMatrix& blocks);     // for the pattern set before
};

}  // namespace tack
