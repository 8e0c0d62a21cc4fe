// Improvement of tets inside a fixed surface. The worst tets and their neighbours are changed, one
// at a time, until all are good enough or nothing makes them better: edges and faces inside are
// removed, vertices inside moved, merged and added. The surface's vertices and triangles stay as
// they are, and so does what is good already. How good a tet can be is limited by its face if that
// is of the surface.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct ImprovedTets {
  std::vector<Vec3> vertices;  // [m]: those of the surface in their old order, then those inside
  std::vector<int> from;       // per vertex: its old number if it has not moved; -1: new or moved
  std::vector<Tet> tets;       // those that were kept in their old order, then those that are new
  std::vector<int> kept;       // of each tet: its number before; -1: it is new
  double before = 0, after = 0;  // the lowest mean ratio (mean_ratio.hpp)
};

// Improves positive tets that fill a volume. `goal`: the mean ratio that is good enough. The same
// input gives the same bits.
ImprovedTets improve_tets(const std::vector<Vec3>& vertices, const std::vector<Tet>& tets,
                          double goal);

}  // namespace tack
