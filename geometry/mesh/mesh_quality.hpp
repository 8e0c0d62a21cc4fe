// Quality of the elements of a mesh, and report lines on it.
#pragma once

#include <array>

#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

// Angles in degrees: between the faces of tets (0 to 180), or in the corners of triangles.
struct AngleHistogram {
  static constexpr int bins = 18;  // of 10 degrees each
  std::array<long, bins> count{};
  double smallest = 180, largest = 0;
  int worst = -1;                // element with the smallest angle
  Vec3 centroid = Vec3::Zero();  // of that element [m]
};

struct EdgeLengths {
  double shortest = 0, mean = 0, longest = 0;  // [m], over every edge once
};

AngleHistogram dihedral_angles(const Mesh& mesh);  // of the tets
AngleHistogram triangle_angles(const Mesh& mesh);  // of the explicit triangles
EdgeLengths edge_lengths(const Mesh& mesh);        // of tets and triangles

// Largest ratio of circumradius to shortest edge of the tets (0.612 for a regular tet), and its
// tet.
struct RadiusEdge {
  double largest = 0;
  int worst = -1;
};
RadiusEdge radius_edge(const Mesh& mesh);

// Returns lines on counts, edges, volume, the histogram of angles, and the index and centroid of
// the worst element.
Notes quality_notes(const Mesh& mesh);

}  // namespace tack
