// Defects of a surface of triangles. All lists are sorted and contain indices of the mesh.
// Crossings are found by CGAL's exact predicates; touching counts. The search for crossings ends
// after `crossing_count_max`.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct OpenEdge {
  int triangle;  // its only triangle
  Edge edge;     // in the direction of the triangle
};

struct CrowdedEdge {
  Edge edge;                   // smaller vertex first
  std::vector<int> triangles;  // more than two
};

struct SurfaceDefects {
  // Triangles with a repeated vertex or exactly collinear corners.
  std::vector<int> degenerate;
  // Pairs of triangles with the same three vertices: earlier, later.
  std::vector<std::array<int, 2>> duplicates;
  // Pairs of vertices with exactly equal positions: earlier, later.
  std::vector<std::array<int, 2>> doubled_vertices;
  std::vector<OpenEdge> open_edges;        // edges of one triangle
  std::vector<CrowdedEdge> crowded_edges;  // non-manifold edges
  // Non-manifold vertices: surfaces touch in the vertex alone.
  std::vector<int> pinched_vertices;
  std::vector<std::array<int, 2>> flipped;  // neighbours with normals on different sides
  // Pairs of triangles that meet in more than their common vertices.
  std::vector<std::array<int, 2>> crossings;
  int component_count = 0;  // connected components, by vertices
  int holes = 0;            // cycles of open edges
  // Enclosed volume [m^3], if closed() and nothing is flipped; else 0.
  double volume = 0;

  bool closed() const { return open_edges.empty(); }
  bool manifold() const {
    return crowded_edges.empty() && pinched_vertices.empty() && duplicates.empty();
  }
  bool inside_out() const { return volume < 0; }
  // Returns true if the surface bounds a solid.
  bool bounds_volume() const;
};

inline constexpr int crossing_count_max = 1000;

// Finds the defects of a mesh of triangles (triangle_surface). crossings: whether to search for
// them.
SurfaceDefects find_defects(const Mesh& surface, bool crossings = true);

// Returns a line per kind of defect that occurs: their number, and the first ten indices.
std::vector<std::string> list_defects(const SurfaceDefects& defects);

// Throws InputError, beginning with `name`, that lists the defects of a surface that does not bound
// a solid.
void require_solid(const Mesh& surface, const std::string& name);

// Checks a surface for an operation that also takes open surfaces: borders and crossings are
// allowed.
void require_oriented_manifold(const Mesh& surface, const std::string& name);

}  // namespace tack
