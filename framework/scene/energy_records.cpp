#include "framework/scene/energy_records.hpp"

#include <map>

#include "framework/bond/bond_term.hpp"
#include "framework/contact/friction_term.hpp"
#include "framework/contact/rim_term.hpp"
#include "framework/scene/world.hpp"

namespace tack {

std::pair<double, double> energies_of_free_vertices(const World& world, const State& state) {
  double kinetic = 0, gravity = 0;
  for (int v = 0; v < world.dofs.vertex_count(); ++v) {
    if (!world.dofs.moves(v)) continue;
    kinetic += 0.5 * world.mass(v) * vertex(state.v, v).squaredNorm();
    gravity += world.weighing_mass(v) * world.gravity.dot(vertex(world.rest, v) - vertex(state.x, v));
  }
  return {kinetic, gravity};
}

std::vector<std::pair<std::string, double>> energies_by_term(const World& world, const State& state) {
  const auto [kinetic, gravity] = energies_of_free_vertices(world, state);
  std::map<std::string, double> elastic;
  for (const auto& term : world.elastic_terms) elastic[term->name()] += term->value(state.x);

  std::vector<std::pair<std::string, double>> all = {{"kinetic", kinetic}};
  all.insert(all.end(), elastic.begin(), elastic.end());
  if (!world.gravity.isZero()) all.emplace_back("gravity", gravity);
  if (world.contact_term) {
    all.emplace_back("barrier", world.contact_term->part_value(state.x, LawPart::barrier));
    const double rim = world.rim ? world.rim->value(state.x) : 0;
    all.emplace_back("adhesion", world.contact_term->part_value(state.x, LawPart::adhesion) + rim);
  }
  if (world.bonds) all.emplace_back("bonds", world.bonds->value(state.x));
  if (world.friction) {
    all.emplace_back("friction", world.friction->part_value(state.x, TangentialPart::friction));
    all.emplace_back("tangential_adhesion", world.friction->part_value(state.x, TangentialPart::adhesion));
  }
  return all;
}

}  // namespace tack
