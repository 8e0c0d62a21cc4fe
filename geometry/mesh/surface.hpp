// Surface of a mesh: the primitives that can touch something.
//   triangles  boundary faces of the tets (faces of exactly one tet, oriented outward), in their
//              tets' order, then from first_sheet on the explicit triangles that are not faces of a
//              tet, in theirs: sheets, which have two sides
//   edges      unique edges of those triangles and explicit edges, as (smaller, larger), sorted
//   vertices   every vertex of the above and of the particles, ascending
//   codim_edges  indices into `edges` of edges of no triangle: rods
//   codim_points vertices of no tet, triangle or edge: particles
// Vertices are indices into the mesh. Tets must be positive (validate.hpp).
// Errors: InputError if more than two tets share a face.
#pragma once

#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct Surface {
  std::vector<int> vertices;
  std::vector<Edge> edges;
  std::vector<Triangle> triangles;
  int first_sheet = 0;
  std::vector<int> codim_edges;
  std::vector<int> codim_points;
};

Surface extract_surface(const Mesh& mesh);

// Returns, per vertex of the mesh, a third of the area of its surface triangles [m^2]; zero inside
// and on rods and particles. The sum is the area of the surface.
std::vector<double> vertex_areas(const Mesh& mesh, const Surface& surface);

// Returns, per surface edge, a third of the area of its triangles [m^2]; zero for rods. The sum is
// the area of the surface.
std::vector<double> edge_areas(const Mesh& mesh, const Surface& surface);

}  // namespace tack
