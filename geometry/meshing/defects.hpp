// Defects of a surface of triangles, by name and number. All lists are sorted; numbers are those of
// the mesh. Crossings are found by CGAL's exact predicates; closed sets, touching counts. No more
// crossings are listed than the first `most_crossings` are looked for.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct OpenEdge {
  int triangle;  // the only one that has it
  Edge edge;     // in its direction
};

struct CrowdedEdge {
  Edge edge;                   // smaller vertex first
  std::vector<int> triangles;  // more than two
};

struct SurfaceDefects {
  // triangles: a vertex twice, or corners on one line (exactly).
  std::vector<int> degenerate;
  // Triangles of the same three vertices as an earlier one: earlier, later.
  std::vector<std::array<int, 2>> duplicates;
  // Vertices where an earlier one is (exactly): earlier, later.
  std::vector<std::array<int, 2>> doubled_vertices;
  std::vector<OpenEdge> open_edges;                   // of one triangle only
  std::vector<CrowdedEdge> crowded_edges;             // not manifold
  // Where surfaces touch in this vertex alone: not manifold either.
  std::vector<int> pinched_vertices;
  std::vector<std::array<int, 2>> flipped;            // neighbours with normals on different sides
  // Triangles that meet in more than what they share.
  std::vector<std::array<int, 2>> crossings;
  int parts = 0;                                      // that share no vertex
  int holes = 0;                                      // cycles of open edges
  // Enclosed [m^3], if closed() and nothing is flipped; else 0.
  double volume = 0;

  bool closed() const { return open_edges.empty(); }
  bool manifold() const {
    return crowded_edges.empty() && pinched_vertices.empty() && duplicates.empty();
  }
  bool inside_out() const { return volume < 0; }
  // Fit for all tools that ask for the inside of something.
  bool bounds_volume() const;
};

inline constexpr int most_crossings = 1000;

// The mesh has triangles only (triangle_surface). Without `crossings`, those are not looked for.
SurfaceDefects find_defects(const Mesh& surface, bool crossings = true);

// A line for each kind of defect there is: how many, and the first ten by number. Empty: none.
std::vector<std::string> list_defects(const SurfaceDefects& defects);

// Throws InputError, beginning with `name`, that lists the defects of a surface that does not bound
// a solid.
void require_solid(const Mesh& surface, const std::string& name);

// Checks a surface for an operation that also takes open surfaces: borders and crossings are
// allowed.
void require_oriented_manifold(const Mesh& surface, const std::string& name);

}  // namespace tack
