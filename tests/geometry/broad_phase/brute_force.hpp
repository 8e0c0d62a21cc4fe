// Candidates by testing all pairs, straight from their definition.
#pragma once

#include <algorithm>
#include <tuple>

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/broad_phase/inflation_radii.hpp"

namespace tack::scenes {

struct BruteForce {
  const CollisionMesh& mesh;
  const CollidingObjects& colliding;
  std::vector<Aabb> fat_boxes;  // by global vertex
  InflationRadii radii;

  BruteForce(const CollisionMesh& mesh_, const CollidingObjects& colliding_, const VecX& x,
             const VecX& p, double range, double skin)
      : BruteForce(mesh_, colliding_, x, p, InflationRadii::uniform(mesh_, range, range), skin) {}
  BruteForce(const CollisionMesh& mesh_, const CollidingObjects& colliding_, const VecX& x,
             const VecX& p, InflationRadii radii_, double skin)
      : mesh(mesh_), colliding(colliding_), fat_boxes(x.size() / 3), radii(std::move(radii_)) {
    for (const int v : mesh.vertices) {
      fat_boxes[v].include(Vec3(vertex(x, v)));
      if (p.size() != 0) fat_boxes[v].include(Vec3(vertex(x, v) + vertex(p, v)));
      fat_boxes[v].inflate(0.5 * skin);
    }
  }

  bool wanted(const std::vector<int>& a, const std::vector<int>& b,
              const std::vector<double>& radius) const {
    bool movable = false;
    Aabb box_a, box_b;
    for (const int v : a) {
      box_a.include(fat_boxes[v]);
      movable |= mesh.vertex_movable[v] != 0;
    }
    for (const int v : b) {
      box_b.include(fat_boxes[v]);
      movable |= mesh.vertex_movable[v] != 0;
      if (std::find(a.begin(), a.end(), v) != a.end()) return false;
    }
    box_a.inflate(radius[mesh.vertex_object[a[0]]]);
    box_b.inflate(radius[mesh.vertex_object[b[0]]]);
    return movable && colliding.allows(mesh.vertex_object[a[0]], mesh.vertex_object[b[0]]) &&
           box_a.overlaps(box_b);
  }
  std::vector<int> edge(int e) const { return {mesh.edges[e][0], mesh.edges[e][1]}; }
  std::vector<int> triangle(int t) const {
    return {mesh.triangles[t].begin(), mesh.triangles[t].end()};
  }

  Candidates find() const {
    Candidates found;
    const int edges = static_cast<int>(mesh.edges.size());
    for (const int v : mesh.vertices) {
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
        if (wanted({v}, triangle(t), radii.surface)) found.point_triangle.push_back({v, t});
      for (const int e : mesh.codim_edges)
        if (wanted({v}, edge(e), radii.surface)) found.point_edge.push_back({v, e});
    }
    for (int e = 0; e < edges; ++e)
      for (int f = e + 1; f < edges; ++f)
        if (wanted(edge(e), edge(f), radii.edge)) found.edge_edge.push_back({e, f});
    for (const int v : mesh.codim_points)
      for (const int w : mesh.codim_points)
        if (v < w && wanted({v}, {w}, radii.surface)) found.point_point.push_back({v, w});
    std::sort(found.point_triangle.begin(), found.point_triangle.end(), [&](auto a, auto b) {
      const auto key = [&](const auto& pair) {
        return std::tuple(pair[0], mesh.vertex_object[mesh.triangles[pair[1]][0]], pair[1]);
      };
      return key(a) < key(b);
    });
    return found;
  }
};

}  // namespace tack::scenes
