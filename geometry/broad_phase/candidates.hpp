// Collision candidates: pairs of primitives that may come within contact range, as indices into a
// CollisionMesh. Left out: pairs that share a vertex, pairs without a movable vertex, pairs within
// one rigid group, and pairs of objects that may not touch. Particles and surfaces form
// point-triangle pairs; rods form edge-edge pairs with all edges.
#pragma once

#include <array>
#include <vector>

#include "geometry/broad_phase/point_groups.hpp"
#include "geometry/types.hpp"

namespace tack {

// A length for each candidate, parallel to the lists of candidates [m].
struct CandidateLengths {
  std::vector<double> point_triangle, edge_edge, point_edge, point_point;
};

// Indices into the lists of candidates; ascending.
struct CandidateIndices {
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
  // Lower bounds of the distances while vertices stay in the broad phase's boxes. Most candidates
  // are neighbours in one body, whose boxes overlap although their distance is large.
  CandidateLengths distance_bounds;
  // Lower bounds of the distances at the reference positions. At other positions the distance is
  // smaller by no more than the displacement bounds of both primitives (displacement_bounds.hpp).
  CandidateLengths reference_distances;
  // Reference positions: 3 coordinates per global vertex [m].
  VecX reference;
  // Groups by vertex and object, of the broad phase.
  PointGroups groups;

  std::size_t size() const {
    return point_triangle.size() + edge_edge.size() + point_edge.size() + point_point.size();
  }
};

}  // namespace tack
