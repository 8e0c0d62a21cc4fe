#include "framework/world/energy_records.hpp"

#include <algorithm>

#include "framework/core/term_values.hpp"
#include "framework/world/world.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

double kinetic_energy(const World& world, const State& state) {
  double sum = 0;
  for (int v = 0; v < world.dofs.vertex_count(); ++v)
    if (world.dofs.moves(v)) sum += 0.5 * world.mass(v) * vertex(state.v, v).squaredNorm();
  return sum;
}

// Returns the value of each record [J]. Records of small terms are evaluated side by side.
std::vector<double> record_values(const std::vector<EnergyRecord>& records, const VecX& x) {
  std::vector<double> values(records.size());
  std::vector<int> small;
  for (size_t i = 0; i < records.size(); ++i) {
    if (records[i].term && is_small(*records[i].term)) small.push_back(static_cast<int>(i));
    else values[i] = records[i].value(x);
  }
  for_each(static_cast<int>(small.size()), [&](int k) { values[small[k]] = records[small[k]].value(x); }, small_terms_per_chunk);
  return values;
}

// Sorts energies: those of objects by name, then gravity, then the others in their order.
void sort(std::vector<NamedEnergy>& energies) {
  const auto rank = [](const NamedEnergy& e) { return e.kind == EnergyKind::of_objects ? 0 : e.kind == EnergyKind::weight ? 1 : 2; };
  std::stable_sort(energies.begin(), energies.end(), [&](const NamedEnergy& a, const NamedEnergy& b) {
    return rank(a) != rank(b) ? rank(a) < rank(b) : rank(a) == 0 && a.name < b.name;
  });
}

}  // namespace

double weight_of_free_vertices(const World& world, const VecX& x) {
  double sum = 0;
  for (int v = 0; v < world.dofs.vertex_count(); ++v)
    if (world.dofs.moves(v)) sum += world.gravitational_mass(v) * world.gravity.dot(vertex(world.rest, v) - vertex(x, v));
  return sum;
}

std::pair<double, double> energies_of_free_vertices(const World& world, const State& state) {
  return {kinetic_energy(world, state), weight_of_free_vertices(world, state.x)};
}

std::vector<NamedEnergy> energies_by_term(const World& world, const State& state) {
  const std::vector<EnergyRecord>& records = world.records.energies();
  const std::vector<double> values = record_values(records, state.x);
  std::vector<NamedEnergy> all;
  for (size_t i = 0; i < records.size(); ++i) {
    const auto same = std::find_if(all.begin(), all.end(), [&](const NamedEnergy& e) { return e.name == records[i].name; });
    if (same == all.end()) all.push_back({records[i].name, values[i], records[i].kind});
    else same->value += values[i];
  }
  sort(all);
  all.insert(all.begin(), {"kinetic", kinetic_energy(world, state), EnergyKind::motion});
  return all;
}

double stored_energy(const std::vector<NamedEnergy>& energies) {
  double sum = 0;
  for (const NamedEnergy& e : energies)
    if (is_stored(e.kind)) sum += e.value;
  return sum;
}

}  // namespace tack
