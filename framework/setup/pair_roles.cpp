// Roles of both surfaces of a pair in contact, on the objects and on their regions: laws, and the
// side that is integrated over.
#include <fmt/format.h>

#include <algorithm>

#include "framework/setup/pair_builder.hpp"
#include "geometry/errors.hpp"

namespace tack {

IntegrationSide PairBuilder::integration_side_of(int a, int b, int config) const {
  if (config < 0) return IntegrationSide::automatic;
  const std::string& side = contact_.pairs[config].integrate;
  if (side == "automatic") return IntegrationSide::automatic;
  if (side == "finer") return IntegrationSide::finer;
  // Both objects may be in the named group.
  if (side == "both" || (configs_.integrates(config, a) && configs_.integrates(config, b))) return IntegrationSide::both;
  return configs_.integrates(config, a) ? IntegrationSide::first : IntegrationSide::second;
}

// Returns one side for the two objects: that of the entry that names one.
IntegrationSide PairBuilder::integration_side_of(int a, int b, int config, const std::vector<int>& regions) const {
  IntegrationSide found = integration_side_of(a, b, config);
  for (const int entry : regions) {
    const IntegrationSide side = integration_side_of(a, b, entry);
    if (found == IntegrationSide::automatic) found = side;
    if (side == IntegrationSide::automatic || side == found) continue;
    throw configs_.error(entry, fmt::format("integrate: '{}' and '{}' have one integration side for all regions, and another of their pairs names another one; name the same in both, or "
                                            "in one of them alone", world_.bodies[a].name, world_.bodies[b].name));
  }
  return found;
}

void PairBuilder::set_roles(int a, int b, int config, const std::vector<int>& regions) {
  const auto adheres = [&](int entry) { return entry >= 0 && contact_.pairs[entry].adhesion; };
  const auto by_bonds = [&](int entry) { return adheres(entry) && contact_.pairs[entry].bonds(); };
  const auto by_gap = [&](int entry) { return adheres(entry) && !by_bonds(entry); };
  const LawIds of_objects = laws_of(a, b, config, -1);
  std::vector<LawIds> of_regions;
  for (const int entry : regions) of_regions.push_back(laws_of(a, b, entry, static_cast<int>(of_regions.size()) * (a == b ? 2 : 1)));
  PairSetup setup = setup_of(a, b);
  setup.side = integration_side_of(a, b, config, regions);
  // Region interfaces are overlap boundaries: regions are separated by their overlap areas.
  setup.adheres = adheres(config) || std::any_of(regions.begin(), regions.end(), adheres);
  setup.overlap_only = a != b && (adheres(config) || !regions.empty());
  setup.bonds = by_bonds(config) || std::any_of(regions.begin(), regions.end(), by_bonds);
  setup.gap_adhesion = by_gap(config) || std::any_of(regions.begin(), regions.end(), by_gap);
  for (const LawIds& ids : of_regions) setup.region_range = std::max(setup.region_range, table_.laws()[ids.laws.pressure].range());
  refuse_unsupported_primitives(setup);
  refuse_unsupported(setup, config, false);
  for (const int entry : regions) refuse_unsupported(setup, entry, true);
  if (of_objects.bond >= 0) refuse_bond(a, b, config);
  for (size_t i = 0; i < regions.size(); ++i)
    if (of_regions[i].bond >= 0) refuse_bond(a, b, regions[i]);
  if (of_objects.bond >= 0) bonds_.set(a, b, of_objects.bond);
  setup.laws = of_objects.laws;
  setup.all_laws = {of_objects.laws};
  for (const LawIds& ids : of_regions) setup.all_laws.push_back(ids.laws);
  const PairRoles roles = potential_.roles(setup, table_);
  table_.point(a, b) = roles.first;
  table_.point(b, a) = roles.second;
  table_.set_edge(a, b, roles.edge);
  table_.set_codimensional(a, b, roles.codimensional);
  setup.region = true;
  setup.region_range = std::max(setup.region_range, roles.codimensional.range);
  std::vector<int> rules_of_roles;
  for (size_t i = 0; i < regions.size(); ++i) {
    setup.laws = of_regions[i].laws;
    const PairRoles own = potential_.roles(setup, table_);
    const auto [first, second] = regions_.regions_of(regions[i], a, b);
    table_.add_region_roles(a, b, {first, second, own.first, own.edge, own.codimensional});
    table_.add_region_roles(b, a, {second, first, own.second, own.edge, own.codimensional});
    rules_of_roles.insert(rules_of_roles.end(), a == b ? 2 : 1, of_regions[i].bond);
  }
  if (setup.bonds && !regions.empty()) bonds_.set_regions(a, b, rules_of_roles);
}

}  // namespace tack
