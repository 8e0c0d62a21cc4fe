#include "framework/setup/surface_regions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/errors.hpp"

namespace tack {

SurfaceRegions::SurfaceRegions(const SceneConfig& scene, const PairConfigs& configs, const World& world) : scene_(scene), configs_(configs), world_(world) {
  const std::vector<PairConfig>& pairs = scene.contact->pairs;
  sides_.resize(pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i)
    for (int side = 0; side < 2; ++side)
      if (pairs[i].between[side].select) sides_[i][side] = add(static_cast<int>(i), pairs[i].between[side]);
  if (!any()) return;
  for (const Dependence& d : world.constraints.lasting()) {
    RegionSet all = ~RegionSet(0);
    for (const auto& [v, weight] : d.on)
      if (weight != 0) all &= vertex_regions_[v];
    vertex_regions_[d.vertex] = all;
  }
  for (size_t i = 0; i < pairs.size(); ++i)
    for (int side = 0; side < 2; ++side)
      if (const PairSide& named = pairs[i].between[side]; named.select && !has_element_in(world.bodies[world.body_index(named.object)], sides_[i][side]))
        throw configs.error(static_cast<int>(i), fmt::format("the region {} of object '{}' contains no complete triangle (edge, point) of its surface; enlarge it", named.select->type(), named.object));
}

RegionSet SurfaceRegions::add(int entry, const PairSide& side) {
  if (next_ == PairTable::region_count_max) throw configs_.error(entry, fmt::format("pairs name more than {} regions of objects; let fewer entries name larger ones", PairTable::region_count_max));
  vertex_regions_.resize(static_cast<size_t>(world_.rest.size()) / 3, 0);
  const RegionSet bit = RegionSet(1) << next_++;
  try {
    for (const int v : select(*side.select, world_.selection_context(world_.body_index(side.object)))) vertex_regions_[v] |= bit;
  } catch (const InputError& error) {
    throw configs_.error(entry, error.what());
  }
  return bit;
}

bool SurfaceRegions::has_element_in(const Body& body, RegionSet regions) const {
  const auto any = [&](const auto& elements) {
    return std::any_of(elements.begin(), elements.end(), [&](const auto& element) {
      return std::all_of(element.begin(), element.end(), [&](int v) { return (vertex_regions_[v] & regions) == regions; });
    });
  };
  const std::vector<Triangle>& triangles = body.surface_triangles.empty() ? body.triangles : body.surface_triangles;
  if (!triangles.empty()) return any(triangles);
  if (!body.edges.empty()) return any(body.edges);
  return std::any_of(body.points.begin(), body.points.end(), [&](int v) { return (vertex_regions_[v] & regions) == regions; });
}

std::array<RegionSet, 2> SurfaceRegions::regions_of(int entry, int a, int b) const {
  const auto& [first, second] = sides_[entry];
  return configs_.swapped(entry, a, b) ? std::array{second, first} : std::array{first, second};
}

void SurfaceRegions::require_distinct(const std::vector<int>& entries, int a, int b) const {
  const Body &body_a = world_.bodies[a], &body_b = world_.bodies[b];
  for (size_t j = 1; j < entries.size(); ++j)
    for (size_t i = 0; i < j; ++i) {
      if (!configs_.equal(entries[i], entries[j])) continue;
      const auto one = regions_of(entries[i], a, b), other = regions_of(entries[j], a, b);
      const auto meet = [&](int first, int second) { return has_element_in(body_a, one[0] | other[first]) && has_element_in(body_b, one[1] | other[second]); };
      if (!meet(0, 1) && !(a == b && meet(1, 0))) continue;
      std::string where = configs_.location(entries[i]);
      if (!where.empty()) where = fmt::format(" ({})", where.substr(0, where.size() - 2));
      throw configs_.error(entries[j], fmt::format("regions of '{}' and '{}' that it names are also named by an equally specific entry{}; let the two not overlap, or make "
                                                   "one more specific", body_a.name, body_b.name, where));
    }
}

}  // namespace tack
