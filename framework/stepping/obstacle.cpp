#include "framework/stepping/obstacle.hpp"

#include <fmt/format.h>

#include <limits>

#include "framework/contact/contact_system.hpp"

namespace tack {
namespace {

// The object nearest to object a; -1 if nothing is within the reach of contact.
int nearest_object(const ContactSystem& contact, const VecX& x, int a) {
  const CollisionMesh& mesh = contact.surface().mesh;
  int nearest = -1;
  double smallest = std::numeric_limits<double>::infinity();
  for (int b = 0; b < contact.pairs().objects(); ++b) {
    const double d = smallest_distance(mesh, candidates_between(mesh, contact.candidates(), a, b), x);
    if (d < smallest) smallest = d, nearest = b;
  }
  return nearest;
}

}  // namespace

std::string describe_obstacle(const World& world, const VecX& x, int v, double distance) {
  int a = 0;
  while (v >= world.bodies[a].first_vertex + world.bodies[a].vertex_count) ++a;
  const std::string& name = world.bodies[a].name;
  const std::string rest = fmt::format("vertex {} of '{}' is still {:.3g} m short of its place",
                                       v - world.bodies[a].first_vertex, name, distance);
  const int b = world.contact ? nearest_object(*world.contact, x, a) : -1;
  if (b < 0) return fmt::format("the script deforms '{}' too far: {}", name, rest);
  return fmt::format("the script drives '{}' into {}: {}", name,
                     a == b ? "itself" : "'" + world.bodies[b].name + "'", rest);
}

}  // namespace tack
