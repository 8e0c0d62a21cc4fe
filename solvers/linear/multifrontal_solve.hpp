// Solves with a multifrontal Cholesky factor: forwards up the elimination tree, backwards down.
// Each node adds the contributions of its children in a fixed order, for the same bits with any
// number of threads.
#pragma once

#include <vector>

#include "geometry/ordered_loop.hpp"
#include "geometry/types.hpp"
#include "solvers/linear/supernode_tree.hpp"

namespace tack {

template <class T>
class MultifrontalSolve {
 public:
  // The tree must outlive the following solves.
  void reset(const SupernodeTree& tree);
  // x <- A^-1 b. panels: of the factor; scale: diagonal of D (multifrontal_factor.hpp).
  void solve(const T* panels, const VecX& scale, const VecX& b, VecX& x);

 private:
  void run(const FrontTask& task);
  // Subtrees.
  void forward_subtree(int i);
  void backward_subtree(int i);
  // Nodes above them.
  void gather(int s);
  void forward(int s);
  void scatter(int s);
  void backward(int s);
  // Tiles of large nodes.
  void lower(const FrontTask& task, const FrontTiles& tiles);
  void subtract(const FrontTask& task, const FrontTiles& tiles);
  void transposed_below(const FrontTask& task, const FrontTiles& tiles);
  void transposed(const FrontTask& task, const FrontTiles& tiles);

  const T* panel(int s) const { return panels_ + tree_->panel[s]; }
  T* own(int s) { return x_.data() + tree_->first[s]; }

  const SupernodeTree* tree_ = nullptr;
  const T* panels_ = nullptr;
  OrderedLoop tasks_;
  std::vector<T> x_;                  // permuted right side, then solution
  std::vector<std::vector<T>> work_;  // of subtrees: own columns, rows below the root, products
  std::vector<T> below_;              // of the top: rows below
  // First entry of the rows below in below_ (nodes of the top); subtree (roots of subtrees).
  std::vector<std::ptrdiff_t> place_;
  std::vector<bool> in_top_;  // nodes
};

extern template class MultifrontalSolve<float>;
extern template class MultifrontalSolve<double>;

}  // namespace tack
