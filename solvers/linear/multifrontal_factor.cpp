#include "solvers/linear/multifrontal_factor.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "geometry/parallel.hpp"
#include "solvers/linear/dense_kernels.hpp"
#include "solvers/linear/triangle_products.hpp"

namespace tack {
namespace {

constexpr int panel_rows = 192;          // rows per task of the parallel dense kernels
constexpr std::ptrdiff_t parallel_entries = 1 << 15;  // smaller panels run on one thread

template <class T>
std::unique_ptr<T[]> uninitialised(size_t n) {
  return std::unique_ptr<T[]>(new T[n]);
}

// Calls body(first, last) for each diagonal triangle of a node's own columns.
template <class T, class Body>
void for_each_triangle(int columns, const Body& body) {
  for (int first = 0; first < columns; first += triangle_columns<T>)
    body(first, std::min(first + triangle_columns<T>, columns));
}

// Replaces the diagonal triangles by their inverses.
template <class T>
void invert_triangles(int columns, T* panel, int height) {
  for_each_triangle<T>(columns, [&](int first, int last) {
    T* triangle = panel + first + std::ptrdiff_t(first) * height;
    blas::invert_lower(last - first, triangle, height);
    for (int j = 1; j < last - first; ++j) std::fill_n(triangle + std::ptrdiff_t(j) * height, j, T(0));
  });
}

// x <- L^-1 x.
template <class T>
void solve_lower(int columns, const T* panel, int height, T* x) {
  for_each_triangle<T>(columns, [&](int first, int last) {
    const T* triangle = panel + first + std::ptrdiff_t(first) * height;
    lower_times(last - first, triangle, height, x + first);
    if (last < columns)
      blas::subtract(columns - last, last - first, triangle + (last - first), height, x + first, x + last);
  });
}

// x <- L^-T x.
template <class T>
void solve_lower_transposed(int columns, const T* panel, int height, T* x) {
  for (int last = columns; last > 0;) {
    const int first = (last - 1) / triangle_columns<T> * triangle_columns<T>;
    const T* triangle = panel + first + std::ptrdiff_t(first) * height;
    if (last < columns)
      blas::subtract_transposed(columns - last, last - first, triangle + (last - first), height, x + last, x + first);
    lower_transposed_times(last - first, triangle, height, x + first);
    last = first;
  }
}

}  // namespace

template <class T>
bool MultifrontalFactor<T>::factorize(const SupernodeTree& tree, const BlockMatrix& matrix, const Deadline& deadline) {
  tree_ = &tree;
  scale_.resize(matrix.size());
  for_each(matrix.columns(), [&](int c) {
    scale_.segment<3>(3 * c) = matrix.block(matrix.column_start[c]).diagonal().cwiseSqrt().cwiseInverse();
  }, 1024);
  if (!scale_.allFinite()) return false;  // a diagonal entry is not positive
  if (capacity_ < tree.panel.back()) {
    capacity_ = tree.panel.back() + tree.panel.back() / 8;
    values_ = uninitialised<T>(capacity_ + triangle_overrun<T>);
  }
  std::fill_n(values_.get() + tree.panel.back(), triangle_overrun<T>, T(0));
  updates_.clear();
  updates_.resize(tree.nodes());
  std::atomic<bool> definite = true, late = false;
  const auto next = [&](int s, bool parallel) {
    if (!definite || late) return false;
    if (deadline.passed()) late = true;
    else if (!process(s, matrix, parallel)) definite = false;
    return true;
  };
  for_each(static_cast<int>(tree.subtrees.size()), [&](int i) {
    for (int s = tree.subtrees[i].first; s <= tree.subtrees[i].root; ++s)
      if (!next(s, false)) return;
  }, 1);
  for (const std::vector<int>& level : tree.top_levels)
    for_each(static_cast<int>(level.size()), [&](int k) { next(level[k], true); }, 1);
  if (late) throw OutOfTime();
  return definite;
}

template <class T>
bool MultifrontalFactor<T>::process(int s, const BlockMatrix& matrix, bool parallel) {
  const SupernodeTree& tree = *tree_;
  const int columns = tree.columns(s), height = tree.height(s), below = tree.below(s);
  const bool leaf = tree.child_start[s] == tree.child_start[s + 1];
  T* panel = values_.get() + tree.panel[s];
  assemble(s, matrix);
  if (below > 0) {
    updates_[s] = uninitialised<T>(static_cast<size_t>(below) * below);
    if (!leaf) std::fill_n(updates_[s].get(), static_cast<size_t>(below) * below, T(0));
  }
  for (int k = tree.child_start[s]; k < tree.child_start[s + 1]; ++k)
    add_child(s, tree.children[k], parallel);
  if (!blas::cholesky(columns, panel, height)) return false;
  if (parallel && std::ptrdiff_t(below) * height > parallel_entries) {
    eliminate_parallel(columns, below, panel, height, updates_[s].get(), !leaf);
  } else if (below > 0) {
    blas::solve_right(below, columns, panel, height, panel + columns, height);
    blas::rank_update(below, columns, panel + columns, height, !leaf, updates_[s].get(), below);
  }
  invert_triangles(columns, panel, height);
  return true;
}

template <class T>
void MultifrontalFactor<T>::eliminate_parallel(int columns, int below, T* panel, int height, T* update,
                                               bool add) {
  for_each_chunk(below, [&](int, int first, int last) {
    blas::solve_right(last - first, columns, panel, height, panel + columns + first, height);
  }, panel_rows);
  for_each_chunk(below, [&](int, int first, int last) {
    const T* rows = panel + columns + first;
    T* diagonal = update + first + std::ptrdiff_t(first) * below;
    blas::rank_update(last - first, columns, rows, height, add, diagonal, below);
    if (last < below)
      blas::product_update(below - last, last - first, columns, panel + columns + last, height, rows,
                           height, add, diagonal + (last - first), below);
  }, panel_rows);
}

template <class T>
void MultifrontalFactor<T>::assemble(int s, const BlockMatrix& matrix) {
  const SupernodeTree& tree = *tree_;
  const int height = tree.height(s);
  T* values = values_.get();
  std::fill(values + tree.panel[s], values + tree.panel[s + 1], T(0));
  // The scale of an entry follows from its permuted row and column.
  for (int k = tree.entry_start[s]; k < tree.entry_start[s + 1]; ++k) {
    const SupernodeTree::PanelEntry& entry = tree.entries[k];
    const auto block = matrix.block(entry.block);
    const std::ptrdiff_t offset = entry.at - tree.panel[s];
    const int column = tree.first[s] + static_cast<int>(offset / height);
    const int row = tree.rows[tree.row_start[s] + static_cast<int>(offset % height)];
    const double* rows = &scale_(tree.permutation[row]);
    const double* columns = &scale_(tree.permutation[column]);
    T* out = values + entry.at;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        out[i + std::ptrdiff_t(j) * height] =
            static_cast<T>((entry.transposed ? block(j, i) : block(i, j)) * rows[i] * columns[j]);
  }
}

template <class T>
void MultifrontalFactor<T>::add_child(int s, int child, bool parallel) {
  const SupernodeTree& tree = *tree_;
  const int columns = tree.columns(s), height = tree.height(s), below = tree.below(s);
  const int n = tree.below(child);
  const int* position = tree.position.data() + tree.row_start[child] + tree.columns(child);
  const T* from = updates_[child].get();
  T* panel = values_.get() + tree.panel[s];
  T* update = updates_[s].get();
  const auto add_column = [&](int j) {
    const T* column = from + std::ptrdiff_t(j) * n;
    if (position[j] < columns) {
      T* to = panel + std::ptrdiff_t(position[j]) * height;
      for (int i = j; i < n; ++i) to[position[i]] += column[i];
    } else {
      T* to = update + std::ptrdiff_t(position[j] - columns) * below - columns;
      for (int i = j; i < n; ++i) to[position[i]] += column[i];
    }
  };
  if (parallel) {
    for_each(n, add_column, 64);
  } else {
    for (int j = 0; j < n; ++j) add_column(j);
  }
  updates_[child].reset();
}

// Applies node s to the entries of x that `rows` numbers: the node's own columns first, then the
// rows below.
template <class T>
void MultifrontalFactor<T>::forward(int s, const int* rows, T* x, T* scratch, bool parallel) const {
  const int columns = tree_->columns(s), height = tree_->height(s), below = tree_->below(s);
  const T* panel = values_.get() + tree_->panel[s];
  T* own = x + rows[0];
  solve_lower(columns, panel, height, own);
  const auto rest = [&](int, int first, int last) {
    blas::multiply(last - first, columns, panel + columns + first, height, own, scratch + first);
    for (int k = first; k < last; ++k) x[rows[columns + k]] -= scratch[k];
  };
  if (parallel && std::ptrdiff_t(columns) * below > parallel_entries) {
    for_each_chunk(below, rest, panel_rows);
  } else if (below > 0) {
    rest(0, 0, below);
  }
}

template <class T>
void MultifrontalFactor<T>::backward(int s, const int* rows, T* x, T* scratch, bool parallel) const {
  const int columns = tree_->columns(s), height = tree_->height(s), below = tree_->below(s);
  const T* panel = values_.get() + tree_->panel[s];
  T* own = x + rows[0];
  for (int k = 0; k < below; ++k) scratch[k] = x[rows[columns + k]];
  const auto rest = [&](int, int first, int last) {
    blas::subtract_transposed(below, last - first, panel + columns + std::ptrdiff_t(first) * height,
                              height, scratch, own + first);
  };
  if (parallel && std::ptrdiff_t(columns) * below > parallel_entries) {
    for_each_chunk(columns, rest, panel_rows / 4);
  } else if (below > 0) {
    rest(0, 0, columns);
  }
  solve_lower_transposed(columns, panel, height, own);
}

template <class T>
void MultifrontalFactor<T>::forward_subtree(size_t i) {
  const auto [first, root] = tree_->subtrees[i];
  const int begin = tree_->first[first], own = tree_->first[root + 1] - begin, below = tree_->below(root);
  std::vector<T>& work = work_[i];  // own columns, rows below the root, scratch
  int tallest = 0;
  for (int s = first; s <= root; ++s) tallest = std::max(tallest, tree_->below(s));
  work.resize(static_cast<size_t>(own + below + tallest));
  std::copy_n(x_.begin() + begin, own, work.begin());
  std::fill_n(work.begin() + own, below, T(0));
  for (int s = first; s <= root; ++s)
    forward(s, tree_->local.data() + tree_->row_start[s], work.data(), work.data() + own + below, false);
}

template <class T>
void MultifrontalFactor<T>::backward_subtree(size_t i) {
  const auto [first, root] = tree_->subtrees[i];
  const int begin = tree_->first[first], own = tree_->first[root + 1] - begin, below = tree_->below(root);
  std::vector<T>& work = work_[i];
  for (int k = 0; k < below; ++k) work[own + k] = x_[tree_->rows_below(root)[k]];
  for (int s = root; s >= first; --s)
    backward(s, tree_->local.data() + tree_->row_start[s], work.data(), work.data() + own + below, false);
  std::copy_n(work.begin(), own, x_.begin() + begin);
}

template <class T>
void MultifrontalFactor<T>::solve(const VecX& b, VecX& x) {
  const SupernodeTree& tree = *tree_;
  const int n = tree.size, subtrees = static_cast<int>(tree.subtrees.size());
  const double largest = b.cwiseProduct(scale_).lpNorm<Eigen::Infinity>();
  const double unit = largest > 0 ? largest : 1;  // keeps floats in range
  x_.resize(n);
  for_each(n, [&](int k) {
    const int old = tree.permutation[k];
    x_[k] = static_cast<T>(b(old) * scale_(old) / unit);
  }, 4096);
  work_.resize(subtrees + 1);
  std::vector<T>& scratch = work_.back();
  for (const int s : tree.top)
    scratch.resize(std::max<size_t>(scratch.size(), static_cast<size_t>(tree.below(s))));

  for_each(subtrees, [&](int i) { forward_subtree(static_cast<size_t>(i)); }, 1);
  for (int i = 0; i < subtrees; ++i) {
    const auto [first, root] = tree.subtrees[i];
    const int own = tree.first[root + 1] - tree.first[first];
    for (int k = 0; k < tree.below(root); ++k) x_[tree.rows_below(root)[k]] += work_[i][own + k];
    std::copy_n(work_[i].begin(), own, x_.begin() + tree.first[first]);
  }
  const auto rows = [&](int s) { return tree.rows.data() + tree.row_start[s]; };
  for (const int s : tree.top) forward(s, rows(s), x_.data(), scratch.data(), true);
  for (auto s = tree.top.rbegin(); s != tree.top.rend(); ++s)
    backward(*s, rows(*s), x_.data(), scratch.data(), true);
  for_each(subtrees, [&](int i) { backward_subtree(static_cast<size_t>(i)); }, 1);

  x.resize(n);
  for_each(n, [&](int k) {
    const int old = tree.permutation[k];
    x(old) = x_[k] * (unit * scale_(old));
  }, 4096);
}

template class MultifrontalFactor<float>;
template class MultifrontalFactor<double>;

}  // namespace tack
