#include "solvers/linear/multifrontal_factor.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "geometry/parallel.hpp"
#include "solvers/linear/dense_kernels.hpp"
#include "solvers/linear/front_kernels.hpp"

namespace tack {
namespace {

template <class T>
std::unique_ptr<T[]> uninitialised(size_t n) {
  return std::unique_ptr<T[]>(new T[n]);
}

}  // namespace

template <class T>
bool MultifrontalFactor<T>::factorize(const SupernodeTree& tree, const BlockMatrix& matrix, const Deadline& deadline) {
  tree_ = &tree;
  if (!set_scale(matrix)) return false;
  if (capacity_ < tree.panel.back()) {
    capacity_ = tree.panel.back() + tree.panel.back() / 8;
    values_ = uninitialised<T>(capacity_ + triangle_overrun<T>);
  }
  std::fill_n(values_.get() + tree.panel.back(), triangle_overrun<T>, T(0));
  updates_.clear();
  updates_.resize(tree.nodes());
  std::atomic<bool> definite = true, late = false;
  const auto stopped = [&] {
    if (!late && deadline.passed()) late = true;
    return late || !definite;
  };
  tasks_.reset(tree.factor_tasks.order);
  tasks_.run(tasks_.order().chunks(), [&](int c) {
    const FrontTask& task = tree.factor_tasks.tasks[c];
    if (task.kind != FrontTask::Kind::subtree) {
      if (!stopped() && !run(task, matrix)) definite = false;
      return;
    }
    const SupernodeTree::Subtree& subtree = tree.subtrees[task.node];
    for (int s = subtree.first; s <= subtree.root && !stopped(); ++s)
      if (!process(s, matrix)) definite = false;
  });
  updates_.clear();
  if (late) throw OutOfTime();
  if (!definite) return false;
  invert_tiles();
  solve_.reset(tree);
  return true;
}

template <class T>
void MultifrontalFactor<T>::solve(const VecX& b, VecX& x) {
  solve_.solve(values_.get(), scale_, b, x);
}

// Returns false if a diagonal entry is not positive.
template <class T>
bool MultifrontalFactor<T>::set_scale(const BlockMatrix& matrix) {
  scale_.resize(matrix.size());
  std::atomic<bool> positive = true;
  for_each(matrix.columns(), [&](int c) {
    scale_.segment<3>(3 * c) = matrix.block(matrix.column_start[c]).diagonal().cwiseSqrt().cwiseInverse();
    if (!scale_.segment<3>(3 * c).allFinite()) positive = false;
  }, 512);
  return positive;
}

template <class T>
bool MultifrontalFactor<T>::run(const FrontTask& task, const BlockMatrix& matrix) {
  using Kind = FrontTask::Kind;
  const int s = task.node;
  const FrontTiles tiles = FrontTiles::of_factor(tree_->columns(s), tree_->height(s));
  switch (task.kind) {
    case Kind::whole: return process(s, matrix);
    case Kind::begin: begin(s); return true;
    case Kind::open: open(s, tiles, task.column, matrix); return true;
    case Kind::release: release_children(s); return true;
    case Kind::panel: return eliminate(s, tiles, task.row, task.column);
    case Kind::update: update(s, tiles, task.row, task.column); return true;
    default: return false;  // not of a factorisation
  }
}

// Factorises a node.
template <class T>
bool MultifrontalFactor<T>::process(int s, const BlockMatrix& matrix) {
  const SupernodeTree& tree = *tree_;
  const int columns = tree.columns(s), height = tree.height(s), below = tree.below(s);
  const bool leaf = tree.child_start[s] == tree.child_start[s + 1];
  T* panel = values_.get() + tree.panel[s];
  std::fill(panel, values_.get() + tree.panel[s + 1], T(0));
  assemble(s, 0, columns, matrix);
  begin(s);
  if (!leaf) std::fill_n(updates_[s].get(), static_cast<size_t>(below) * below, T(0));
  for (int k = tree.child_start[s]; k < tree.child_start[s + 1]; ++k) add_child(s, tree.children[k], 0, height);
  release_children(s);
  if (!blas::cholesky(columns, panel, height)) return false;
  if (below > 0) {
    blas::solve_right(below, columns, panel, height, panel + columns, height);
    blas::rank_update(below, columns, panel + columns, height, !leaf, updates_[s].get(), below);
  }
  invert_triangles(columns, panel, height);
  return true;
}

template <class T>
void MultifrontalFactor<T>::begin(int s) {
  const size_t below = static_cast<size_t>(tree_->below(s));
  if (below > 0) updates_[s] = uninitialised<T>(below * below);
}

// Sets the columns of a tile to the entries of the matrix and the Schur complements of the children.
template <class T>
void MultifrontalFactor<T>::open(int s, const FrontTiles& tiles, int tile, const BlockMatrix& matrix) {
  const SupernodeTree& tree = *tree_;
  const int first = tiles.begin(tile), last = tiles.end(tile), columns = tiles.columns, below = tree.below(s);
  if (tile < tiles.own) {
    // Above the diagonal too: products with triangles read numbers after their last entry.
    T* panel = values_.get() + tree.panel[s];
    std::fill(panel + std::ptrdiff_t(first) * tiles.height, panel + std::ptrdiff_t(last) * tiles.height, T(0));
    assemble(s, first, last, matrix);
  } else {
    for (int j = first - columns; j < last - columns; ++j)
      std::fill_n(updates_[s].get() + j + std::ptrdiff_t(j) * below, below - j, T(0));
  }
  for (int k = tree.child_start[s]; k < tree.child_start[s + 1]; ++k) add_child(s, tree.children[k], first, last);
}

template <class T>
void MultifrontalFactor<T>::release_children(int s) {
  for (int k = tree_->child_start[s]; k < tree_->child_start[s + 1]; ++k) updates_[tree_->children[k]].reset();
}

// Computes a tile of the factor from the tiles to the left of it and, below the diagonal, of the
// diagonal tile.
template <class T>
bool MultifrontalFactor<T>::eliminate(int s, const FrontTiles& tiles, int row, int column) {
  const int height = tiles.height, first = tiles.begin(row), rows = tiles.end(row) - first;
  const int before = tiles.begin(column), columns = tiles.end(column) - before;
  T* panel = values_.get() + tree_->panel[s];
  T* tile = panel + first + std::ptrdiff_t(before) * height;
  if (row == column) {
    if (before > 0) blas::rank_update(columns, before, panel + first, height, true, tile, height);
    return blas::cholesky(columns, tile, height);
  }
  if (before > 0) blas::product_update(rows, columns, before, panel + first, height, panel + before, height, true, tile, height);
  blas::solve_right(rows, columns, panel + before + std::ptrdiff_t(before) * height, height, tile, height);
  return true;
}

// Subtracts products of the factor's rows below from a tile of the Schur complement.
template <class T>
void MultifrontalFactor<T>::update(int s, const FrontTiles& tiles, int row, int column) {
  const int height = tiles.height, below = height - tiles.columns;
  const int first_row = tiles.begin(row), first_column = tiles.begin(column);
  const int rows = tiles.end(row) - first_row, columns = tiles.end(column) - first_column;
  const T* panel = values_.get() + tree_->panel[s];
  T* tile = updates_[s].get() + (first_row - tiles.columns) + std::ptrdiff_t(first_column - tiles.columns) * below;
  if (row == column) {
    blas::rank_update(rows, tiles.columns, panel + first_row, height, true, tile, below);
  } else {
    blas::product_update(rows, columns, tiles.columns, panel + first_row, height, panel + first_column, height, true, tile, below);
  }
}

template <class T>
void MultifrontalFactor<T>::invert_tiles() {
  std::vector<const FrontTask*> diagonal;
  for (const FrontTask& task : tree_->factor_tasks.tasks)
    if (task.kind == FrontTask::Kind::panel && task.row == task.column) diagonal.push_back(&task);
  for_each(static_cast<int>(diagonal.size()), [&](int k) {
    const int s = diagonal[k]->node, height = tree_->height(s);
    const FrontTiles tiles = FrontTiles::of_factor(tree_->columns(s), height);
    const int first = tiles.begin(diagonal[k]->column), last = tiles.end(diagonal[k]->column);
    invert_triangles(last - first, values_.get() + tree_->panel[s] + first + std::ptrdiff_t(first) * height, height);
  }, 1);
}

// Writes the matrix's entries of a node's columns [first, last).
template <class T>
void MultifrontalFactor<T>::assemble(int s, int first, int last, const BlockMatrix& matrix) {
  const SupernodeTree& tree = *tree_;
  const int height = tree.height(s), begin = tree.first[s];
  T* values = values_.get();
  for (int c = first - first % 3; c < last; c += 3) {
    const int from = std::max(first - c, 0), to = std::min(last - c, 3);  // columns of the block
    const double* columns = &scale_(tree.permutation[begin + c]);
    for (int k = tree.entry_start[(begin + c) / 3]; k < tree.entry_start[(begin + c) / 3 + 1]; ++k) {
      const SupernodeTree::PanelEntry& entry = tree.entries[k];
      const auto block = matrix.block(entry.block);
      // The scale of an entry follows from its permuted row and column.
      const std::ptrdiff_t offset = entry.at - tree.panel[s] - std::ptrdiff_t(c) * height;
      const double* rows = &scale_(tree.permutation[tree.rows[tree.row_start[s] + offset]]);
      T* out = values + entry.at;
      for (int j = from; j < to; ++j)
        for (int i = 0; i < 3; ++i)
          out[i + std::ptrdiff_t(j) * height] =
              static_cast<T>((entry.transposed ? block(j, i) : block(i, j)) * rows[i] * columns[j]);
    }
  }
}

// Adds the columns of a child's Schur complement that lie in columns [first, last) of the node's rows.
template <class T>
void MultifrontalFactor<T>::add_child(int s, int child, int first, int last) {
  const SupernodeTree& tree = *tree_;
  const int columns = tree.columns(s), height = tree.height(s), below = tree.below(s);
  const int n = tree.below(child);
  const int* position = tree.position.data() + tree.row_start[child] + tree.columns(child);
  const int begin = static_cast<int>(std::lower_bound(position, position + n, first) - position);
  T* panel = values_.get() + tree.panel[s];
  T* update = updates_[s].get();
  for (int j = begin; j < n && position[j] < last; ++j) {
    const T* column = updates_[child].get() + std::ptrdiff_t(j) * n;
    T* to = position[j] < columns ? panel + std::ptrdiff_t(position[j]) * height
                                  : update + std::ptrdiff_t(position[j] - columns) * below - columns;
    for (int i = j; i < n; ++i) to[position[i]] += column[i];
  }
}

template class MultifrontalFactor<float>;
template class MultifrontalFactor<double>;

}  // namespace tack
