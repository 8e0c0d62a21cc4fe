// One model for solids (tets), shells (triangles), rods (edges) and particles (points) over one
// list of vertices. A mesh may mix them; rods and particles need a size for contact
// (framework/setup/contact_support.hpp). Coordinates in metres, angles in radians.
// A tet (a, b, c, d) is positive when (b-a) x (c-a) . (d-a) > 0; a triangle's normal is
// (b-a) x (c-a).
// Errors: InputError for a transform that would spoil the mesh (zero axis, zero or non-finite
// factor).
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct Mesh {
  std::vector<Vec3> vertices;
  // Elements given explicitly; faces of tets and edges of triangles are not listed (surface.hpp).
  std::vector<Tet> tets;
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<int> points;
  // Named groups of vertices (physical groups of .msh, groups of .obj), each sorted and unique.
  std::map<std::string, std::vector<int>> tags;
};

void translate(Mesh& mesh, const Vec3& offset);

// Rotates about an axis through the origin, right-handed; the axis needs no normalisation.
void rotate(Mesh& mesh, const Vec3& axis, double angle);

// Scales about the origin. An odd number of negative factors mirrors the mesh; tets and triangles
// are then reordered, so that volumes stay positive and normals stay on the same side.
void scale(Mesh& mesh, const Vec3& factors);

// Appends a copy of `other` to `mesh`; groups of the same name are united.
void append(Mesh& mesh, const Mesh& other);

// Returns the smallest axis-aligned box around the vertices; isEmpty() without vertices.
Eigen::AlignedBox3d bounding_box(const Mesh& mesh);

}  // namespace tack
