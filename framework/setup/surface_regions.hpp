// Regions of surfaces named by entries of contact.pairs, as bit sets of vertices (PairTable). A
// vertex of a finer surface belongs to the regions that contain all corners it depends on.
// Errors: InputError with the entry's source location, for a region without a whole triangle (edge,
// point), for more regions than bits, and for two entries that are equally specific for the same
// positions.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/laws/pair_table.hpp"
#include "framework/scene/pair_configs.hpp"
#include "framework/world/world.hpp"

namespace tack {

class SurfaceRegions {
 public:
  SurfaceRegions(const SceneConfig& scene, const PairConfigs& configs, const World& world);

  bool any() const { return next_ > 0; }
  const std::vector<RegionSet>& vertex_regions() const { return vertex_regions_; }
  // Returns the regions of a and of b in which an entry applies; 0: anywhere.
  std::array<RegionSet, 2> regions_of(int entry, int a, int b) const;
  // Throws InputError if two of these entries of a and b are equally specific where they overlap.
  void require_distinct(const std::vector<int>& entries, int a, int b) const;

 private:
  RegionSet add(int entry, const PairSide& side);
  // Returns true if a triangle of the body (an edge or point, if it has none) is in all these
  // regions.
  bool has_element_in(const Body& body, RegionSet regions) const;

  const SceneConfig& scene_;
  const PairConfigs& configs_;
  const World& world_;
  int next_ = 0;                                 // first free bit
  std::vector<RegionSet> vertex_regions_;        // empty without regions
  std::vector<std::array<RegionSet, 2>> sides_;  // per entry
};

}  // namespace tack
