#include "solvers/lcp/delassus.hpp"

#include <algorithm>

#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int batch = 96;  // right-hand sides per solve

}  // namespace

void Delassus::extend(const std::vector<int>& ends) {
  int at = blocks_.empty() ? 0 : blocks_.back().end();
  for (auto end = std::upper_bound(ends.begin(), ends.end(), at); end != ends.end(); ++end) {
    if (blocks_.empty() || (*end - blocks_.back().first > most_ && at > blocks_.back().first)) {
      if (!blocks_.empty()) grow(blocks_.back(), at);
      blocks_.push_back({at, {}});
    }
    at = *end;
  }
  if (!blocks_.empty()) grow(blocks_.back(), at);
}

// Computes the columns of the new rows and, by symmetry, their rows.
void Delassus::grow(Block& block, int end) {
  const int before = block.rows(), count = end - block.first;
  if (count == before) return;
  block.w.conservativeResize(count, count);
  for (int from = before; from < count; from += batch) {
    const int columns = std::min(batch, count - from);
    Eigen::MatrixXd y = Eigen::MatrixXd::Zero(step_.dofs().size(), columns);
    for (int k = 0; k < columns; ++k) {
      rows_.add_transposed(block.first + from + k, 1, y.col(k));
      step_.take_held_out(y.col(k));
    }
    step_.solve(y);
    ++solves_;
    for_each(columns, [&](int k) {
      for (int i = 0; i < count; ++i) block.w(i, from + k) = rows_.times(block.first + i, y.col(k));
    }, 1);
  }
  block.w.bottomLeftCorner(count - before, before) = block.w.topRightCorner(before, count - before).transpose().eval();
}

VecX Delassus::velocities(const VecX& impulses, int first, int last) const {
  Eigen::MatrixXd y = Eigen::MatrixXd::Zero(step_.dofs().size(), 1);
  for (int row = first; row < last; ++row)
    if (impulses[row] != 0) rows_.add_transposed(row, impulses[row], y.col(0));
  step_.take_held_out(y.col(0));
  step_.solve(y);
  ++solves_;
  return y.col(0);
}

}  // namespace tack
