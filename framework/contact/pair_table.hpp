// Which laws act between which objects, and how the surface integral of a pair is taken.
//
// Energy per area needs an integral over the interface that does not depend on the meshes:
//  * Each pair of objects has an integration side: the vertices of its surface are the quadrature
//    points, weighted with their surface area (both sides, half each, within one object).
//  * A point sees the other surface through inclusion-exclusion (point_features.hpp), so that the
//    number of triangles around the closest point does not matter.
// These *pressure* stencils carry the whole law, barrier + adhesion. Edge-edge pairs and the points of
// the other side would count area again; they are *guards*: they carry the barrier alone, with a
// shorter range, and see to it that nothing passes where no quadrature point is near.
//
// Rods and particles have a width or a cross-section instead of an area, and surfaces do not know how much of
// theirs lies opposite. So between a surface and a rod or particle it is always the latter that integrates, whatever the
// side of the pair; between two rods, or a rod and a particle, what counts is where the shadows of the two overlap
// (rod_overlaps.hpp).
//
// Parts of surfaces may have laws of their own between them. A triangle or edge is of a part if all of its vertices are, and the whole takes
// part in the integral as before: the seam between two parts is a rim to each of them (part_of_surface.hpp), so that areas and forces are those of two
// objects that meet there. Of a triangle it is the one opposite that decides, of what is only guarded against, and of rods and particles, what is nearest.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/contact/pair_law.hpp"
#include "framework/contact/tangential_law.hpp"
#include "geometry/broad_phase/object_classes.hpp"

namespace tack {

// How the points of one object interact with the surface of another (or the edges of both).
struct PairRole {
  int law = -1;         // index into the laws; -1: no interaction
  double share = 0;     // factor on the area of the point (or edge pair)
  double range = 0;     // of the law [m]
  bool facing = false;  // pressure: of the point's area what faces the other surface, of that what faces the point
  int guard_law = -1;   // of what carries no pressure here; -1: none
  double guard_range = 0;    // m
  bool automatic = false;    // pressure only while this side is the one that captures more (integration_sides.hpp)
  bool finer = false;        // pressure only if this side has the finer surface
  bool by_size = false;      // both sides press, with shares by the sizes of their cells; beyond a rim, nothing does
  bool covered = false;      // only where the other surface lies opposite: stated tractions end at its rim
  bool bonds = false;        // what is covered bonds (framework/bond), or some of it
  bool pulls_too = false;    // then: other parts of it adhere by a law of the gap
  double range_of_parts = 0;  // the largest of laws between parts of the two objects [m]
  double most_uneven = std::numeric_limits<double>::infinity();  // of two edges' areas the larger counts up to so many times the smaller

  double reach() const { return std::max(range, range_of_parts); }
};

// Sets of parts that places are of, a bit for each.
using PartSet = std::uint64_t;

// What holds instead where one place is of some parts of the first object, the other of some of the second.
struct PartRoles {
  PartSet first = 0, second = 0;  // they have to be of all of these
  PairRole point, edge, thin;     // as below; point: of points of the first object
};

// Over classes of objects: what is set for two objects holds for all that are of their classes.
class PairTable {
 public:
  explicit PairTable(int objects) : PairTable(ObjectClasses::single(objects), std::vector<double>(objects, 0.0)) {}
  // cells: per object, the area of its surface that a vertex has in the mean [m^2].
  PairTable(ObjectClasses classes, std::vector<double> cells)
      : classes_(std::move(classes)), cells_(std::move(cells)), point_(classes_.entries()), edge_(classes_.entries()),
        thin_(classes_.entries()), offset_(classes_.entries(), 0.0) {}

  const ObjectClasses& classes() const { return classes_; }
  int objects() const { return classes_.objects(); }
  double cell(int object) const { return cells_[object]; }
  // Whether the surface of a is the finer one; of two alike, that of the first object is.
  bool finer(int a, int b) const { return a < b ? cells_[a] <= cells_[b] : cells_[a] < cells_[b]; }
  // Whether points of a press, or may: captures decide if the role is automatic.
  bool presses(int a, int b) const {
    const PairRole& role = point(a, b);
    return role.facing && (!role.finer || finer(a, b));
  }
  int add_law(PairLaw law, const TangentialLaw& tangential = {}) {
    laws_.push_back(std::move(law));
    tangential_.push_back(tangential);
    whole_.push_back(static_cast<int>(laws_.size()) - 1);
    return whole_.back();
  }
  // Adds a law that replaces `law` where an object is close to itself at rest (rest_gaps.hpp).
  int add_cut_down(int law, PairLaw cut_down) {
    const int added = add_law(std::move(cut_down), TangentialLaw(tangential_[law]));
    whole_[added] = law;
    return added;
  }
  // The law of the roles: of one that is cut down, that in whose place it acts.
  int whole(int law) const { return whole_[law]; }
  const std::vector<PairLaw>& laws() const { return laws_; }
  const TangentialLaw& tangential(int law) const { return tangential_[law]; }
  bool any_tangential() const {
    return std::any_of(tangential_.begin(), tangential_.end(), [](const auto& t) { return t.acts(); });
  }

