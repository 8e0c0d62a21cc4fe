// Groups of candidates by vertex and object, made once per list of candidates: all primitives of
// one object that may be near one vertex.
#pragma once

#include <array>
#include <vector>

#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

struct Candidates;

// A vertex, an object, and the runs of candidates between the two.
struct PointGroup {
  int point = 0, object = 0;
  int triangle_begin = 0, triangle_end = 0;  // into Candidates::point_triangle
  int edge_begin = 0, edge_end = 0;          // into Candidates::point_edge
  int other_begin = 0, other_end = 0;        // into PointGroups::particles
  int before = -1;         // index of the group in the list before; -1: it was in none
  int triangle_shift = 0;  // triangle_begin less that in the list before

  std::array<int, 2> key() const { return {point, object}; }
  bool has_triangles() const { return triangle_end > triangle_begin; }
};

struct PointGroups {
  std::vector<PointGroup> all;                // by point, then object
  std::vector<std::array<int, 2>> particles;  // particle candidates in both directions, sorted

  // Groups the candidates. The groups so far are those of the list before.
  void make(const Candidates& candidates, const CollisionMesh& mesh);
};

}  // namespace tack
