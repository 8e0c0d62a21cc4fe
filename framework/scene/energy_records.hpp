// The energies of a state by term, for records.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tack {

struct World;
struct State;

// kinetic, then one entry per kind of elastic energy (all bodies together), gravity (m g . (x_rest -
// x)), barrier and adhesion, friction and tangential adhesion, as far as the scene names them [J]. Loads
// store no energy: not listed.
std::vector<std::pair<std::string, double>> energies_by_term(const World& world, const State& state);

// Kinetic energy and gravity (as above) [J].
std::pair<double, double> energies_of_free_vertices(const World& world, const State& state);

// Friction and tangential adhesion are not stored: theirs are the potentials of the last step alone, about
// what it dissipated.
inline bool is_stored(const std::string& term) {
  return term != "friction" && term != "tangential_adhesion";
}

}  // namespace tack
