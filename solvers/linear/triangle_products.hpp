// Products x <- L x and x <- L^T x for small lower triangular matrices, stored by columns with
// zeros above the diagonal. BLAS calls cost more than these sums. In triangular solves with L^-1 in
// place of L, columns do not depend on each other.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

namespace tack {

namespace detail {

template <class T>
struct VectorOf;
template <>
struct VectorOf<float> {
  using Type = float __attribute__((vector_size(32)));
};
template <>
struct VectorOf<double> {
  using Type = double __attribute__((vector_size(32)));
};

template <class T>
struct Lane {
  static constexpr int count = 32 / sizeof(T);
  using Vector = typename VectorOf<T>::Type;
  static Vector load(const T* p) {
    Vector v;
    std::memcpy(&v, p, sizeof v);
    return v;
  }
};

// n in ((vectors - 1) * lanes, vectors * lanes].
template <int vectors, class T>
void lower_times(int n, const T* l, std::ptrdiff_t ldl, T* x) {
  using L = Lane<T>;
  typename L::Vector sum[vectors] = {};
  for (int j = 0; j < n; ++j, l += ldl)
    for (int k = 0; k < vectors; ++k) sum[k] += L::load(l + k * L::count) * x[j];
  T out[vectors * L::count];
  std::memcpy(out, sum, sizeof out);
  std::memcpy(x, out, n * sizeof(T));
}

template <int vectors, class T>
void lower_transposed_times(int n, const T* l, std::ptrdiff_t ldl, T* x) {
  using L = Lane<T>;
  T padded[vectors * L::count] = {};
  std::memcpy(padded, x, n * sizeof(T));
  typename L::Vector in[vectors];
  std::memcpy(in, padded, sizeof in);
  for (int j = 0; j < n; ++j, l += ldl) {
    typename L::Vector sum = L::load(l) * in[0];
    for (int k = 1; k < vectors; ++k) sum += L::load(l + k * L::count) * in[k];
    T total = 0;
    for (int i = 0; i < L::count; ++i) total += sum[i];
    x[j] = total;
  }
}

}  // namespace detail

// triangle_columns: largest triangle. triangle_overrun: numbers read after its last entry, which
// must be finite and count as zeros.
template <class T>
inline constexpr int triangle_columns = 4 * detail::Lane<T>::count;
template <class T>
inline constexpr int triangle_overrun = detail::Lane<T>::count - 1;

namespace detail {

// Calls body(vectors) with the constant number of vectors that n numbers need.
template <class T, class Body>
void with_vectors(int n, const Body& body) {
  switch ((n - 1) / Lane<T>::count) {
    case 0: return body(std::integral_constant<int, 1>());
    case 1: return body(std::integral_constant<int, 2>());
    case 2: return body(std::integral_constant<int, 3>());
    default: return body(std::integral_constant<int, 4>());
  }
}

}  // namespace detail

template <class T>
void lower_times(int n, const T* l, std::ptrdiff_t ldl, T* x) {
  detail::with_vectors<T>(n, [&](auto vectors) { detail::lower_times<vectors>(n, l, ldl, x); });
}

template <class T>
void lower_transposed_times(int n, const T* l, std::ptrdiff_t ldl, T* x) {
  detail::with_vectors<T>(
      n, [&](auto vectors) { detail::lower_transposed_times<vectors>(n, l, ldl, x); });
}

}  // namespace tack
