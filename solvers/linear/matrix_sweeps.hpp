// Sweeps through a symmetric block matrix A = L + diag(A) + L^T with the preconditioner M = (D + L)
// D^-1 (D + L^T) of conjugate gradients, an incomplete Cholesky factor that changes the diagonal
// only (D-ILU, Pommerell 1992; Barrett et al. 1994, 3.4.2):
//     D_i = A_ii - w sum_j L_ij D_j^-1 L_ij^T,    w = 1/2,
// and w = 0 (Gauss-Seidel) in rows where the pivot would keep too little of A_ii. D >= 0.6 diag(A)
// bounds the eigenvalues of M^-1 A by 3, as (D + L) + (D + L)^T - A = 2 D - diag(A).
// No factor is stored. One iteration sweeps forwards to solve and backwards to solve and to
// multiply by A, so that the product costs no pass of its own (Eisenstat 1981). Domains run in
// parallel, then their separators (domain_rows.hpp): the same bits for any number of threads.
#pragma once

#include <vector>

#include "framework/core/deadline.hpp"
#include "solvers/linear/domain_rows.hpp"

namespace tack {

class MatrixSweeps {
 public:
  // Computes D; keeps a reference to the matrix. Returns false if a diagonal block is not positive
  // definite. Throws OutOfTime.
  bool update(const BlockMatrix& matrix, int domain, const Deadline& deadline);

  // Resets product and directions to zero. An iteration is forward(), then backward().
  void begin();
  // x += step p, r -= step A p; then the first half of z = M^-1 r. Returns r . M^-1 r.
  double forward(double step, VecX& x, VecX& r);
  // Second half; p <- z + more + ratio p, and A p. more: ordered by vertices. Returns p . A p.
  double backward(double ratio, const VecX& more);
  // Second half alone, into z.
  void backward(VecX& z);

 private:
  void build(const BlockMatrix& matrix, int domain);
  bool find_pivots(const Deadline& deadline);
  template <class Body>
  double sum_over_parts(const std::vector<int>& start, const Body& body);
  double forward_rows(int first, int last, double step, VecX& x, VecX& r);
  template <bool multiply>
  double backward_rows(int first, int last, double ratio, const VecX* more);
  template <bool multiply>
  double backward_parts(double ratio, const VecX* more);
  template <int width>
  void collect(int first, int last, std::vector<double>& sums) const;
  void lend(int domain);
  struct View;
  View view();

  DomainRows rows_;
  std::uint64_t version_ = 0;
  const double* values_ = nullptr;
  // Entries below the diagonal of each column, in the order of rows_. target_: a row, or a slot of
  // the column's domain that stands for the row of a separator. source_: twice the block's index in
  // the matrix, plus one if it is transposed.
  std::vector<int> start_, target_, source_, diagonal_;
  std::vector<int> slot_start_, slot_row_;     // of each domain
  std::vector<int> later_start_, later_slot_;  // of each separator
  std::vector<double> inverse_;                // D^-1, nine each
  // Four numbers per row and slot; the fourth is padding.
  std::vector<double> z_, p_, lower_, product_;
  std::vector<double> partial_;
};

}  // namespace tack
