// What tets hand on to others that fill the same volume. Each new one gets, of all that it overlaps, the volume without stress, and the
// means over it of the elastic strain and of the accumulated plastic strain. So mass, the integral of Kirchhoff's stress over the
// volume without stress (that of Cauchy's over space) and the integral of the plastic strain stay, over any region that tets fill
// before and after. Means lie within the yield surface, which is convex and grows linearly with hardening: nothing flows because of them.
// The mean stores less than what it is of, by the variance of the strain.
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
std::vector<TetContent> handed_on(const TetCorners& from, const std::vector<TetContent>& contents, const TetCorners& to);

}  // namespace tack
