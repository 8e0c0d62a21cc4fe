// A run with every kind of object, for tests of exports: a mirrored sheet of quads with texture
// coordinates and materials from an .obj file, a solid ball, a rod and particles above a floor.
#pragma once

#include <fmt/format.h>

#include <set>

#include "framework/output/outer_vertices.hpp"
#include "tests/support/program.hpp"

namespace tack {

inline const std::string quads_obj = R"(mtllib quads.mtl
o quads
v 0 0 0
v 1 0 0
v 2 0 0
v 0 0 1
v 1 0 1
v 2 0 1
vt 0 0
vt 0.5 0
vt 1 0
vt 0 1
vt 0.5 1
vt 1 1
usemtl red
f 1/1 4/4 5/5 2/2
usemtl plain
f 2/2 5/5 6/6 3/3
)";

inline const std::string exported_scene = R"(name: mixed
time: {step: 10 ms, duration: 0.1 s}
gravity: [0, -9.81, 0]
objects:
  - name: floor
    shape: {type: box, size: [4, 0.1, 4], surface: true}
    place: {translate: [1, -0.5, 0.5]}
    motion: [fixed]
  - name: sheet
    shape: {type: file, path: quads.obj}
    place: {scale: [0.5, 1, -0.5], translate: [0, 0.1, 0]}
    shell: {thickness: 1 mm}
    energies: [{type: neo_hookean_membrane, young: 0.1 MPa, poisson: 0.4, density: 1000}]
  - name: a ball
    shape: {type: sphere, radius: 0.2, cells: 4}
    place: {translate: [-0.5, 0.3, 0]}
    spin: [0, 0, 5]
    energies: [{type: neo_hookean, young: 0.1 MPa, poisson: 0.4, density: 1000}]
  - name: rod
    shape: {type: helix, radius: 0.1, pitch: 0.1, turns: 2, edges: 64}
    place: {translate: [-0.5, 1, 1]}
    rod: {radius: 5 mm}
    energies: [{type: elastic_rod, young: 1 MPa, density: 1000}]
  - name: grains
    shape: {type: points, size: [0.5, 0.2, 0.5], counts: [3, 2, 3]}
    place: {translate: [1, 0.9, 0]}
    particle: {radius: 2 cm}
    energies: [{type: particle, density: 1000}]
contact: {distance: 1 mm}
)";

class ExportedRun {
 public:
  // settings: overrides of the scene, "a.b=c".
  explicit ExportedRun(const Arguments& settings = {}) {
    write_file(path() / "quads.obj", quads_obj);
    write_file(path() / "quads.mtl", "newmtl red\nKd 0.8 0.1 0.05\n");
    write_file(path() / "scene.yaml", exported_scene);
    Arguments arguments = {"run", "scene.yaml", "-q", "-o", "run"};
    for (const std::string& setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    result = run_tack(path(), arguments);
  }
  std::filesystem::path path() const { return folder_.path(); }
  ProgramResult to(const std::string& format, Arguments more = {}) const {
    Arguments arguments = {"export", "run", "--to", format};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tack(path(), arguments);
  }
  // Positions of an object (by its index in the scene) in a frame [m].
  std::vector<Vec3> positions(int object, int frame) const {
    const FrameFile file =
        read_frame(path() / "run" / "frames" / fmt::format("frame_{:06}.vtu", frame));
    const auto outer = outer_vertices(file, extract_surface(file.mesh), 5);
    std::vector<Vec3> x;
    for (const int v : outer[object]) x.push_back(file.mesh.vertices[v]);
    return x;
  }

  ProgramResult result;

 private:
  TemporaryFolder folder_;
};

inline const std::vector<std::string> exported_files = {"floor", "sheet", "a_ball", "rod",
                                                        "grains"};

// Returns the largest difference of coordinates [m]; infinite if the numbers of points differ.
inline double largest_difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::infinity();
  double largest = 0;
  for (size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i] - b[i]).cwiseAbs().maxCoeff());
  return largest;
}

}  // namespace tack
