// Transfer of material data from old tets to new tets of equal volume. Each new tet gets, from the
// old tets that it overlaps, the stress-free volume and the means over it of the elastic strain and
// of the accumulated plastic strain.
//   conserved  mass, integral of Kirchhoff's stress over the stress-free volume (Cauchy's over
//   space),
//              integral of the plastic strain, over any region that tets fill before and after
//   yield      means lie within the yield surface, which is convex and grows linearly with
//   hardening lost       stored energy, by the variance of the strain
#pragma once

#include <array>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct TetContent {
  double volume = 0;             // without stress [m^3]
  Mat3 strain = Mat3::Zero();    // elastic, Hencky's in space
  double flow = 0;               // accumulated plastic strain
};

using TetCorners = std::vector<std::array<Vec3, 4>>;

// Both sets of tets where they are now.
std::vector<TetContent> handed_on(const TetCorners& from, const std::vector<TetContent>& contents,
                                  const TetCorners& to);

}  // namespace tack
