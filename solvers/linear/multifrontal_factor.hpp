// Multifrontal Cholesky factorisation in arithmetic T (float or double) of a symmetrically scaled
// block matrix, D A D = P^T L L^T P with unit diagonal (Duff and Reid 1983; Liu 1992). Subtrees of
// the elimination tree, nodes above them and tiles of large nodes run in parallel as soon as what
// they read is complete (front_tasks.hpp). Children are added to parents in a fixed order, for the
// same bits with any number of threads.
#pragma once

#include <memory>

#include "framework/core/deadline.hpp"
#include "geometry/ordered_loop.hpp"
#include "geometry/types.hpp"
#include "solvers/linear/multifrontal_solve.hpp"
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
  bool set_scale(const BlockMatrix& matrix);
  bool run(const FrontTask& task, const BlockMatrix& matrix);
  bool process(int s, const BlockMatrix& matrix);
  void begin(int s);
  void open(int s, const FrontTiles& tiles, int tile, const BlockMatrix& matrix);
  void release_children(int s);
  bool eliminate(int s, const FrontTiles& tiles, int row, int column);
  void update(int s, const FrontTiles& tiles, int row, int column);
  void invert_tiles();
  void assemble(int s, int first, int last, const BlockMatrix& matrix);
  void add_child(int s, int child, int first, int last);

  const SupernodeTree* tree_ = nullptr;
  VecX scale_;     // diagonal of D, before the permutation
  Buffer values_;  // panels; small triangles on the diagonal are stored inverted
  std::ptrdiff_t capacity_ = 0;
  std::vector<Buffer> updates_;  // Schur complements not yet added to the parent
  OrderedLoop tasks_;
  MultifrontalSolve<T> solve_;
};

extern template class MultifrontalFactor<float>;
extern template class MultifrontalFactor<double>;

}  // namespace tack
