// Primitives of one kind (points, edges or triangles): N global vertex ids each, with the objects,
// rigid groups and flags that searches need, and the tree over their boxes.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "geometry/broad_phase/bvh.hpp"
#include "geometry/mesh/collision_mesh.hpp"
#include "geometry/parallel.hpp"

namespace tack {

template <std::size_t N>
struct Primitives {
  static constexpr int primitives_per_chunk = 1024;

  std::vector<std::array<int, N>> vertices;  // global ids
  std::vector<int> ids;                      // the index in the mesh, e.g. of the edge
  std::vector<int> objects;                  // the object of all its vertices
  std::vector<char> movable;                 // whether some vertex is movable
  std::vector<int> groups;                   // the rigid group of all its vertices, or -1
  Bvh tree;

  void add(const std::array<int, N>& corners, int id, const CollisionMesh& mesh) {
    vertices.push_back(corners);
    ids.push_back(id);
    objects.push_back(mesh.vertex_object[corners[0]]);
    movable.push_back(0);
    for (const int v : corners) movable.back() |= mesh.vertex_movable[v] != 0;
    groups.push_back(mesh.vertex_group.empty() ? -1 : mesh.vertex_group[corners[0]]);
    for (const int v : corners)
      if (groups.back() >= 0 && mesh.vertex_group[v] != groups.back()) groups.back() = -1;
  }

  // Sets the boxes of the tree to the unions of the vertices' boxes (per global id), inflated by
  // the radius of their object [m] (empty: by 0). Active are movable primitives; if `of` (a flag
  // per object) is not empty, those of the flagged objects alone.
  void refresh_tree(const std::vector<Aabb>& vertex_boxes, const std::vector<double>& inflation,
                    const std::vector<char>& of = {}) {
    std::vector<Aabb> boxes(vertices.size());
    for_each(
        static_cast<int>(boxes.size()),
        [&](int i) {
          for (const int v : vertices[i]) boxes[i].include(vertex_boxes[v]);
          if (!inflation.empty()) boxes[i].inflate(inflation[objects[i]]);
        },
        primitives_per_chunk);
    std::vector<char> active = movable;
    if (!of.empty())
      for_each(
          static_cast<int>(active.size()), [&](int i) { active[i] &= of[objects[i]]; },
          primitives_per_chunk);
    if (tree.size() == static_cast<int>(boxes.size())) {
      tree.set_active(std::move(active));
      tree.update(boxes);
    } else {
      tree = Bvh(boxes, active, groups);
    }
  }
};

template <std::size_t M, std::size_t N>
bool share_vertex(const std::array<int, M>& a, const std::array<int, N>& b) {
  bool shared = false;
  for (const int v : a)
    for (const int w : b) shared |= v == w;
  return shared;
}

}  // namespace tack
