#include "framework/world/containment.hpp"

#include "framework/contact/contact_system.hpp"
#include "geometry/broad_phase/overlap_pairs.hpp"
#include "geometry/exact/orientation.hpp"

namespace tack {
namespace {

// Query of overlap_pairs, with vertices as queries.
struct VertexInTet {
  const std::vector<int>& vertices;
  const std::vector<Tet>& tets;
  const VecX& x;

  bool accept(int v, int t) const { return tet_contains(tets[t], x, vertex(x, vertices[v])); }
  std::array<int, 2> pair(int v, int t) const { return {v, t}; }
};

Aabb box_of(const Body& body, const VecX& x) {
  Aabb box;
  for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) box.include(Vec3(vertex(x, v)));
  return box;
}

// Returns the surface vertices of other objects that may be inside of the solid.
std::vector<int> candidates(const World& world, int solid) {
  const CollisionMesh& mesh = world.contact->surface().mesh;
  const Aabb box = box_of(world.bodies[solid], world.start.x);
  std::vector<int> inside;
  for (const int v : mesh.vertices) {
    const int body = mesh.vertex_object[v];
    const bool relevant = body != solid && world.contact->colliding().allows(body, solid) &&
                          (world.bodies[body].movable || world.bodies[solid].movable);
    if (relevant && box.contains(vertex(world.start.x, v))) inside.push_back(v);
  }
  return inside;
}

Bvh tree_of(const std::vector<int>& vertices, const VecX& x) {
  std::vector<Aabb> boxes(vertices.size());
  for (size_t i = 0; i < boxes.size(); ++i) boxes[i].include(Vec3(vertex(x, vertices[i])));
  return Bvh(boxes);
}

Bvh tree_of(const std::vector<Tet>& tets, const VecX& x) {
  std::vector<Aabb> boxes(tets.size());
  for (size_t t = 0; t < boxes.size(); ++t)
    for (const int v : tets[t]) boxes[t].include(Vec3(vertex(x, v)));
  return Bvh(boxes);
}

}  // namespace

std::optional<Containment> find_containment(const World& world) {
  if (!world.contact) return std::nullopt;
  for (int solid = 0; solid < static_cast<int>(world.bodies.size()); ++solid) {
    const std::vector<Tet>& tets = world.bodies[solid].tets;
    if (tets.empty()) continue;
    const std::vector<int> vertices = candidates(world, solid);
    if (vertices.empty()) continue;
    std::vector<std::array<int, 2>> hits;
    overlap_pairs(tree_of(vertices, world.start.x), tree_of(tets, world.start.x), VertexInTet{vertices, tets, world.start.x}, hits);
    if (hits.empty()) continue;
    const int v = vertices[hits.front()[0]];
    return Containment{world.contact->surface().mesh.vertex_object[v], v, solid, hits.front()[1]};
  }
  return std::nullopt;
}

}  // namespace tack
