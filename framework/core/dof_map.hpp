// Degrees of freedom: a free vertex owns three unknowns (one block), a fixed one none.
// Energies see the configuration x of all vertices (3n), minimisers the unknowns q (3m, m free).
#pragma once

#include <span>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

class DofMap {
 public:
  DofMap() = default;
  // movable[i] != 0 where vertex i is free.
  explicit DofMap(std::span<const char> movable);

  int vertex_count() const { return static_cast<int>(block_of_.size()); }
  int block_count() const { return static_cast<int>(vertex_of_.size()); }
  int size() const { return 3 * block_count(); }
  int block(int vertex_index) const { return block_of_[vertex_index]; }  // -1 where fixed
  int vertex_of_block(int block) const { return vertex_of_[block]; }
  const std::vector<int>& blocks() const { return block_of_; }

  void gather(const VecX& x, VecX& q) const;   // q <- the free part of x
  void scatter(const VecX& q, VecX& x) const;  // x's free part <- q; fixed vertices keep theirs

 private:
  std::vector<int> block_of_;
  std::vector<int> vertex_of_;
};

}  // namespace tack
