#include "framework/checks/resolution.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/scene.hpp"

using namespace tack;

namespace {

std::vector<std::string> warnings(const std::string& objects, const std::string& contact) {
  TestScene scene("objects:\n" + objects + "contact:\n" + contact);
  return resolution_warnings(scene.config, *scene.world);
}

bool one_with(const std::vector<std::string>& lines, const std::string& part) {
  return std::count_if(lines.begin(), lines.end(),
                       [&](const std::string& line) { return line.find(part) != std::string::npos; }) == 1;
}

std::string cube(int cells, double young = 1e5) {
  return fmt::format("  - {{name: cube, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [{0}, {0}, {0}]}},\n"
                     "     place: {{translate: [0, 0.051, 0]}}, energies: [{{type: neo_hookean, young: {1}}}]}}\n",
                     cells, young);
}

const std::string ground = "  - {name: ground, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n";
const std::string sticky = "  distance: 1 mm\n  pairs: [{between: [cube, ground], adhesion: {type: fang, peak_traction: 3 kPa}}]\n";

}  // namespace

TEST_CASE("resolution: a scene that is fine enough is silent") {
  CHECK(warnings(ground + cube(8), sticky).empty());
}

TEST_CASE("resolution: elements above the process zone are warned of") {
  const auto lines = warnings(ground + cube(3, 1e5), "  distance: 1 mm\n  pairs: [{between: [cube, ground], "
                                                     "adhesion: {type: fang, peak_traction: 30 kPa}}]\n");
  REQUIRE(lines.size() == 1);
  CHECK(one_with(lines, "elements of 'cube'"));
  CHECK(one_with(lines, "E W / sigma^2 = 0.00333 m"));  // E dhat_a / (2 sigma)
}

TEST_CASE("resolution: a tape or a rod that is too coarse to be peeled is warned of") {
  const auto tape = [](int cells, const char* bending = "young: 60 MPa, poisson: 0") {
    return fmt::format("  - {{name: cube, shape: {{type: grid, size: [0.06, 0.003], cells: [{}, 4]}}, place: {{translate: [0, 0.0002, 0]}},\n"
                       "     shell: {{thickness: 0.2 mm}},\n"
                       "     energies: [{{type: stvk_membrane, young: 60 MPa, poisson: 0}}, {{type: hinge_bending, {}}}]}}\n", cells, bending);
  };
  const auto rod = [](int edges) {
    return fmt::format("  - {{name: cube, shape: {{type: segment, length: 0.06, edges: {}}}, place: {{translate: [0, 0.0002, 0]}},\n"
                       "     rod: {{width: 3 mm, height: 0.2 mm, normal: [0, 1, 0]}}, energies: [{{type: elastic_rod, young: 60 MPa}}]}}\n", edges);
  };
  const std::string glue = "  distance: 0.2 mm\n  pairs: [{between: [cube, ground], adhesion: {type: fang, peak_traction: 2.5 kPa}}]\n";
  // B = 60 MPa (0.2 mm)^3 / 12 = 4e-5 N m and W = 0.5 J/m^2: 1.59 mm.
  CHECK(one_with(warnings(ground + tape(40), glue), "(2 B W / sigma^2)^(1/4) = 0.00159 m"));
  CHECK_FALSE(one_with(warnings(ground + tape(90), glue), "not resolved"));
  // B is that of bending, whatever the membrane is made of.
  CHECK(one_with(warnings(ground + tape(90, "stiffness: 4e-6"), glue), "(2 B W / sigma^2)^(1/4) = 0.000894 m"));
  CHECK_FALSE(one_with(warnings(ground + tape(40, "stiffness: 4e-3"), glue), "not resolved"));
  CHECK(one_with(warnings(ground + rod(40), glue), "(2 B W / sigma^2)^(1/4) = 0.00159 m"));
  CHECK_FALSE(one_with(warnings(ground + rod(90), glue), "not resolved"));
}

TEST_CASE("resolution: a coarse sphere is warned of") {
  const auto ball = [](int cells) {
    return fmt::format("  - {{name: cube, shape: {{type: sphere, radius: 0.05, cells: {}}}, place: {{translate: [0, 0.0511, 0]}},\n"
                       "     energies: [{{type: neo_hookean, young: 1e7}}]}}\n", cells);
  };
  CHECK(one_with(warnings(ground + ball(4), sticky), "the surface of 'cube' is coarse"));
}

TEST_CASE("resolution: a contact distance above the elements is warned of, and so are forces of a body on itself") {
  const auto lines = warnings(ground + cube(60), "  distance: 2 mm\n");
  CHECK(one_with(lines, "contact.distance (0.002 m) exceeds the elements of 'cube'"));
  CHECK_FALSE(one_with(lines, "starts with contact forces"));  // neighbours at rest are none
}

TEST_CASE("resolution: a range above the thickness is warned of") {
  const std::string sheet = "  - {name: cube, shape: {type: box, size: [0.1, 0.0005, 0.1], cells: [10, 1, 10]},\n"
                            "     place: {translate: [0, 0.0015, 0]}, energies: [{type: neo_hookean, young: 1e5}]}\n";
  CHECK(one_with(warnings(ground + sheet, "  distance: 1 mm\n"), "above its thickness"));
}

TEST_CASE("resolution: copies of an object are warned of in one line") {
  const std::string grains = "  - {name: grain, shape: {type: sphere, radius: 1 cm, cells: 8, surface: true}, body: {type: affine, density: 1000},\n"
                             "     fill: {region: {type: box, size: [0.2, 0.2, 0.2], place: {translate: [0, 0.2, 0]}}, count: 5, clearance: 6 mm}}\n";
  const auto lines = warnings(ground + grains, "  distance: 5 mm\n");
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0], Catch::Contains("exceeds the elements of 'grain_1'") && Catch::Contains("(and so it is for 4 more copies of 'grain')"));
}

TEST_CASE("resolution: two objects that start within the contact distance are warned of if that squeezes one or throws it off") {
  const auto bar = [](double gap) {
    return fmt::format("  - {{name: walls, shape: {{type: parts, parts: [{{shape: {{type: box, size: [0.3, 0.1, 0.3]}}, place: {{translate: [0, {0}, 0]}}}},\n"
                       "     {{shape: {{type: box, size: [0.3, 0.1, 0.3]}}, place: {{translate: [0, -{0}, 0]}}}}]}}, motion: [fixed]}}\n"
                       "  - {{name: cube, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}, energies: [{{type: neo_hookean, young: 1e7}}]}}\n", 0.1 + gap);
  };
  CHECK(one_with(warnings(bar(1e-4), "  distance: 0.5 mm\n"), "'walls' and 'cube' start 0.0001 m apart, within contact.distance (0.0005 m), and press on each other from opposite sides with"));
  CHECK_FALSE(one_with(warnings(bar(6e-4), "  distance: 0.5 mm\n"), "press on each other"));
  // There is no warning of a cube at the gap that carries its weight. There is one of a cube that starts much nearer and is thrown off.
  const auto above = [](double gap) {
    return fmt::format("  - {{name: cube, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}, place: {{translate: [0, {}, 0]}}, energies: [{{type: neo_hookean, young: 1e7}}]}}\n",
                       0.05 + gap);
  };
  CHECK_FALSE(one_with(warnings(ground + above(0.98e-3), "  distance: 1 mm\n"), "press on each other"));
  CHECK(one_with(warnings(ground + above(1e-5), "  distance: 1 mm\n"), "'cube': it is thrown off"));
}
