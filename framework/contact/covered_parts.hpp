// What the covered area of a pair of objects is made of, so far as it says how that area changes when vertices move
// (rim_forces.hpp).
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

// A part of a triangle that lies opposite a triangle of the other object, its leader.
struct CoveredPart {
  int triangle, leader;
  double area;      // towards the leader [m^2]
  double distance;  // m
};

// A piece of the rim that runs over a triangle: of an edge of the other object, from corner `side` of `other` to the next.
struct RimPart {
  int triangle;
  Vec3 inside;  // the middle of the piece: barycentric coordinates
  int other, side;
  double length;  // as seen along the normal of `other` [m]; negative where what is covered lies on its far side
};

// A triangle all of which lies opposite, and is near.
struct CoveredTriangle {
  int triangle;
  double area;  // towards what is opposite [m^2]
};

// Of points of object a opposite object b.
struct CoveredParts {
  int a, b;
  std::vector<CoveredPart> parts;
  std::vector<RimPart> rims;
  std::vector<CoveredTriangle> whole;  // of pairs that bond
};

}  // namespace tack
