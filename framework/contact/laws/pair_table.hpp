// Laws between pairs of objects, and the roles of their points, edges, rods and particles: law,
// weight and range of each, for all contact models. What a model needs beyond that is in tables of
// its own (area_integral/integration_rules.hpp).
//
// *Safety-barrier pairs* carry the barrier alone, over a shorter range, where a model would count
// area again with the whole law.
//
// Regions of surfaces may have laws of their own. A triangle or edge belongs to a region if all of
// its vertices do.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "framework/contact/laws/pair_law.hpp"
#include "framework/contact/tangential_law.hpp"
#include "geometry/broad_phase/object_classes.hpp"

namespace tack {

// Interaction of the points of one object with the surface of another, or of the edges of both.
struct PairRole {
  int law = -1;            // index into the laws; -1: no interaction
  double area_factor = 0;  // factor on the tributary area of the point (or edge pair)
  double range = 0;        // of the law [m]
  // Contact points of the law cover the interface once: pressures and probes take areas from them.
  bool counts_area = false;
  int safety_barrier = -1;          // law of safety-barrier pairs; -1: none
  double safety_barrier_range = 0;  // m
  double search_range = 0;          // of pairs that the model needs beyond the ranges of laws [m]
  bool bonds = false;               // some or all of the overlap bonds (framework/bond)
  double region_range_max = 0;      // largest range of laws between regions of the objects [m]
  // Largest ratio of the areas of two edges: a larger area is cut to that ratio.
  double area_ratio_max = std::numeric_limits<double>::infinity();

  // Returns the largest range of the law and of the laws between regions [m].
  double range_max() const { return std::max(range, region_range_max); }
};

// A set of regions, one bit per region.
using RegionSet = std::uint64_t;

// Roles between elements in regions of the first object and elements in regions of the second.
struct RegionRoles {
  RegionSet first = 0, second = 0;      // the elements lie in all of these
  PairRole point, edge, codimensional;  // as in PairTable; point: of points of the first object
};

// Table over classes of objects: a role set for two objects holds for all objects of their classes.
class PairTable {
 public:
  explicit PairTable(int objects)
      : PairTable(ObjectClasses::single(objects), std::vector<double>(objects, 0.0)) {}
  // mean_tributary_areas: per object, of its surface vertices [m^2].
  PairTable(ObjectClasses classes, std::vector<double> mean_tributary_areas)
      : classes_(std::move(classes)), mean_tributary_areas_(std::move(mean_tributary_areas)),
        point_(classes_.entries()), edge_(classes_.entries()), codimensional_(classes_.entries()),
        offset_(classes_.entries(), 0.0) {}

  const ObjectClasses& classes() const { return classes_; }
  int objects() const { return classes_.objects(); }
  // Mean tributary area of the surface vertices of an object [m^2].
  double mean_tributary_area(int object) const { return mean_tributary_areas_[object]; }
  // Returns whether the surface of a is the finer one; of two equal ones that of the first object
  // is.
  bool finer(int a, int b) const {
    const double area_a = mean_tributary_area(a), area_b = mean_tributary_area(b);
    return a < b ? area_a <= area_b : area_a < area_b;
  }
  int add_law(PairLaw law, const TangentialLaw& tangential = {}) {
    barrier_laws_.push_back(law.only(LawTerm::barrier));
    adhesion_laws_.push_back(law.only(LawTerm::adhesion));
    laws_.push_back(std::move(law));
    tangential_.push_back(tangential);
    original_law_.push_back(static_cast<int>(laws_.size()) - 1);
    return original_law_.back();
  }
  // Adds a law that replaces `law` where an object is close to itself at rest (rest_gaps.hpp).
  int add_cut_down(int law, PairLaw cut_down) {
    const int added = add_law(std::move(cut_down), TangentialLaw(tangential_[law]));
    original_law_[added] = law;
    return added;
  }
  // Returns the law that a cut-down law replaces; any other law itself.
  int original_law(int law) const { return original_law_[law]; }
  const std::vector<PairLaw>& laws() const { return laws_; }
  // Returns all laws, each with one term alone.
  const std::vector<PairLaw>& laws(LawTerm term) const {
    if (term == LawTerm::barrier) return barrier_laws_;
    return term == LawTerm::adhesion ? adhesion_laws_ : laws_;
  }
  const TangentialLaw& tangential(int law) const { return tangential_[law]; }
  bool any_tangential() const {
    return std::any_of(tangential_.begin(), tangential_.end(),
                       [](const auto& t) { return t.acts(); });
  }

