// How the points of one object integrate over the surface of another, for each ordered pair of
// objects. The laws, ranges and factors of pairs are those of all models (pair_table.hpp).
//
// Energy per area needs an integral over the interface that does not depend on the meshes:
//  * Quadrature points are the vertices of the integration side, weighted with their tributary
//    area, and interior points of partly overlapping triangles (surface_overlap.hpp). With
//    `by_size`, and within one object, both sides integrate, with weights that sum up to one.
//  * A point sees the other surface through inclusion-exclusion (point_features.hpp), so that the
//    number of triangles around the closest point does not matter.
// These stencils carry contact pressure: the whole law, barrier + adhesion. Edge-edge pairs and
// points of the other side would count area again. They are *safety-barrier pairs*: they carry the
// barrier alone, over a shorter range, so that nothing passes where no quadrature point is near.
//
// Codimensional elements (rods and particles) have a width or a cross-section instead of an area,
// and surfaces do not know their overlap with them. Between a surface and a codimensional element
// the latter integrates, whatever the integration side of the pair; between two rods, or a rod and
// a particle, the overlap of their projections counts (rod_overlaps.hpp).
//
// Regions (pair_table.hpp) take part in the integral as a whole: the interface of two regions is an
// overlap boundary of each (surface_region.hpp), so that areas and forces are those of two objects
// that meet there. The region of a triangle's integral is that of the triangle opposite; of
// safety-barrier pairs, rods and particles it is that of the nearest primitive.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/contact/laws/pair_table.hpp"

namespace tack {

struct IntegrationRule {
  // The point carries contact pressure: its weight is its projected tributary area towards the
  // other surface.
  bool carries_pressure = false;
  // Pressure only while this side is the secondary side by overlap (integration_sides.hpp).
  bool by_overlap = false;
  bool only_if_finer = false;  // pressure only if this side has the finer surface
  // Both sides carry pressure, with weights by the areas per vertex; none past an overlap boundary.
  bool by_size = false;
  bool overlap_only = false;     // integrates over the overlap alone (surface_overlap.hpp)
  bool boundary_forces = false;  // adheres over its overlap, whose boundary has forces
  bool overhangs = false;        // adheres: small overhangs have no force (overhang.hpp)
};

class IntegrationRules {
 public:
  explicit IntegrationRules(const ObjectClasses& classes)
      : classes_(classes), rules_(classes.entries()) {}

  // Points of object a against the surface of object b.
  IntegrationRule& of(int a, int b) { return rules_[classes_.index(a, b)]; }
  const IntegrationRule& of(int a, int b) const { return rules_[classes_.index(a, b)]; }
  // Returns whether points of a carry pressure, or may: with `by_overlap`, overlap areas decide.
  bool may_carry_pressure(int a, int b, const PairTable& pairs) const {
    const IntegrationRule& rule = of(a, b);
    return rule.carries_pressure && (!rule.only_if_finer || pairs.finer(a, b));
  }
  bool any(bool IntegrationRule::*flag) const {
    return std::any_of(rules_.begin(), rules_.end(),
                       [&](const IntegrationRule& rule) { return rule.*flag; });
  }

 private:
  ObjectClasses classes_;
  std::vector<IntegrationRule> rules_;
};

}  // namespace tack
