// The pairs of primitives that may come within contact range: supersets, as indices into a
// CollisionMesh. Left out: pairs that share a vertex, pairs in which nothing is movable or that are
// rigid together, and pairs of objects that may not touch. Particles meet surfaces as point-triangle pairs, rods meet
// everything that has edges as edge-edge pairs.
#pragma once

#include <array>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// A length for each candidate, parallel to the lists of candidates [m].
struct Clearances {
  std::vector<double> point_triangle, edge_edge, point_edge, point_point;
};

// Some of the candidates, by their places in the lists; ascending.
struct SomeCandidates {
  std::vector<int> point_triangle, edge_edge, point_edge, point_point;
};

struct Candidates {
  // (global vertex, triangle), by vertex, then by the triangle's object, then by triangle.
  std::vector<std::array<int, 2>> point_triangle;
  // (edge, edge), first < second, sorted.
  std::vector<std::array<int, 2>> edge_edge;
  // (global vertex, edge) of any surface vertex and a codimensional edge, sorted.
  std::vector<std::array<int, 2>> point_edge;
  // (global vertex, global vertex) of two codimensional points, first < second, sorted.
  std::vector<std::array<int, 2>> point_point;
  // How far apart the two primitives of each stay at least while the candidates hold. Most candidates are neighbours
  // in one body, whose boxes overlap though they are far apart.
  Clearances clearances;
  // Lower bounds of their distances where vertices are at `reference` (3 coordinates for every global vertex [m]): those
  // elsewhere are smaller by no more than both have strayed (strays.hpp).
  Clearances distances;
  VecX reference;

  std::size_t size() const {
    return point_triangle.size() + edge_edge.size() + point_edge.size() + point_point.size();
  }
};

}  // namespace tack