  // of_vertex: regions per vertex; empty: no object has regions.
  void set_regions(std::vector<RegionSet> of_vertex) { regions_of_vertex_ = std::move(of_vertex); }
  const std::vector<RegionSet>& region_sets() const { return regions_of_vertex_; }
  static constexpr int region_count_max = 64;
  // Adds roles of points of a towards b; the first that applies holds. Roles of b towards a are
  // added by a call of their own.
  void add_region_roles(int a, int b, RegionRoles roles) {
    if (region_roles_.empty()) region_roles_.resize(classes_.entries());
    largest_edge_range_ = std::max(largest_edge_range_, roles.edge.range);
    region_roles_[classes_.index(a, b)].push_back(std::move(roles));
  }
  bool has_regions(int a, int b) const {
    return !region_roles_.empty() && !region_roles_[classes_.index(a, b)].empty();
  }
  int region_pair_count(int a, int b) const {
    return region_roles_.empty() ? 0 : static_cast<int>(region_roles_[classes_.index(a, b)].size());
  }
  // Returns the regions of an element: those of all of its vertices.
  template <std::size_t K>
  RegionSet regions_of(const std::array<int, K>& vertices) const {
    RegionSet all = ~RegionSet(0);
    for (const int v : vertices) all &= regions_of_vertex_[v];
    return all;
  }
  // Returns the region pair of two elements of a and b: the index of their region roles; -1: the
  // roles of the objects hold.
  template <std::size_t K, std::size_t L>
  int region_pair(int a, int b, const std::array<int, K>& of_a,
                  const std::array<int, L>& of_b) const {
    if (!has_regions(a, b)) return -1;
    const RegionSet first = regions_of(of_a), second = regions_of(of_b);
    const std::vector<RegionRoles>& all = region_roles_[classes_.index(a, b)];
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((first & all[i].first) == all[i].first && (second & all[i].second) == all[i].second)
        return static_cast<int>(i);
    return -1;
  }
  const RegionRoles& region_roles(int a, int b, int region_pair) const {
    return region_roles_[classes_.index(a, b)][region_pair];
  }
  const PairRole& point(int a, int b, int region_pair) const {
    return region_pair < 0 ? point(a, b) : region_roles(a, b, region_pair).point;
  }
  const PairRole& edge(int a, int b, int region_pair) const {
    return region_pair < 0 ? edge(a, b) : region_roles(a, b, region_pair).edge;
  }
  const PairRole& codimensional(int a, int b, int region_pair) const {
    return region_pair < 0 ? codimensional(a, b) : region_roles(a, b, region_pair).codimensional;
  }

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
  // Roles between rods and particles of a and all primitives of b, or the other way; symmetric.
  // They carry pressure.
  void set_codimensional(int a, int b, const PairRole& role) {
    codimensional_[classes_.index(a, b)] = codimensional_[classes_.index(b, a)] = role;
  }
  const PairRole& codimensional(int a, int b) const { return codimensional_[classes_.index(a, b)]; }

  // Offset: the sum of half thicknesses of two surfaces [m].
  void set_offset(int a, int b, double offset) {
    offset_[classes_.index(a, b)] = offset_[classes_.index(b, a)] = offset;
    largest_offset_ = std::max(largest_offset_, offset);
  }
  double offset(int a, int b) const { return offset_[classes_.index(a, b)]; }
  double largest_offset() const { return largest_offset_; }
  // Largest distance at which sites bond, offsets included [m].
  void set_bond_range(double range) { bond_range_ = std::max(bond_range_, range); }
  double bond_range() const { return bond_range_; }

 private:
  ObjectClasses classes_;
  std::vector<double> mean_tributary_areas_;  // per object [m^2]
  std::vector<PairLaw> laws_, barrier_laws_, adhesion_laws_;
  std::vector<TangentialLaw> tangential_;  // per law
  std::vector<int> original_law_;          // per law: the law that it replaces
  std::vector<PairRole> point_, edge_, codimensional_;
  std::vector<RegionSet> regions_of_vertex_;            // empty: no object has regions
  std::vector<std::vector<RegionRoles>> region_roles_;  // empty: no object has regions
  std::vector<double> offset_;                          // m
  double largest_edge_range_ = 0, largest_offset_ = 0, bond_range_ = 0;  // m
};

}  // namespace tack
