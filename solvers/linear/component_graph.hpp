// Couplings of a block matrix within components (BlockMatrix::component), in both directions.
// Without components, all couplings.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

struct ComponentGraph {
  explicit ComponentGraph(const BlockMatrix& matrix) : start(matrix.columns() + 1, 0) {
    const bool all = matrix.component.empty();
    const auto for_each_pair = [&](const auto& body) {
      for (int c = 0; c < matrix.columns(); ++c)
        for (int k = matrix.column_start[c] + 1; k < matrix.column_start[c + 1]; ++k)
          if (all || matrix.component[matrix.row[k]] == matrix.component[c]) body(matrix.row[k], c);
    };
    for_each_pair([&](int r, int c) { ++start[r + 1], ++start[c + 1]; });
    for (int c = 0; c < matrix.columns(); ++c) start[c + 1] += start[c];
    neighbour.resize(start.back());
    auto next = start;
    for_each_pair([&](int r, int c) { neighbour[next[r]++] = c, neighbour[next[c]++] = r; });
  }
  int degree(int column) const { return start[column + 1] - start[column]; }

  std::vector<int> start;      // first neighbour of each column, and the end
  std::vector<int> neighbour;  // columns
};

}  // namespace tack
