// Bond sites: points of a surface at which a step may make bonds. They are found at its start.
//   - Overlapping surfaces: the points of the overlap that the contact model finds
//     (ContactPotential::overlap_sites).
//   - Rods, particles, and a surface that meets itself: each vertex in contact
//     (contact/points/contact_points.hpp).
#pragma once

#include <optional>
#include <vector>

#include "framework/bond/bond.hpp"
#include "framework/bond/bond_table.hpp"
#include "framework/contact/contact_system.hpp"

namespace tack {

/// A point at which a bond may be made.
struct BondSite {
  int triangle;           // of the contact surface; -1: the site is a vertex
  Vec3 inside;            // barycentric coordinates
  int vertex;             // global index; the first vertex of a triangle
  int opposite_triangle;  // -1: the closest one
  int object;             // the opposite object
  double area;            // m^2
  bool whole;             // the whole triangle overlaps
};

/// Returns the sites of all pairs that bond. The system must have begun the step at x and still be
/// at x.
std::vector<BondSite> bond_sites(const ContactSystem& system, const BondTable& table,
                                 const VecX& x);

/// Returns the bond made at a site at x; none if the surfaces are farther apart than the bonding
/// distance.
std::optional<Bond> make_bond(const BondSite& site, const ContactSystem& system,
                              const BondTable& table, const VecX& x);

}  // namespace tack