  // Per vertex; empty: no object has parts.
  void set_parts(std::vector<PartSet> of_vertex) { part_of_vertex_ = std::move(of_vertex); }
  const std::vector<PartSet>& part_sets() const { return part_of_vertex_; }
  static constexpr int most_parts = 64;
  // Of points of a against b, the one that holds first first; for b against a they are set as well.
  void add_part(int a, int b, PartRoles roles) {
    if (parts_.empty()) parts_.resize(classes_.entries());
    largest_edge_range_ = std::max(largest_edge_range_, roles.edge.range);
    parts_[classes_.index(a, b)].push_back(std::move(roles));
  }
  bool has_parts(int a, int b) const { return !parts_.empty() && !parts_[classes_.index(a, b)].empty(); }
  int parts(int a, int b) const { return parts_.empty() ? 0 : static_cast<int>(parts_[classes_.index(a, b)].size()); }
  // That an element is of, by its vertices.
  template <std::size_t K>
  PartSet parts_of(const std::array<int, K>& vertices) const {
    PartSet all = ~PartSet(0);
    for (const int v : vertices) all &= part_of_vertex_[v];
    return all;
  }
  // Which of the parts' roles hold between two elements of a and b; -1: those of the whole objects.
  template <std::size_t K, std::size_t L>
  int part(int a, int b, const std::array<int, K>& of_a, const std::array<int, L>& of_b) const {
    if (!has_parts(a, b)) return -1;
    const PartSet first = parts_of(of_a), second = parts_of(of_b);
    const std::vector<PartRoles>& all = parts_[classes_.index(a, b)];
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((first & all[i].first) == all[i].first && (second & all[i].second) == all[i].second) return static_cast<int>(i);
    return -1;
  }
  const PartRoles& part_roles(int a, int b, int part) const { return parts_[classes_.index(a, b)][part]; }
  const PairRole& point(int a, int b, int part) const { return part < 0 ? point(a, b) : part_roles(a, b, part).point; }
  const PairRole& edge(int a, int b, int part) const { return part < 0 ? edge(a, b) : part_roles(a, b, part).edge; }
  const PairRole& thin(int a, int b, int part) const { return part < 0 ? thin(a, b) : part_roles(a, b, part).thin; }

  // Points of object a against the surface of object b.
  PairRole& point(int a, int b) { return point_[classes_.index(a, b)]; }
  const PairRole& point(int a, int b) const { return point_[classes_.index(a, b)]; }
  // Edges of a against edges of b; symmetric.
  void set_edge(int a, int b, const PairRole& role) {
    edge_[classes_.index(a, b)] = edge_[classes_.index(b, a)] = role;
    largest_edge_range_ = std::max(largest_edge_range_, role.range);
  }
  const PairRole& edge(int a, int b) const { return edge_[classes_.index(a, b)]; }
  double largest_edge_range() const { return largest_edge_range_; }
  // The whole law between rods and particles of a and anything of b, or the other way; symmetric.
  void set_thin(int a, int b, const PairRole& role) {
    thin_[classes_.index(a, b)] = thin_[classes_.index(b, a)] = role;
  }
  const PairRole& thin(int a, int b) const { return thin_[classes_.index(a, b)]; }

  // What is not there of the distance of two surfaces: half thicknesses [m].
  void set_offset(int a, int b, double offset) {
    offset_[classes_.index(a, b)] = offset_[classes_.index(b, a)] = offset;
    largest_offset_ = std::max(largest_offset_, offset);
  }
  double offset(int a, int b) const { return offset_[classes_.index(a, b)]; }
  double largest_offset() const { return largest_offset_; }
  // Beyond the laws: how far places may be apart that bond, offsets included [m].
  void set_bond_reach(double reach) { bond_reach_ = std::max(bond_reach_, reach); }
  double bond_reach() const { return bond_reach_; }

  bool any_automatic() const {
    return std::any_of(point_.begin(), point_.end(), [](const PairRole& role) { return role.automatic; });
  }
  bool any_covered() const {
    return std::any_of(point_.begin(), point_.end(), [](const PairRole& role) { return role.covered; });
  }

  // Whether any pair adheres by a law of the gap where it is covered, so that its rim pulls.
  bool any_rim() const {
    return std::any_of(point_.begin(), point_.end(), [](const PairRole& role) { return role.covered && (!role.bonds || role.pulls_too); });
  }

  // Plain IPC sums instead: every close pair of primitives counts, no inclusion-exclusion.
  bool plain_sums = false;

 private:
  ObjectClasses classes_;
  std::vector<double> cells_;  // m^2
  std::vector<PairLaw> laws_;
  std::vector<TangentialLaw> tangential_;  // per law
  std::vector<int> whole_;                 // likewise
  std::vector<PairRole> point_, edge_, thin_;
  std::vector<PartSet> part_of_vertex_;
  std::vector<std::vector<PartRoles>> parts_;  // empty without any
  std::vector<double> offset_;  // m
  double largest_edge_range_ = 0, largest_offset_ = 0, bond_reach_ = 0;  // m
};

}  // namespace tack
