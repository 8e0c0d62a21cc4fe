// A scene pays for what it names: no loop of a feature's files runs unless the scene names the feature.
#include <catch2/catch.hpp>

#include <set>
#include <string>
#include <vector>

#include "geometry/loop_observer.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// Records the files of the loops that have work, of steps.
struct Files : LoopObserver {
  void run(const SourcePosition& loop, int chunks, const ChunkCall& chunk) override {
    std::string file = loop.file_name();
    const std::string root = TACK_SOURCE_DIR "/";
    if (file.starts_with(root)) file.erase(0, root.size());
    if (chunks > 0) files.insert(file);
    for (int c = 0; c < chunks; ++c) chunk(c);
  }
  bool has(const std::string& start) const {
    const auto at = files.lower_bound(start);
    return at != files.end() && at->starts_with(start);
  }
  std::set<std::string> files;
};

Files files_of(const std::string& yaml) {
  TestRun run(yaml);
  Files files;
  const LoopObserverScope observed(&files);
  for (int i = 0; i < 3; ++i) run.step();
  return files;
}

const std::string block = R"(
time: {step: 1 ms, duration: 1 s}
gravity: [0, -9.81, 0]
objects:
  - name: block
    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}
    energies: [{type: neo_hookean, young: 0.1 MPa, poisson: 0.4, density: 1000}]
)";
const std::string floor_below = R"(
  - name: floor
    shape: {type: box, size: [1, 0.1, 1], cells: [2, 1, 2]}
    place: {translate: [0, -0.1005, 0]}
    motion: [fixed]
)";
const std::string contact = floor_below + "contact: {distance: 1 mm}\n";

struct Feature {
  std::string name, files, scene;  // the start of the files' paths; a scene that names it
};

}  // namespace

TEST_CASE("no loop runs for what a scene does not name", "[features]") {
  const auto feature = GENERATE(values<Feature>({
      {"contact", "framework/contact/", block + contact},
      {"contact", "geometry/broad_phase/", block + contact},
      {"friction", "framework/contact/terms/friction", block + floor_below + "contact: {distance: 1 mm, friction: {mu: 0.5, eps_v: 1 mm/s}}\n"},
      {"adhesion", "framework/contact/area_integral/surface_overlap",
       block + floor_below + "contact: {distance: 1 mm, pairs: [{between: [block, floor], adhesion: {type: fang, peak_traction: 1 kPa}}]}\n"},
      {"bonds", "framework/bond/",
       block + floor_below + "contact: {distance: 1 mm, pairs: [{between: [block, floor], bond_distance: 1 mm, adhesion: {type: bilinear, peak_traction: 1 kPa, "
                             "work_of_adhesion: 1 J/m^2}}]}\n"},
      {"another model of contact", "framework/contact/ipc/", block + floor_below + "contact: {distance: 1 mm, model: ipc}\n"},
      {"another model of contact", "framework/contact/gcp/", block + floor_below + "contact: {distance: 1 mm, model: gcp}\n"},
      {"composite elements", "energies/solid/composite", block + "    elements: composite\n"},
      {"plasticity", "energies/plasticity/", R"(
time: {step: 1 ms, duration: 1 s}
objects:
  - name: block
    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}
    energies: [{type: von_mises, young: 0.1 MPa, poisson: 0.4, density: 1000, yield_stress: 1 kPa}]
)"},
      {"relaxation", "energies/viscoelastic/", R"(
time: {step: 1 ms, duration: 1 s}
objects:
  - name: block
    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}
    energies: [{type: neo_hookean, young: 0.1 MPa, poisson: 0.4, density: 1000}, {type: maxwell, modulus: 10 kPa, time: 0.1 s}]
)"},
      {"sheets", "energies/shell/", block + R"(
  - name: sheet
    shape: {type: grid, size: [0.1, 0.1], cells: [3, 3]}
    place: {translate: [1, 0, 0]}
    shell: {thickness: 1 mm}
    energies: [{type: neo_hookean_membrane, young: 5 kPa, poisson: 0.3, density: 200}, {type: hinge_bending, stiffness: 1e-6}]
)"},
      {"rods", "energies/rod/", block + R"(
  - name: rod
    shape: {type: segment, length: 0.2, edges: 5}
    place: {translate: [1, 0, 0]}
    rod: {radius: 5 mm}
    energies: [{type: elastic_rod, young: 1 MPa, poisson: 0.3, density: 1000}]
)"},
      {"affine bodies", "framework/affine/", block + R"(
  - name: stone
    shape: {type: box, size: [0.1, 0.1, 0.1]}
    place: {translate: [1, 0, 0]}
    body: {type: affine, density: 1000}
)"},
      {"interactions", "energies/interactions/", block + floor_below + R"(
interactions:
  - {name: link, type: spring, from: {object: floor}, to: {object: block}, stiffness: 10}
)"},
      {"wind", "energies/loads/wind", block + "    loads: [{type: wind, velocity: [1, 0, 0], drag: 1.2}]\n"},
  }));
  CAPTURE(feature.name, feature.files);
  const Files without = files_of(block + (feature.name == "contact" ? "" : contact));
  CHECK_FALSE(without.files.empty());
  CHECK_FALSE(without.has(feature.files));
  CHECK(files_of(feature.scene).has(feature.files));
}
