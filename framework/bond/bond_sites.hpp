// Bond sites: places where bonds can be made at the start of a step, triangle by triangle of the
// overlap of two surfaces.
//   - Overlapping triangle: three sites, at its Gauss points.
//   - Partly overlapping triangle: its samples (contact/surface_overlap.hpp).
//   - Rods, particles, and a surface that meets itself: each vertex in contact
//     (contact/contact_points.hpp).
#pragma once

#include <optional>
#include <vector>

#include "framework/bond/bond.hpp"
#include "framework/bond/bond_table.hpp"
#include "framework/contact/contact_system.hpp"

namespace tack {

struct BondSite {
  int triangle;  // of the contact surface; -1: it is a vertex
  Vec3 inside;   // barycentric coordinates
  int vertex;    // global; of a triangle, its first one
  int anchor;    // the triangle opposite; -1: the closest one
  int object;    // opposite
  double area;   // m^2
  bool whole;    // whether the triangle overlaps as a whole
};

// Returns the sites of all pairs that bond. The system must have begun the step at x, and be there.
// barriers: the barrier of each law of its pairs.
std::vector<BondSite> bond_sites(const ContactSystem& system, const BondTable& table,
                                 const std::vector<PairLaw>& barriers, const VecX& x);

// Returns the bond made at a site at x; none if the surfaces are farther apart than the bonding
// distance.
std::optional<Bond> make_bond(const BondSite& site, const ContactSystem& system,
                              const BondTable& table, const VecX& x);

}  // namespace tack
