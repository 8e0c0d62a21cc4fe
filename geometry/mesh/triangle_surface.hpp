// Surface that the mesh operations work on: triangles only, including the boundary of tets.
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns the surface. Explicit triangles keep their indices in a mesh without tets; otherwise
// faces of tets come first (extract_surface). Unused vertices and groups are dropped. Throws
// InputError, beginning with `name`, for a mesh without triangles, with rods or particles, which
// the operations do not support, or with inverted tets.
Mesh triangle_surface(const Mesh& mesh, const std::string& name);

// Returns the volume that closed triangles enclose [m^3]; negative if they are inside out.
double enclosed_volume_of(const Mesh& surface);

// Returns the connected component of each triangle, by vertices, numbered by first triangle.
std::vector<int> components_by_vertices(const Mesh& surface);

// Throw InputError, beginning with `name`, instead of filling the memory. The first one: if more
// than ten million triangles are expected; the message ends with `remedy`. The second one: if
// equilateral triangles of that edge length [m] would be more than that.
void refuse_too_many_triangles(double expected, const std::string& name, const std::string& remedy);
void refuse_too_short_edges(const Mesh& surface, double edge_length, const std::string& name);

}  // namespace tack
