// One object of the scene for energies and loads: elements in global vertex indices.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/body/elements.hpp"
#include "framework/body/rod_section.hpp"
#include "geometry/mesh/digest.hpp"
#include "geometry/types.hpp"

namespace tack {

class Energy;
class Environment;
class RodFrames;

// Rest shape of a tet that its vertices at rest do not determine.
struct TetReference {
  Mat3 shape;     // inverse of the matrix of the stress-free edges [1/m]
  double volume;  // stress-free [m^3]
};

struct Body {
  std::string name;
  int first_vertex = 0;
  int vertex_count = 0;
  bool movable = true;  // some vertex is free at some time
  // Index of the energy that is being made, from 0; it distinguishes the histories of terms.
  int energy = 0;
  std::span<const std::unique_ptr<Energy>> energies;  // of the object, in the order of the scene
  const Environment* environment = nullptr;           // null: room temperature
  std::map<std::string, std::vector<int>> tags;       // groups of the mesh, vertex indices from 0
  std::vector<Tet> tets;
  // Rest shapes of the tets after remeshing with flow (flowed_mesh.hpp); else empty.
  std::vector<TetReference> references;
  bool flows = false;  // true if it may be remeshed: inner vertices have no lasting indices
  Elements elements = Elements::linear;  // composite: eight tets form one element
  // Surface triangles: those around tets, oriented outwards, then those of `sheet`.
  std::vector<Triangle> triangles;
  // Explicit triangles of the mesh that are no faces of its tets: shells.
  std::vector<Triangle> sheet;
  double thickness = 0;               // of the sheet [m]; 0: none
  std::vector<Edge> edges;            // rods: explicit edges of the mesh
  std::vector<int> points;            // particles: explicit points of the mesh
  std::optional<RodSection> section;  // of the edges
  double radius = 0;                  // of the points [m]; 0: none
  std::shared_ptr<RodFrames> rod;     // of edges with twists (rod/rod_frames.hpp); else null
  // The four frame vertices of an affine body (affine/frame.hpp).
  std::vector<int> frame;
  double volume = 0;     // of an affine body [m^3]
  double stiffness = 0;  // of an affine body [Pa]
  // Finer contact surface (refined_surface.hpp): its vertices outside of the mesh and its
  // triangles; else empty.
  std::vector<int> surface_vertices;
  std::vector<Triangle> surface_triangles;
  // Vertices outside of the mesh, ascending: frame, surface and twists.
  std::vector<int> extra_vertices;
  MeshDigest digest;               // of the mesh before it was placed
  bool from_file = false;          // the mesh was read from a file, or processed
  std::vector<std::string> notes;  // messages of mesh processing
};

}  // namespace tack
