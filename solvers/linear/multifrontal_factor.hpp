// Multifrontal Cholesky factorisation and triangular solves in arithmetic T (float or double) of a
// symmetrically scaled block matrix, D A D = P^T L L^T P with unit diagonal (Duff and Reid 1983;
// Liu 1992). Subtrees of the elimination tree run in parallel; in the nodes above, the dense
// kernels do. Children are added to parents in a fixed order, for the same bits with any number of
// threads.
#pragma once

#include <memory>

#include "framework/core/deadline.hpp"
#include "geometry/types.hpp"
#include "solvers/linear/supernode_tree.hpp"

namespace tack {

template <class T>
class MultifrontalFactor {
 public:
  // Factorises the matrix. Returns false if A is not positive definite in arithmetic T. The tree
  // must outlive the factor. Throws OutOfTime and leaves no factor.
  bool factorize(const SupernodeTree& tree, const BlockMatrix& matrix, const Deadline& deadline);
  void solve(const VecX& b, VecX& x);  // x <- A^-1 b

 private:
  using Buffer = std::unique_ptr<T[]>;
  bool process(int s, const BlockMatrix& matrix, bool parallel);
  void assemble(int s, const BlockMatrix& matrix);
  void add_child(int s, int child, bool parallel);
  void eliminate_parallel(int columns, int below, T* panel, int height, T* update, bool add);

  void forward(int s, const int* rows, T* x, T* scratch, bool parallel) const;
  void backward(int s, const int* rows, T* x, T* scratch, bool parallel) const;
  void forward_subtree(size_t i);
  void backward_subtree(size_t i);

  const SupernodeTree* tree_ = nullptr;
  VecX scale_;     // diagonal of D, before the permutation
  Buffer values_;  // panels; small triangles on the diagonal are stored inverted
  std::ptrdiff_t capacity_ = 0;
  std::vector<Buffer> updates_;       // Schur complements not yet added to the parent
  std::vector<T> x_;                  // permuted right side, then solution
  std::vector<std::vector<T>> work_;  // one per subtree, and one for the top
};

extern template class MultifrontalFactor<float>;
extern template class MultifrontalFactor<double>;

}  // namespace tack
