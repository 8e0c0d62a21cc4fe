// Transfer of material data from old tets to new tets that fill the same volume. Each new tet gets,
// from the old tets that it overlaps, the stress-free volume and the volume means of the elastic
// strain and of the accumulated plastic strain.
//   conserved  mass; over any region that tets fill before and after: the integrals of the
//              Kirchhoff stress over the stress-free volume (of the Cauchy stress over space) and
//              of the plastic strain
//   yield      means lie within the yield surface, which is convex and grows linearly with
//              hardening
//   lost       stored energy, by the variance of the strain
#pragma once

#include <array>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct TetContent {
  double volume = 0;           // stress-free [m^3]
  Mat3 strain = Mat3::Zero();  // elastic Hencky strain in space
  double flow = 0;             // accumulated plastic strain
};

using TetCorners = std::vector<std::array<Vec3, 4>>;

// Returns the contents of the tets `to`. Both sets of tets are given by their current corners [m].
std::vector<TetContent> transfer_contents(const TetCorners& from,
                                          const std::vector<TetContent>& contents,
                                          const TetCorners& to);

}  // namespace tack
