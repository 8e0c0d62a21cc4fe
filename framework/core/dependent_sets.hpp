// Vertices that depend on each other (dof_map.hpp) move together, and so do their sets.
#pragma once

#include <span>

#include "framework/core/disjoint_sets.hpp"
#include "framework/core/dof_map.hpp"

namespace tack {

// Joins the sets of each dependent vertex and of the vertices that it depends on. set_of: per
// vertex, a member of its set; below zero: it is in none.
inline void join_dependent(const DofMap& dofs, std::span<const int> set_of, DisjointSets& sets) {
  for (size_t k = 0; k < dofs.dependents().size(); ++k) {
    int first = set_of[dofs.dependents()[k]];
    for (const DofMap::Part& part : dofs.parts(static_cast<int>(k))) {
      const int set = set_of[part.leaf];
      if (first >= 0 && set >= 0) sets.join(first, set);
      if (set >= 0) first = set;
    }
  }
}

}  // namespace tack
