// The triangles that each sample acts on, made once per list of candidates: those of the piece
// opposite that may come within range of it.
#pragma once

#include <vector>

#include "framework/contact/surface_overlap.hpp"

namespace tack {

struct SamplePieces {
  struct Piece {
    int begin, end;  // into triangles
  };
  std::vector<Piece> pieces;   // per sample
  std::vector<int> triangles;  // of the mesh
};

SamplePieces make_sample_pieces(const std::vector<ContactSample>& samples,
                                const CollisionMesh& mesh, const LaggedSurface& held,
                                const BroadPhase& broad_phase);
// The same for those of these numbers (ascending), which have been put among the others since.
void add_sample_pieces(const std::vector<int>& numbers, const std::vector<ContactSample>& samples,
                       const CollisionMesh& mesh, const LaggedSurface& held,
                       const BroadPhase& broad_phase, SamplePieces& pieces);

// Anew for those whose object, or the one opposite, has changed.
void renew_sample_pieces(const ChangedPrimitives& changed,
                         const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                         const LaggedSurface& held, const BroadPhase& broad_phase,
                         SamplePieces& pieces);

}  // namespace tack
