// Where bonds can be made at the start of a step, and the bonds that are: what of a surface lies opposite another is taken triangle by
// triangle. One that is covered has three places, at the points of Gauss' rule, one that is covered in part those of its samples
// (contact/surface_overlap.hpp). Rods, particles, and a surface that meets itself have a place at each of their vertices that touches
// (contact/contact_points.hpp).
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
  bool whole;    // whether the triangle is covered all over
};

// Of the pairs that bond; the system has begun the step at x, and is there. barriers: the repulsive part of each law of its pairs.
std::vector<BondSite> bond_sites(const ContactSystem& system, const BondTable& table, const std::vector<PairLaw>& barriers, const VecX& x);

// The bond that is made there at x; none if the two are farther apart than bonds are when they are made.
std::optional<Bond> make_bond(const BondSite& site, const ContactSystem& system, const BondTable& table, const VecX& x);

}  // namespace tack
