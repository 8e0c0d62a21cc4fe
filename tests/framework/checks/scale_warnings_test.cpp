#include "framework/checks/scale_warnings.hpp"
#include "framework/checks/flush_faces.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <optional>

#include "framework/body/extent.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A cube on a plate, both so many times as large as they are meant, the contact distance and the time step as they are.
std::string scaled(double by, const std::string& body) {
  return fmt::format("gravity: [0, -9.81, 0]\ncontact: {{distance: 1 mm}}\nobjects:\n"
                     "  - {{name: plate, shape: {{type: box, size: [{0}, {1}, {0}]}}, place: {{translate: [0, {2}, 0]}}, motion: [fixed]}}\n"
                     "  - {{name: cube, shape: {{type: box, size: [{1}, {1}, {1}]}}, velocity: [0, -2, 0], {3}}}\n",
                     0.3 * by, 0.1 * by, -0.11 * by, body);
}

const std::string soft = "energies: [{type: neo_hookean, young: 0.2 MPa, density: 1000}]", rigid = "body: {type: affine, density: 1000}";

}  // namespace

TEST_CASE("a scene that is a thousand times too large is doubted, the others are not", "[checks]") {
  for (const std::string& body : {soft, rigid}) {
    for (const double by : {0.1, 1.0, 10.0}) {
      INFO(by << " " << body);
      TestScene scene(scaled(by, body));
      CHECK(scale_warnings(scene.config, *scene.world).empty());
    }
    TestScene scene(scaled(1000, body));
    const std::vector<Warning> lines = scale_warnings(scene.config, *scene.world);
    // The plate may be as large as it likes.
    CHECK(contains(only_text(lines, WarningKind::large_object), "object 'cube' is 100 m large, 1e+05 times the contact distance (0.001 m): lengths without a unit are metres"));
  }
}

TEST_CASE("a body that its own weight would crush is doubted without contact as well", "[checks]") {
  std::string text = scaled(1000, soft);
  text.erase(text.find("contact:"), std::string("contact: {distance: 1 mm}\n").size());
  TestScene scene(text);
  const std::vector<Warning> lines = scale_warnings(scene.config, *scene.world);
  CHECK(contains(only_text(lines, WarningKind::heavy_object), "its weight presses on its base with 9.81e+05 Pa, more than Young's modulus (2e+05 Pa)"));
}

TEST_CASE("a body that is far larger than all others is doubted, whatever the contact distance", "[checks]") {
  const auto lines_of = [](double size, const char* motion) {
    TestScene scene(fmt::format("contact: {{distance: 10 cm}}\nobjects:\n"
                                "  - {{name: blob, shape: {{type: box, size: [{0}, {0}, {0}]}}, {1}}}\n"
                                "  - {{name: pebble, shape: {{type: box, size: [80 cm, 10 cm, 10 cm]}}, place: {{translate: [0, 200, 0]}}, {2}}}\n", size, motion, rigid));
    return scale_warnings(scene.config, *scene.world);
  };
  const std::string warned = only_text(lines_of(60, rigid.c_str()), WarningKind::large_object);
  CHECK(contains(warned, "object 'blob' is 60 m large, and the largest other one 800 mm: lengths without a unit are metres"));
  CHECK(lines_of(20, rigid.c_str()).empty());
  CHECK(lines_of(60, "motion: [fixed]").empty());  // a floor
  CHECK(size_ratio({60, 0.8, 0.1}, 0) == Approx(75));
  CHECK(size_ratio({60}, 0) == 0);
}

TEST_CASE("sizes, masses and speeds of bodies", "[checks]") {
  TestScene scene(scaled(1, soft));
  CHECK(size_text(*scene.world, 0).starts_with("300 x 100 x 300 mm"));
  CHECK(size_text(*scene.world, 1) == "100 x 100 x 100 mm, 1 kg, 2 m/s");
  // Twists of rods are unknowns without mass.
  const TestScene rod("time: {step: 1e-2, duration: 1e-2}\nobjects: [{name: rod, shape: {type: helix, radius: 0.1, pitch: 0.1, turns: 2, edges: 64}, rod: {radius: 5 mm},\n"
                      "            energies: [{type: elastic_rod, young: 1 MPa, density: 1000}]}]\n");
  CHECK(size_text(*rod.world, 0) == "200 x 200 x 200 mm, 0.09978 kg");  // pi r^2 times the length of the edges
}

// The study of the header: the scales of each shipped scene as it is, and with all lengths of its
// bodies taken 1000 times too large. Left out: scenes that take long to build, and one whose scale is
// meant to be wrong.
TEST_CASE("no shipped scene is doubted for its scale or its faces, and most are where their lengths are a thousand times too large", "[checks]") {
  const bool print = std::getenv("TACK_PRINT_STUDY") != nullptr;
  const std::vector<std::string> left_out = {"chips_bag/", "cleaning_gel/", "meatball/", "meshing/creature", "spider_web/", "squash/", "sticky_toys/", "sushi/",
                                             "tape_creature/", "twist/", "wax_seal/", "hard/scene_1e4_small_distance"};
  struct Count {
    int scenes = 0, found = 0;
  } with_contact, standing;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(TACK_SOURCE_DIR "/experiments")) {
    const std::string name = std::filesystem::relative(entry.path(), TACK_SOURCE_DIR "/experiments").string();
    if (entry.path().extension() != ".yaml" || std::any_of(left_out.begin(), left_out.end(), [&](const auto& start) { return name.starts_with(start); })) continue;
    std::optional<BuiltExperiment> built;
    try {
      built.emplace(load_experiment(entry.path().string(), {}));
    } catch (const InputError&) {
      continue;  // a batch, a comparison or a calibration
    }
    const Experiment& scene = built->experiment();
    World& world = built->world();
    INFO(name);
    double distance = 0, sag = 0, side = 0;
    for (const BodyScale& s : body_scales(scene, world)) {
      if (s.distance > 0 && (distance == 0 || s.distance < distance)) distance = s.distance;
      sag = std::max(sag, s.sag);
      side = std::max(side, s.side);
    }
    std::vector<double> extents;
    for (const Body& body : world.bodies) extents.push_back(extent_of(body, world.start.x).sizes().maxCoeff());
    double ratio = 0;  // of bodies that the check of sizes examines
    for (size_t i = 0; i < extents.size(); ++i)
      if (world.bodies[i].movable || world.bodies[i].from_file) ratio = std::max(ratio, size_ratio(extents, i));
    CHECK(scale_warnings(scene, world).empty());
    CHECK(flush_face_warnings(scene, world).empty());
    world.start.x *= 1000;
    world.mass *= 1e9;
    const bool warned = !scale_warnings(scene, world).empty();
    const auto count = [&](Count& of) {
      ++of.scenes;
      of.found += warned ? 1 : 0;
    };
    if (distance > 0) count(with_contact);
    if (sag > 0) count(standing);
    if (print) fmt::print("{} {:.3g} {:.3g} {:.3g} {:.3g} {}\n", name, side, distance, sag, ratio, warned);
  }
  CHECK(with_contact.scenes > 100);
  CHECK(with_contact.found > 0.8 * with_contact.scenes);
  CHECK(standing.scenes > 50);
  CHECK(standing.found > 0.9 * standing.scenes);  // the others are stiff against their weight even then: hard/scene_1e-6, integrators/bounce
}
