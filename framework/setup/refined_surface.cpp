#include "framework/setup/refined_surface.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"
#include "geometry/mesh/refine_surface.hpp"

namespace tack {
namespace {

std::vector<Vec3> mesh_vertices(const Body& body, const VecX& rest) {
  std::vector<Vec3> vertices;
  for (int v = 0; v < body.vertex_count; ++v) vertices.push_back(vertex(rest, body.first_vertex + v));
  return vertices;
}

}  // namespace

void add_refined_surface(const ObjectConfig& object, int index, World& world) {
  Body& body = world.bodies[index];
  if (body.triangles.empty())
    throw InputError(fmt::format("object '{}' has no triangles to divide; take `surface` away", object.name));
  if (!body.tets.empty() && !body.sheet.empty())
    throw InputError(fmt::format("object '{}' has tets and triangles beside them, and `surface` would not know which sides of them are "
                                 "outside; make the triangles an object of their own, or take `surface` away", object.name));
  std::vector<Triangle> triangles = body.triangles;
  for (Triangle& t : triangles)
    for (int& v : t) v -= body.first_vertex;
  const std::vector<Vec3> vertices = mesh_vertices(body, world.rest);
  RefinedSurface surface;
  try {
    surface = refine_surface(vertices, std::move(triangles), object.surface->edge_length);
  } catch (const InputError& error) {
    throw InputError(fmt::format("object '{}' (surface.edge_length): {}", object.name, error.what()));
  }
  std::vector<Vec3> places;
  for (auto& on : surface.added) {
    Vec3& x = places.emplace_back(Vec3::Zero());
    for (auto& [v, weight] : on) {
      x += weight * vertices[v];
      v += body.first_vertex;
    }
  }
  body.surface_vertices = Unknowns(world, body.name, index).add_vector_dofs("surface", places);
  for (size_t i = 0; i < places.size(); ++i)
    world.constraints.add_lasting({body.surface_vertices[i], std::move(surface.added[i])});
  body.surface_triangles = std::move(surface.triangles);
  for (Triangle& t : body.surface_triangles)
    for (int& v : t) v = v < body.vertex_count ? body.first_vertex + v : body.surface_vertices[v - body.vertex_count];
}

Mesh surface_mesh(const Body& body, const VecX& rest) {
  Mesh mesh;
  mesh.vertices = mesh_vertices(body, rest);
  for (const int v : body.surface_vertices) mesh.vertices.push_back(vertex(rest, v));
  mesh.triangles = body.surface_triangles;
  for (const auto& [a, b] : body.edges) mesh.edges.push_back({a - body.first_vertex, b - body.first_vertex});
  for (const int v : body.points) mesh.points.push_back(v - body.first_vertex);
  const int last = body.first_vertex + body.vertex_count;
  for (Triangle& t : mesh.triangles)
    for (int& v : t) v = v < last ? v - body.first_vertex : body.vertex_count + v - body.surface_vertices.front();
  return mesh;
}

}  // namespace tack
