// Maps of a potential for its local problems (framework/stepping/local_potential.hpp): from blocks
// of unknowns to the vertices that they move, and from vertices to the lasting stencils of each
// term. Made once for the unknowns of a world; their cost is that of all stencils.
#pragma once

#include <span>
#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/term.hpp"
#include "geometry/vertex_items.hpp"

namespace tack {

class StencilMaps {
 public:
  // Terms and dofs must outlive the maps.
  StencilMaps(std::span<const Term* const> terms, const DofMap& dofs);

  // Returns the vertices that these blocks move, ascending.
  std::vector<int> moved_by(std::span<const int> blocks) const {
    return vertices_of_block_.touching(blocks);
  }
  // Returns the blocks (ascending) that lasting stencils connect with these, and these.
  std::vector<int> with_neighbours(std::span<const int> blocks) const;
  // Returns the stencils of each batch of a term that touch the vertices, ascending. Stencils of
  // dynamic terms are searched among all.
  std::vector<std::vector<int>> touching(const Term& term, std::span<const int> vertices);

 private:
  struct Mapped {
    const Term* term;
    std::vector<VertexItems> batches;
  };
  void add_blocks_of(int vertex, std::vector<int>& blocks) const;

  const DofMap& dofs_;
  int vertices_ = 0;
  VertexItems vertices_of_block_;
  std::vector<Mapped> lasting_;
  std::vector<char> marked_;  // per vertex; all zero between calls
};

}  // namespace tack
