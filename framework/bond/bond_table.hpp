// Bond table: which pairs of objects bond, by which law and when. Indexed by classes of objects,
// like PairTable.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "framework/bond/bond.hpp"
#include "framework/bond/bond_law.hpp"
#include "framework/contact/laws/pair_table.hpp"
#include "geometry/broad_phase/object_classes.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

/// Law and conditions of the bonds of a pair.
struct BondRule {
  std::shared_ptr<const BondLaw> law;  // prepared
  std::string type;                    // registered name of the law
  bool on_contact = false;     // true: bonds form whenever surfaces meet, else at the start alone
  bool once = false;           // true: a site bonds with an object once in a run
  double pressure = 0;         // smallest pressure of the barrier at which new bonds form [Pa]
  double distance = 0;         // largest distance at which surfaces bond [m]
  bool from_touching = false;  // true: unstressed if the surfaces touch, else as they bonded
  PairLaw barrier;             // its pressure heals bonds
};

/// Bond rules by pair of objects.
class BondTable {
 public:
  // offsets: of the contact surface of each object from its mesh [m].
  BondTable(ObjectClasses classes, std::vector<double> offsets)
      : classes_(std::move(classes)), offsets_(std::move(offsets)), rule_(classes_.entries(), -1) {}

  int add(BondRule rule) {
    rules_.push_back(std::move(rule));
    return static_cast<int>(rules_.size()) - 1;
  }
  void set(int a, int b, int rule) {
    rule_[classes_.index(a, b)] = rule_[classes_.index(b, a)] = rule;
  }
  /// Sets the rules of the regions of two objects (PairTable::region_pair), in their order.
  void set_regions(int a, int b, const std::vector<int>& rules) {
    of_regions_.resize(classes_.entries());
    of_regions_[classes_.index(a, b)] = of_regions_[classes_.index(b, a)] = rules;
  }
  /// Returns the rule of a region of two objects, -1: they do not bond there. region: -1 for no
  /// region.
  int between(int a, int b, int region) const {
    return region < 0 ? rule_[classes_.index(a, b)] : of_regions_[classes_.index(a, b)][region];
  }
  /// Returns whether the two objects bond in any region.
  bool bonds(int a, int b) const {
    if (rule_[classes_.index(a, b)] >= 0) return true;
    if (of_regions_.empty()) return false;
    const std::vector<int>& regions = of_regions_[classes_.index(a, b)];
    return std::any_of(regions.begin(), regions.end(), [](int rule) { return rule >= 0; });
  }
  const std::vector<BondRule>& rules() const { return rules_; }
  bool empty() const { return rules_.empty(); }
  double offset(int object) const { return offsets_[object]; }

 private:
  ObjectClasses classes_;
  std::vector<double> offsets_;
  std::vector<BondRule> rules_;
  std::vector<int> rule_;
  std::vector<std::vector<int>> of_regions_;  // empty without any
};

/// Returns the rule of a bond, given its objects, triangle or first vertex, and opposite triangle;
/// -1: none.
inline int rule_of(const Bond& bond, const BondTable& table, const PairTable& pairs,
                   const CollisionMesh& mesh) {
  const Triangle& other = mesh.triangles[bond.opposite_triangle];
  const int region = bond.triangle < 0
                         ? pairs.region_pair(bond.a, bond.b, std::array{bond.vertices[0]}, other)
                         : pairs.region_pair(bond.a, bond.b, mesh.triangles[bond.triangle], other);
  return table.between(bond.a, bond.b, region);
}

}  // namespace tack
