// Current numbers of candidates and active stencils of each pair of objects. A pair (a, a) is an
// object with itself.
#pragma once

#include <map>
#include <utility>

#include "framework/contact/friction_term.hpp"

namespace tack {

using ObjectIds = std::pair<int, int>;  // ascending

struct PairCount {
  long candidates = 0;
  long points = 0;    // stencils of points that carry pressure
  long samples = 0;   // of points inside triangles (surface_overlap.hpp)
  long guards = 0;    // of points that only guard
  long edges = 0;     // of pairs of edges
  long friction = 0;  // contact points that friction or tangential adhesion holds

  long stencils() const { return points + samples + guards + edges; }  // `contacts` of steps.csv
  PairCount& operator+=(const PairCount& other);
};

// friction: may be null.
std::map<ObjectIds, PairCount> count_pairs(const ContactSystem& contact,
                                           const FrictionTerm* friction);

}  // namespace tack
