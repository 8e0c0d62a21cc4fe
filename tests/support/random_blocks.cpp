#include "tests/support/random_blocks.hpp"

#include <set>

namespace tack {

MatX dense(const BlockMatrix& matrix) {
  MatX full = MatX::Zero(matrix.size(), matrix.size());
  for (int c = 0; c < matrix.columns(); ++c) {
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) {
      full.block<3, 3>(3 * matrix.row[k], 3 * c) = matrix.block(k);
      full.block<3, 3>(3 * c, 3 * matrix.row[k]) = matrix.block(k).transpose();
    }
  }
  return full;
}

BlockMatrix random_spd(int columns, RandomMotions& random, int neighbours) {
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

BlockMatrix grid(int n, RandomMotions& random, double stiffest) {
  static std::uint64_t versions = 1u << 20;
  BlockMatrix matrix;
  matrix.version = ++versions;
  matrix.column_start.push_back(0);
  const auto index = [&](int i, int j, int k) { return (i * n + j) * n + k; };
  for (int c = 0; c < n * n * n; ++c) {
    const int i = c / (n * n), j = c / n % n, k = c % n;
    matrix.row.push_back(c);
    if (k + 1 < n) matrix.row.push_back(index(i, j, k + 1));
    if (j + 1 < n) matrix.row.push_back(index(i, j + 1, k));
    if (i + 1 < n) matrix.row.push_back(index(i + 1, j, k));
    matrix.column_start.push_back(static_cast<int>(matrix.row.size()));
  }
  matrix.values.assign(9 * matrix.row.size(), 0.0);
  for (int c = 0; c < n * n * n; ++c) {
    const int diagonal = matrix.column_start[c];
    matrix.block(diagonal).diagonal().array() += 1;
    for (int e = diagonal + 1; e < matrix.column_start[c + 1]; ++e) {
      Mat3 root = Mat3::NullaryExpr([&] { return random.uniform(-1, 1); });
      const Mat3 spring = std::pow(stiffest, random.uniform(0, 1)) * (root * root.transpose());
      matrix.block(e) = -spring;
      matrix.block(diagonal) += spring;
      matrix.block(matrix.column_start[matrix.row[e]]) += spring;
    }
  }
  return matrix;
}

}  // namespace tack
