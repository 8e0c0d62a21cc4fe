// The relations of joints, solved for vertices: joints of affine bodies are linear in the frames of these, so trees and loops of them cost no
// unknowns and leave no error. Blocks of three unknowns have scalar weights throughout, and so the equations are those of one coordinate.
#pragma once

#include <span>

#include "framework/world/multi_point_constraints.hpp"
#include "framework/world/joint.hpp"

namespace tack {

struct SolvedJoints {
  Dependences dependences;
  int idle = 0;  // relations that the others and what is held say already
};

// By elimination with complete pivoting: of the relations, down to what nothing determines (known: who follows whom without them), first for
// vertices of frames, then for the joints' own places. So the points of joints are what bodies between them follow, and chains are no
// chains of dependences. free[v] == 0: held.
SolvedJoints solve_joints(std::span<const Joint> joints, const std::vector<AffineFrame>& frames, const std::vector<char>& free, const Dependences& known);

}  // namespace tack
