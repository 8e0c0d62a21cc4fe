// Improvement of tets inside a fixed surface. The worst tets and their neighbours are changed one
// at a time, until all reach the goal or no operation helps: interior edges and faces are removed;
// interior vertices are moved, merged and added. The vertices and triangles of the surface stay,
// and so do good tets. A surface face limits the quality of its tet.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct ImprovedTets {
  std::vector<Vec3> vertices;    // [m]: surface vertices in their old order, then interior ones
  std::vector<int> from;         // per vertex: old index; -1: new or moved
  std::vector<Tet> tets;         // kept tets in their old order, then new ones
  std::vector<int> kept;         // per tet: old index; -1: new
  double before = 0, after = 0;  // lowest mean ratio (mean_ratio.hpp)
};

// Improves positive tets that fill a volume. goal: target mean ratio. The same input gives the same
// bits.
ImprovedTets improve_tets(const std::vector<Vec3>& vertices, const std::vector<Tet>& tets,
                          double goal);

}  // namespace tack
