#include "framework/stepping/obstacle.hpp"

#include <fmt/format.h>

namespace tack {
namespace {

// The object nearest to object a; -1 if nothing is within the reach of contact.
int nearest_object(const ContactSystem& contact, const VecX& x, int a) {
  const CollisionMesh& mesh = contact.surface().mesh;
  const Candidates& all = contact.candidates();
  int nearest = -1;
  double smallest = std::numeric_limits<double>::infinity();
  for (int b = 0; b < contact.pairs().objects(); ++b) {
    const auto wanted = [&](int p, int q) {
      const int i = mesh.vertex_object[p], j = mesh.vertex_object[q];
      return (i == a && j == b) || (i == b && j == a);
    };
    Candidates between;
    for (const auto& c : all.point_triangle)
      if (wanted(c[0], mesh.triangles[c[1]][0])) between.point_triangle.push_back(c);
    for (const auto& c : all.edge_edge)
      if (wanted(mesh.edges[c[0]][0], mesh.edges[c[1]][0])) between.edge_edge.push_back(c);
    for (const auto& c : all.point_edge)
      if (wanted(c[0], mesh.edges[c[1]][0])) between.point_edge.push_back(c);
    for (const auto& c : all.point_point)
      if (wanted(c[0], c[1])) between.point_point.push_back(c);
    const double d = smallest_distance(mesh, between, x);
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
