// Random sparse block matrices.
#pragma once

#include <set>

#include "framework/core/block_matrix.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"

namespace tack {

inline MatX dense(const BlockMatrix& matrix) {
  MatX full = MatX::Zero(matrix.size(), matrix.size());
  for (int c = 0; c < matrix.columns(); ++c) {
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) {
      full.block<3, 3>(3 * matrix.row[k], 3 * c) = matrix.block(k);
      full.block<3, 3>(3 * c, 3 * matrix.row[k]) = matrix.block(k).transpose();
    }
  }
  return full;
}

// Diagonally dominant, with about `neighbours` blocks below each diagonal one.
inline BlockMatrix random_spd(int columns, RandomMotions& random, int neighbours = 4) {
  static std::uint64_t versions = 0;
  std::vector<std::set<int>> rows(columns);
  for (int c = 0; c < columns; ++c) {
    rows[c].insert(c);
    for (int k = 0; k < neighbours; ++k) rows[c].insert(static_cast<int>(random.uniform(c, columns)));
  }
  BlockMatrix matrix;
  matrix.version = ++versions;
  matrix.column_start.push_back(0);
  for (const auto& column : rows) {
    matrix.row.insert(matrix.row.end(), column.begin(), column.end());
    matrix.column_start.push_back(static_cast<int>(matrix.row.size()));
  }
  matrix.values.resize(9 * matrix.row.size());
  for (double& value : matrix.values) value = random.uniform(-1, 1);
  VecX weight = VecX::Constant(matrix.size(), 0.1);
  for (int c = 0; c < columns; ++c) {
    const int diagonal = matrix.column_start[c];
    const Mat3 block = matrix.block(diagonal);
    matrix.block(diagonal) = block + block.transpose();
    for (int k = diagonal; k < matrix.column_start[c + 1]; ++k) {
      weight.segment<3>(3 * matrix.row[k]) += matrix.block(k).cwiseAbs().rowwise().sum();
      weight.segment<3>(3 * c) += matrix.block(k).cwiseAbs().colwise().sum().transpose();
    }
  }
  for (int c = 0; c < columns; ++c)
    matrix.block(matrix.column_start[c]).diagonal() += weight.segment<3>(3 * c);
  return matrix;
}

}  // namespace tack
