// The shapes of a run, object by object, as programs for graphics take them: read from the frames
// of a results folder.
//
// Vertices of an object: those of its outer faces, sheets, edges and points, in the order of its
// mesh, so that an object from an .obj file has the vertices of that file in their order. Inner
// vertices of tetrahedra are left out. Remeshed objects keep their outer vertices.
// Positions are in metres in the axes of the scene.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/export/run_frames.hpp"
#include "geometry/types.hpp"

namespace tack {

// Selection of objects and times of an export.
struct ShapeSelection {
  std::vector<std::string> objects;  // names; empty: all
  std::optional<double> from, to;    // s; unset: from the first frame, to the last
  std::optional<double> fps;         // samples per second; unset: each frame once
};

struct ExportedMaterial {
  std::string name;
  Vec3 colour;  // linear, 0 to 1, as Kd of .mtl files that Blender writes
};

struct ExportedObject {
  std::string name;       // of the scene
  std::string file_name;  // with special characters replaced, and unlike those of other objects
  int vertices = 0;
  // Faces: as in the object's .obj, .ply or .off file, else triangles.
  std::vector<int> face_sizes, corners;
  std::vector<Vec2> uvs;
  std::vector<int> corner_uvs;     // per corner: index into uvs; empty: no texture coordinates
  std::vector<int> face_material;  // per face: index into materials
  std::vector<ExportedMaterial> materials;  // at least one
  std::vector<Edge> edges;                  // rods
  std::vector<int> points;                  // particles
  double radius = 0;                        // of edges and points [m]; 0: none
  std::string file_unit;  // unit of the file that it was read from; "": metres, or no file

  bool has_faces() const { return !face_sizes.empty(); }
};

// Positions of the vertices of each object [m].
using ObjectPositions = std::vector<std::vector<Vec3>>;

// Returns x of some vertices, in their order.
inline std::vector<Vec3> picked(const std::vector<Vec3>& x, const std::vector<int>& vertices) {
  std::vector<Vec3> some;
  some.reserve(vertices.size());
  for (const int v : vertices) some.push_back(x[v]);
  return some;
}

class RunShapes {
 public:
  // check: called with the names of the scene's objects before frames are read. Throws InputError
  // if the folder has no frames or its scene cannot be read, and the exceptions of `check`.
  // results: the folder of a run, or its run.pvd.
  RunShapes(const std::filesystem::path& results, const ShapeSelection& selection,
            const std::function<void(const std::vector<std::string>&)>& check);

  const std::filesystem::path& folder() const { return frames_.folder(); }  // of the results
  const std::vector<std::filesystem::path>& sources() const {
    return sources_;
  }                                                  // files that the scene reads
  const std::string& name() const { return name_; }  // of the scene, fit for a file name
  const std::vector<ExportedObject>& objects() const { return objects_; }
  const std::vector<double>& times() const { return times_; }  // of the samples [s]
  Vec3 up() const { return up_; }                              // against gravity; y without gravity
  const std::vector<std::string>& notes() const { return notes_; }
  // Samples per second: fps of the selection, else the mean of the frames; 24 for a single one.
  double rate() const;

  // Calls visit(i, positions) for each sample i, in order. Samples between frames are interpolated
  // linearly. Throws InputError for a frame that is unreadable or has other shapes than the first.
  void visit(const std::function<void(int, const ObjectPositions&)>& visit) const;

 private:
  struct Loaded;
  struct KnownMesh;
  void choose_times(const ShapeSelection& selection);
  Loaded load(int frame, KnownMesh& known) const;

  RunFrames frames_;
  std::vector<std::filesystem::path> sources_;
  std::string name_;
  std::vector<ExportedObject> objects_;
  std::vector<int> numbers_;  // of the objects in the scene
  std::vector<double> times_;
  std::optional<double> fps_;
  Vec3 up_ = Vec3::UnitY();
  std::vector<std::string> notes_;
};

}  // namespace tack
