// The surface that the tools of this folder work on: triangles alone, the boundary of tets among
// them.
#pragma once

#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Explicit triangles keep their numbers in a mesh without tets; faces of tets come first otherwise
// (extract_surface). Vertices that no triangle uses are dropped, and so are groups. Throws
// InputError, beginning with `name`, if there are no triangles, or rods or particles, which no tool
// here can handle, or inverted tets.
Mesh triangle_surface(const Mesh& mesh, const std::string& name);

// Of what closed triangles enclose [m^3]; negative if they are inside out.
double enclosed_volume_of(const Mesh& surface);

// Returns the connected component of each triangle, by vertices, numbered by first triangle.
std::vector<int> parts_of(const Mesh& surface);

// Throws InputError, beginning with `name`, rather than filling memory: if more than ten million
// triangles are to be expected, the remedy being the one given, or if the surface has room for more
// than that with edges of that length [m].
void refuse_too_many_triangles(double expected, const std::string& name, const std::string& remedy);
void refuse_too_short_edges(const Mesh& surface, double edge_length, const std::string& name);

}  // namespace tack
