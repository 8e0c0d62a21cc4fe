// Overlap of two objects as facets and boundary edges, for its derivative by vertex positions
// (overlap_boundary_forces.hpp).
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

// A part of a triangle that lies opposite a triangle of the other object, its seed triangle.
struct OverlapFacet {
  int triangle, seed_triangle;
  double area;      // projected towards the seed triangle [m^2]
  double distance;  // m
};

// A segment of the overlap boundary on a triangle: the projection of an edge of the other object,
// from corner `side` of `other` to the next.
struct OverlapBoundaryEdge {
  int triangle;
  Vec3 inside;  // midpoint of the segment: barycentric coordinates
  int other, side;
  // Projected length along the normal of `other` [m]; negative where the overlap lies on its far
  // side.
  double length;
};

// A triangle that overlaps as a whole, within range.
struct OverlapTriangle {
  int triangle;
  double area;  // projected onto the opposite surface [m^2]
};

// The overlap of points of object a with object b.
struct OverlapFacets {
  int a, b;
  std::vector<OverlapFacet> facets;
  std::vector<OverlapBoundaryEdge> boundary_edges;
  std::vector<OverlapTriangle> full_triangles;  // for pairs that bond
};

}  // namespace tack
