// Patches of the interior quadrature points of an overlap: the triangles of the opposite patch that
// may come within range of each point. Made once per list of candidates.
#pragma once

#include <vector>

#include "framework/contact/area_integral/surface_overlap.hpp"

namespace tack {

struct InteriorPatches {
  struct Range {
    int begin, end;  // into triangles
  };
  std::vector<Range> ranges;   // per sample
  std::vector<int> triangles;  // of the mesh
};

InteriorPatches make_interior_patches(const SurfaceOverlap& overlap, const CollisionMesh& mesh,
                                      const LaggedSurface& lagged, const BroadPhase& broad_phase);
// Adds the patches of the points of these indices (ascending), which were inserted since.
void add_interior_patches(const std::vector<int>& indices, const SurfaceOverlap& overlap,
                          const CollisionMesh& mesh, const LaggedSurface& lagged,
                          const BroadPhase& broad_phase, InteriorPatches& patches);

// Updates the patches of points whose object or opposite object has changed.
void update_interior_patches(const ChangedPrimitives& changed, const SurfaceOverlap& overlap,
                             const CollisionMesh& mesh, const LaggedSurface& lagged,
                             const BroadPhase& broad_phase, InteriorPatches& patches);

}  // namespace tack
