// Triangular kernels of a multifrontal factor's nodes. The small triangles on a node's diagonal are
// stored inverted (triangle_products.hpp).
#pragma once

#include <algorithm>
#include <cstddef>

#include "solvers/linear/dense_kernels.hpp"
#include "solvers/linear/triangle_products.hpp"

namespace tack {

// panel: first entry of the node's columns, or of a tile on its diagonal; height: stride of
// columns.

// Replaces the triangles on the diagonal by their inverses.
template <class T>
void invert_triangles(int columns, T* panel, int height) {
  for (int first = 0; first < columns; first += triangle_columns<T>) {
    const int n = std::min(triangle_columns<T>, columns - first);
    T* triangle = panel + first + std::ptrdiff_t(first) * height;
    blas::invert_lower(n, triangle, height);
    for (int j = 1; j < n; ++j) std::fill_n(triangle + std::ptrdiff_t(j) * height, j, T(0));
  }
}

// x <- L^-1 x.
template <class T>
void solve_lower(int columns, const T* panel, int height, T* x) {
  for (int first = 0; first < columns; first += triangle_columns<T>) {
    const int last = std::min(first + triangle_columns<T>, columns);
    const T* triangle = panel + first + std::ptrdiff_t(first) * height;
    lower_times(last - first, triangle, height, x + first);
    if (last < columns)
      blas::subtract(columns - last, last - first, triangle + (last - first), height, x + first,
                     x + last);
  }
}

// x <- L^-T x.
template <class T>
void solve_lower_transposed(int columns, const T* panel, int height, T* x) {
  for (int last = columns; last > 0;) {
    const int first = (last - 1) / triangle_columns<T> * triangle_columns<T>;
    const T* triangle = panel + first + std::ptrdiff_t(first) * height;
    if (last < columns)
      blas::subtract_transposed(columns - last, last - first, triangle + (last - first), height,
                                x + last, x + first);
    lower_transposed_times(last - first, triangle, height, x + first);
    last = first;
  }
}

}  // namespace tack
