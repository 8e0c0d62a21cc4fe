// Matrices of bodies made of springs: lattices of masses, each with springs to all that are next
// to it. Solids, sheets (one layer) and rods (one row), with the data that a preconditioner may
// use about them.
#pragma once

#include "framework/core/block_matrix.hpp"

namespace tack {

struct SpringLattice {
  int nodes[3] = {1, 1, 1};
  double stiffness = 1;  // [N/m]
  double mass = 1e-6;    // on the diagonal [N/m]
  Vec3 corner = Vec3::Zero();
};

// A spring between two nodes, as they are numbered body by body, that is no part of a body: a
// contact.
struct SpringContact {
  int one, other;
  double stiffness;
  Vec3 normal;
};

BlockMatrix spring_lattices(const std::vector<SpringLattice>& bodies,
                            const std::vector<SpringContact>& contacts = {});

}  // namespace tack
