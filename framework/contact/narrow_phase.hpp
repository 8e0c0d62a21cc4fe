// From candidates to active stencils.
// Candidates are grouped by (point, object): all that one point may see of one object is reduced to
// features together (point_features.hpp). Groups are made once per list of candidates. The area of a
// group's point is the one that faces the object (facing_area.hpp); it is taken when the group first
// appears in a time step and held for that step, so that the potential of a step is one function.
#pragma once

#include "framework/contact/contact_set.hpp"
#include "framework/contact/facing_area.hpp"

namespace tack {

// A point, an object, and the runs of candidates between the two.
struct PointGroup {
  int point = 0, object = 0;
  int triangle_begin = 0, triangle_end = 0;  // into candidates.point_triangle
  int edge_begin = 0, edge_end = 0;          // into candidates.point_edge
  int other_begin = 0, other_end = 0;        // into NarrowPhase::particles_
  double area = 0;                           // share of the point's area [m^2]

  std::array<int, 2> key() const { return {point, object}; }
};

class NarrowPhase {
 public:
  // Both must outlive the narrow phase.
  NarrowPhase(const ContactSurface& surface, const PairTable& pairs);

  // Takes a new list of candidates; x: the current configuration.
  void set_candidates(const Candidates& candidates, const VecX& x);
  // Forgets the areas of the last step and takes those of x.
  void begin_step(const Candidates& candidates, const VecX& x);
  // Stencils without a free vertex (non-zero) are left out; empty: every candidate has one.
  void set_free(std::vector<char> free) { free_ = std::move(free); }
  // The stencils closer than their law's range.
  void find(const Candidates& candidates, const VecX& x, ContactSet& contacts) const;

 private:
  void make_groups(const Candidates& candidates);
  void take_areas(const Candidates& candidates, const VecX& x);
  double area_of(const PointGroup& group, const Candidates& candidates, const VecX& x) const;

  const ContactSurface& surface_;
  const PairTable& pairs_;
  FacingArea facing_;
  std::vector<char> free_;  // per global vertex, or empty
  std::vector<std::array<int, 2>> particles_;  // particle candidates in both directions, sorted
  std::vector<PointGroup> groups_;             // by point, then object
  std::vector<PointGroup> known_;              // groups of this step with their areas, sorted
};

}  // namespace tack
