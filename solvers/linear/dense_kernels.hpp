// BLAS and LAPACK kernels of sparse factorisations, for float and double. Matrices are
// column-major, triangles lower.
#pragma once

#include <cstddef>

extern "C" {
void openblas_set_num_threads(int threads);
#define TACK_DECLARE_KERNELS(p, T)                                                                \
  void p##trtri_(const char*, const char*, const int*, T*, const int*, int*);                     \
  void p##potrf_(const char*, const int*, T*, const int*, int*);                                  \
  void p##trsm_(const char*, const char*, const char*, const char*, const int*, const int*,       \
                const T*, const T*, const int*, T*, const int*);                                  \
  void p##syrk_(const char*, const char*, const int*, const int*, const T*, const T*, const int*, \
                const T*, T*, const int*);                                                        \
  void p##gemm_(const char*, const char*, const int*, const int*, const int*, const T*, const T*, \
                const int*, const T*, const int*, const T*, T*, const int*);                      \
  void p##gemv_(const char*, const int*, const int*, const T*, const T*, const int*, const T*,    \
                const int*, const T*, T*, const int*);
TACK_DECLARE_KERNELS(s, float)
TACK_DECLARE_KERNELS(d, double)
#undef TACK_DECLARE_KERNELS
}

namespace tack::blas {

inline void set_threads(int threads) { openblas_set_num_threads(threads); }

#define TACK_DEFINE_KERNELS(p, T)                                                           \
  /* A = L L^T in place, n x n; false if A is not positive definite. */                     \
  inline bool cholesky(int n, T* a, int lda) {                                              \
    int info = 0;                                                                           \
    p##potrf_("L", &n, a, &lda, &info);                                                     \
    return info == 0;                                                                       \
  }                                                                                         \
  /* L <- L^-1 in place, n x n, with a diagonal without zeros. */                           \
  inline void invert_lower(int n, T* l, int ldl) {                                          \
    int info = 0;                                                                           \
    p##trtri_("L", "N", &n, l, &ldl, &info);                                                \
  }                                                                                         \
  /* B <- B L^-T; B is m x n. */                                                            \
  inline void solve_right(int m, int n, const T* l, int ldl, T* b, int ldb) {               \
    const T one = 1;                                                                        \
    p##trsm_("R", "L", "T", "N", &m, &n, &one, l, &ldl, b, &ldb);                           \
  }                                                                                         \
  /* C <- C - A A^T (or = -A A^T); A is n x k. */                                           \
  inline void rank_update(int n, int k, const T* a, int lda, bool add, T* c, int ldc) {     \
    const T minus = -1, beta = add ? 1 : 0;                                                 \
    p##syrk_("L", "N", &n, &k, &minus, a, &lda, &beta, c, &ldc);                            \
  }                                                                                         \
  /* C <- C - A B^T (or = -A B^T); A is m x k, B n x k. */                                  \
  inline void product_update(int m, int n, int k, const T* a, int lda, const T* b, int ldb, \
                             bool add, T* c, int ldc) {                                     \
    const T minus = -1, beta = add ? 1 : 0;                                                 \
    p##gemm_("N", "T", &m, &n, &k, &minus, a, &lda, b, &ldb, &beta, c, &ldc);               \
  }                                                                                         \
  /* y <- A x; A is m x n. */                                                               \
  inline void multiply(int m, int n, const T* a, int lda, const T* x, T* y) {               \
    const T alpha = 1, beta = 0;                                                            \
    const int one = 1;                                                                      \
    p##gemv_("N", &m, &n, &alpha, a, &lda, x, &one, &beta, y, &one);                        \
  }                                                                                         \
  /* y <- y - A x; A is m x n. */                                                           \
  inline void subtract(int m, int n, const T* a, int lda, const T* x, T* y) {               \
    const T minus = -1, beta = 1;                                                           \
    const int one = 1;                                                                      \
    p##gemv_("N", &m, &n, &minus, a, &lda, x, &one, &beta, y, &one);                        \
  }                                                                                         \
  /* y <- y - A^T x; A is m x n. */                                                         \
  inline void subtract_transposed(int m, int n, const T* a, int lda, const T* x, T* y) {    \
    const T minus = -1, beta = 1;                                                           \
    const int one = 1;                                                                      \
    p##gemv_("T", &m, &n, &minus, a, &lda, x, &one, &beta, y, &one);                        \
  }
TACK_DEFINE_KERNELS(s, float)
TACK_DEFINE_KERNELS(d, double)
#undef TACK_DEFINE_KERNELS

}  // namespace tack::blas
