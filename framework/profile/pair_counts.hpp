// Current numbers of candidates and active stencils of each pair of objects. A pair (a, a) is an
// object with itself.
#pragma once

#include <map>
#include <utility>

#include "framework/contact/terms/friction_term.hpp"
#include "framework/contact/stencils/stencil_kinds.hpp"

namespace tack {

using ObjectIds = std::pair<int, int>;  // ascending

struct PairCount {
  long candidates = 0;
  long points = 0;           // stencils of vertices that carry pressure
  long interior_points = 0;  // stencils of points inside triangles (surface_overlap.hpp)
  long safety_barriers = 0;  // stencils of points outside the integral
  long edges = 0;            // stencils of pairs of edges
  long friction = 0;         // contact points with friction or tangential adhesion

  // Returns the number of stencils, `contacts` of steps.csv.
  long stencils() const { return points + interior_points + safety_barriers + edges; }
  PairCount& operator+=(const PairCount& other);
};

// friction: may be null.
std::map<ObjectIds, PairCount> count_pairs(const ContactSystem& contact,
                                           const FrictionTerm* friction);

}  // namespace tack
