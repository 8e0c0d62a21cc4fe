// Joint relations solved for dependent vertices. Joints of affine bodies are linear in the frames
// of the bodies, so that trees and loops of joints cost no unknowns and have no error. Weights of
// blocks of three unknowns are scalars: the equations are solved for one coordinate.
#pragma once

#include <span>

#include "framework/world/multi_point_constraints.hpp"
#include "framework/world/joint.hpp"

namespace tack {

struct SolvedJoints {
  Dependences dependences;
  int redundant = 0;  // number of redundant relations
};

// Solves the relations by elimination with complete pivoting, first for vertices of frames, then
// for the joints' own vertices. Points of joints thus depend directly on bodies, without chains of
// dependences. known: dependences without joints. free[v] == 0: the vertex is fixed.
SolvedJoints solve_joints(std::span<const Joint> joints, const std::vector<AffineFrame>& frames,
                          const std::vector<char>& free, const Dependences& known);

}  // namespace tack
