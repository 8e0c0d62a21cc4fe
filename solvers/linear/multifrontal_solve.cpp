#include "solvers/linear/multifrontal_solve.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/parallel.hpp"
#include "solvers/linear/front_kernels.hpp"

namespace tack {
namespace {

constexpr int rows_per_chunk = 2048;

}  // namespace

template <class T>
void MultifrontalSolve<T>::reset(const SupernodeTree& tree) {
  tree_ = &tree;
  tasks_.reset(tree.solve_tasks.order);
  place_.assign(tree.nodes(), -1);
  in_top_.assign(tree.nodes(), false);
  std::ptrdiff_t size = 0;
  for (const int s : tree.top) {
    in_top_[s] = true;
    place_[s] = size;
    size += tree.below(s);
  }
  below_.resize(size);
  for (size_t i = 0; i < tree.subtrees.size(); ++i) place_[tree.subtrees[i].root] = static_cast<std::ptrdiff_t>(i);
  work_.resize(tree.subtrees.size());
}

template <class T>
void MultifrontalSolve<T>::solve(const T* panels, const VecX& scale, const VecX& b, VecX& x) {
  panels_ = panels;
  const int n = tree_->size;
  const double largest = max_chunks(n, 0.0, [&](int first, int last) {
    return b.segment(first, last - first).cwiseProduct(scale.segment(first, last - first)).template lpNorm<Eigen::Infinity>();
  }, rows_per_chunk);
  const double unit = largest > 0 ? largest : 1;  // keeps floats in range
  x_.resize(n);
  for_each(n, [&](int k) {
    const int old = tree_->permutation[k];
    x_[k] = static_cast<T>(b(old) * scale(old) / unit);
  }, rows_per_chunk);
  tasks_.run(tasks_.order().chunks(), [&](int c) { run(tree_->solve_tasks.tasks[c]); });
  x.resize(n);
  for_each(n, [&](int k) {
    const int old = tree_->permutation[k];
    x(old) = x_[k] * (unit * scale(old));
  }, rows_per_chunk);
}

template <class T>
void MultifrontalSolve<T>::run(const FrontTask& task) {
  using Kind = FrontTask::Kind;
  const int s = task.node;
  const auto tiles = [&] { return FrontTiles::of_solve(tree_->columns(s), tree_->height(s)); };
  switch (task.kind) {
    case Kind::subtree: return forward_subtree(s);
    case Kind::subtree_back: return backward_subtree(s);
    case Kind::whole: return forward(s);
    case Kind::whole_back: return backward(s);
    case Kind::gather: return gather(s);
    case Kind::lower: return lower(task, tiles());
    case Kind::subtract: return subtract(task, tiles());
    case Kind::scatter: return scatter(s);
    case Kind::transposed_below: return transposed_below(task, tiles());
    case Kind::transposed: return transposed(task, tiles());
    default: return;  // not of a solve
  }
}

template <class T>
void MultifrontalSolve<T>::forward_subtree(int i) {
  const SupernodeTree& tree = *tree_;
  const auto [first, root, work_units] = tree.subtrees[i];
  const int begin = tree.first[first], own = tree.first[root + 1] - begin, below = tree.below(root);
  std::vector<T>& work = work_[i];
  int tallest = 0;
  for (int s = first; s <= root; ++s) tallest = std::max(tallest, tree.below(s));
  work.resize(static_cast<size_t>(own + below + tallest));
  std::copy_n(x_.begin() + begin, own, work.begin());
  std::fill_n(work.begin() + own, below, T(0));
  T* products = work.data() + own + below;
  for (int s = first; s <= root; ++s) {
    const int columns = tree.columns(s), height = tree.height(s), rest = tree.below(s);
    const int* rows = tree.local.data() + tree.row_start[s];
    T* x = work.data();
    solve_lower(columns, panel(s), height, x + rows[0]);
    if (rest == 0) continue;
    blas::multiply(rest, columns, panel(s) + columns, height, x + rows[0], products);
    for (int k = 0; k < rest; ++k) x[rows[columns + k]] -= products[k];
  }
}

template <class T>
void MultifrontalSolve<T>::backward_subtree(int i) {
  const SupernodeTree& tree = *tree_;
  const auto [first, root, work_units] = tree.subtrees[i];
  const int begin = tree.first[first], own = tree.first[root + 1] - begin, below = tree.below(root);
  std::vector<T>& work = work_[i];
  for (int k = 0; k < below; ++k) work[own + k] = x_[tree.rows_below(root)[k]];
  T* gathered = work.data() + own + below;
  for (int s = root; s >= first; --s) {
    const int columns = tree.columns(s), height = tree.height(s), rest = tree.below(s);
    const int* rows = tree.local.data() + tree.row_start[s];
    T* x = work.data();
    for (int k = 0; k < rest; ++k) gathered[k] = x[rows[columns + k]];
    if (rest > 0) blas::subtract_transposed(rest, columns, panel(s) + columns, height, gathered, x + rows[0]);
    solve_lower_transposed(columns, panel(s), height, x + rows[0]);
  }
  std::copy_n(work.begin(), own, x_.begin() + begin);
}

// Adds what the children contribute to the node's own rows and to those below.
template <class T>
void MultifrontalSolve<T>::gather(int s) {
  const SupernodeTree& tree = *tree_;
  const int columns = tree.columns(s);
  T* x = own(s);
  T* below = below_.data() + place_[s];
  std::fill_n(below, tree.below(s), T(0));
  for (int k = tree.child_start[s]; k < tree.child_start[s + 1]; ++k) {
    const int child = tree.children[k], n = tree.below(child);
    const T* from = below_.data() + place_[child];
    if (!in_top_[child]) from = work_[place_[child]].data() + (tree.first[child + 1] - tree.first[tree.subtrees[place_[child]].first]);
    const int* position = tree.position.data() + tree.row_start[child] + tree.columns(child);
    int i = 0;
    for (; i < n && position[i] < columns; ++i) x[position[i]] += from[i];
    for (; i < n; ++i) below[position[i] - columns] += from[i];
  }
}

template <class T>
void MultifrontalSolve<T>::forward(int s) {
  gather(s);
  const int columns = tree_->columns(s), height = tree_->height(s);
  solve_lower(columns, panel(s), height, own(s));
  if (height > columns) blas::subtract(height - columns, columns, panel(s) + columns, height, own(s), below_.data() + place_[s]);
}

template <class T>
void MultifrontalSolve<T>::scatter(int s) {
  const int* rows = tree_->rows_below(s);
  for (int k = 0; k < tree_->below(s); ++k) below_[place_[s] + k] = x_[rows[k]];
}

template <class T>
void MultifrontalSolve<T>::backward(int s) {
  scatter(s);
  const int columns = tree_->columns(s), height = tree_->height(s);
  if (height > columns) blas::subtract_transposed(height - columns, columns, panel(s) + columns, height, below_.data() + place_[s], own(s));
  solve_lower_transposed(columns, panel(s), height, own(s));
}

template <class T>
void MultifrontalSolve<T>::lower(const FrontTask& task, const FrontTiles& tiles) {
  const int row = tiles.begin(task.row), rows = tiles.end(task.row) - row, column = tiles.begin(task.column);
  const T* tile = panel(task.node) + row + std::ptrdiff_t(column) * tiles.height;
  T* x = own(task.node);
  if (task.row == task.column) return solve_lower(rows, tile, tiles.height, x + row);
  blas::subtract(rows, tiles.end(task.column) - column, tile, tiles.height, x + column, x + row);
}

template <class T>
void MultifrontalSolve<T>::subtract(const FrontTask& task, const FrontTiles& tiles) {
  const int row = tiles.begin(task.row), rows = tiles.end(task.row) - row;
  blas::subtract(rows, tiles.columns, panel(task.node) + row, tiles.height, own(task.node),
                 below_.data() + place_[task.node] + (row - tiles.columns));
}

template <class T>
void MultifrontalSolve<T>::transposed_below(const FrontTask& task, const FrontTiles& tiles) {
  const int column = tiles.begin(task.column), columns = tiles.end(task.column) - column;
  if (tiles.height > tiles.columns)
    blas::subtract_transposed(tiles.height - tiles.columns, columns, panel(task.node) + tiles.columns + std::ptrdiff_t(column) * tiles.height,
                              tiles.height, below_.data() + place_[task.node], own(task.node) + column);
}

template <class T>
void MultifrontalSolve<T>::transposed(const FrontTask& task, const FrontTiles& tiles) {
  const int row = tiles.begin(task.row), rows = tiles.end(task.row) - row, column = tiles.begin(task.column);
  const T* tile = panel(task.node) + row + std::ptrdiff_t(column) * tiles.height;
  T* x = own(task.node);
  if (task.row == task.column) return solve_lower_transposed(rows, tile, tiles.height, x + row);
  blas::subtract_transposed(rows, tiles.end(task.column) - column, tile, tiles.height, x + row, x + column);
}

template class MultifrontalSolve<float>;
template class MultifrontalSolve<double>;

}  // namespace tack
