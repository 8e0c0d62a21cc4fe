// Regions of surfaces named by entries of contact.pairs, as bit sets of vertices (PairTable). A
// vertex of a finer surface belongs to the regions that contain all corners it depends on.
// Errors: InputError with the entry's source location, for a region without a whole triangle (edge,
// point), for more regions than bits, and for two entries that are equally specific for the same
// positions.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/pair_table.hpp"
#include "framework/scene/pair_configs.hpp"
#include "framework/world/world.hpp"

namespace tack {

class SurfaceParts {
 public:
  SurfaceParts(const SceneConfig& scene, const PairConfigs& configs, const World& world);

  bool any() const { return next_ > 0; }
  const std::vector<RegionSet>& of_vertices() const { return of_vertices_; }
  // Returns the regions of a and of b in which an entry holds; 0: anywhere.
  std::array<RegionSet, 2> wanted(int entry, int a, int b) const;
  // Throws InputError if two of these entries of a and b are equally specific where they overlap.
  void tell_apart(const std::vector<int>& entries, int a, int b) const;

 private:
  RegionSet add(int entry, const PairSide& side);
  // Returns true if a triangle of the body (an edge or point, if it has none) is in all these
  // regions.
  bool holds(const Body& body, RegionSet parts) const;

  const SceneConfig& scene_;
  const PairConfigs& configs_;
  const World& world_;
  int next_ = 0;                              // first free bit
  std::vector<RegionSet> of_vertices_;          // empty without regions
  std::vector<std::array<RegionSet, 2>> sides_;  // per entry
};

}  // namespace tack
