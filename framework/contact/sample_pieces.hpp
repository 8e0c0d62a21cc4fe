// The triangles that each sample acts on, made once per list of candidates: those of the piece opposite that may
// come within range of it.
#pragma once

#include <vector>

#include "framework/contact/coverage.hpp"

namespace tack {

struct SamplePieces {
  std::vector<int> begin;      // into triangles; per sample, and the end
  std::vector<int> triangles;  // of the mesh
};

SamplePieces make_sample_pieces(const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                                const HeldSurface& held, const BroadPhase& broad_phase);

}  // namespace tack
