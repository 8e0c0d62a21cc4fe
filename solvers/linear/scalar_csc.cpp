#include "solvers/linear/scalar_csc.hpp"

namespace tack {

// Column 3c+i of the scalar matrix has rows 3c+i .. 3c+2 of the diagonal block, then all blocks
// below.
void ScalarCsc::set_structure(const BlockMatrix& blocks) {
  const int n = blocks.columns();
  column_start.assign(1, 0);
  column_start.reserve(3 * n + 1);
  row.clear();
  row.reserve(9 * blocks.row.size());
  for (int c = 0; c < n; ++c) {
    for (int i = 0; i < 3; ++i) {
      for (int k = i; k < 3; ++k) row.push_back(3 * c + k);
      for (int b = blocks.column_start[c] + 1; b < blocks.column_start[c + 1]; ++b)
        for (int k = 0; k < 3; ++k) row.push_back(3 * blocks.row[b] + k);
      column_start.push_back(static_cast<int>(row.size()));
    }
  }
  values.resize(row.size());
}

void ScalarCsc::set_values(const BlockMatrix& blocks) {
  for (int c = 0; c < blocks.columns(); ++c) {
    for (int i = 0; i < 3; ++i) {
      double* out = values.data() + column_start[3 * c + i];
      const double* diagonal = blocks.values.data() + 9 * static_cast<size_t>(blocks.column_start[c]);
      for (int k = i; k < 3; ++k) *out++ = diagonal[3 * i + k];
      for (int b = blocks.column_start[c] + 1; b < blocks.column_start[c + 1]; ++b) {
        const double* block = blocks.values.data() + 9 * static_cast<size_t>(b);
        for (int k = 0; k < 3; ++k) *out++ = block[3 * i + k];
      }
    }
  }
}

}  // namespace tack
