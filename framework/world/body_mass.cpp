#include "framework/world/body_mass.hpp"

namespace tack {

double body_mass(const World& world, int body) {
  double mass = 0;
  for (const int v : world.vertices_of(body)) mass += world.gravitational_mass(v);
  return mass;
}

std::vector<double> body_masses(const World& world) {
  std::vector<double> masses;
  for (size_t i = 0; i < world.bodies.size(); ++i) masses.push_back(body_mass(world, static_cast<int>(i)));
  return masses;
}

}  // namespace tack
