// Union of vertex sets over multi-point constraints (dof_map.hpp): constrained vertices move
// together.
#pragma once

#include <span>

#include "framework/core/disjoint_sets.hpp"
#include "framework/core/dof_map.hpp"

namespace tack {

/// Joins the set of each dependent vertex with the sets of the vertices that it depends on. set_of:
/// a member of the set of each vertex; negative: the vertex is in no set.
inline void join_dependent(const DofMap& dofs, std::span<const int> set_of, DisjointSets& sets) {
  for (size_t k = 0; k < dofs.dependents().size(); ++k) {
    int first = set_of[dofs.dependents()[k]];
    for (const DofMap::WeightedIndex& entry : dofs.independents(static_cast<int>(k))) {
      const int set = set_of[entry.index];
      if (first >= 0 && set >= 0) sets.join(first, set);
      if (set >= 0) first = set;
    }
  }
}

}  // namespace tack
