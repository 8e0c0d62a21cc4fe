#include "framework/checks/resolution.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::vector<Warning> warnings(const std::string& objects, const std::string& contact) {
  TestScene scene("objects:\n" + objects + "contact:\n" + contact);
  return resolution_warnings(scene.config, *scene.world);
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
  CHECK_THAT(only_text(lines, WarningKind::process_zone), Contains("elements of 'cube'") && Contains("E W / sigma^2 = 0.00333 m"));  // E dhat_a / (2 sigma)
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
  CHECK_THAT(first_text(warnings(ground + tape(40), glue), WarningKind::bending_length), Contains("(2 B W / sigma^2)^(1/4) = 0.00159 m"));
  CHECK_FALSE(warned(warnings(ground + tape(90), glue), WarningKind::bending_length));
  // B is that of bending, whatever the membrane is made of.
  CHECK_THAT(first_text(warnings(ground + tape(90, "stiffness: 4e-6"), glue), WarningKind::bending_length), Contains("(2 B W / sigma^2)^(1/4) = 0.000894 m"));
  CHECK_FALSE(warned(warnings(ground + tape(40, "stiffness: 4e-3"), glue), WarningKind::bending_length));
  CHECK_THAT(first_text(warnings(ground + rod(40), glue), WarningKind::bending_length), Contains("(2 B W / sigma^2)^(1/4) = 0.00159 m"));
  CHECK_FALSE(warned(warnings(ground + rod(90), glue), WarningKind::bending_length));
}

TEST_CASE("resolution: the process zone is that of solids, whatever a sheet on them is made of") {
  // E W / sigma^2 of the sheet would be 0.8 mm, that of the block is 80 m.
  const auto warned_of = [](const std::string& bending) {
    return warned(warnings("  - {name: ground, shape: {type: box, size: [0.2, 0.1, 0.2], cells: [4, 2, 4]}, place: {translate: [0, -0.05, 0]}, energies: [{type: neo_hookean, young: 1 GPa}]}\n"
                           "  - {name: cube, shape: {type: grid, size: [0.06, 0.003], cells: [40, 4]}, place: {translate: [0, 0.0002, 0]}, shell: {thickness: 0.2 mm},\n"
                           "     energies: [{type: stvk_membrane, young: 10 kPa, poisson: 0}" + bending + "]}\n",
                           "  distance: 0.2 mm\n  pairs: [{between: [cube, ground], adhesion: {type: fang, peak_traction: 2.5 kPa}}]\n"), WarningKind::process_zone);
  };
  CHECK_FALSE(warned_of(", {type: hinge_bending, young: 10 kPa, poisson: 0}"));
  CHECK(warned_of(""));  // a membrane only stretches
}

TEST_CASE("resolution: a coarse sphere is warned of") {
  const auto ball = [](int cells) {
    return fmt::format("  - {{name: cube, shape: {{type: sphere, radius: 0.05, cells: {}}}, place: {{translate: [0, 0.0511, 0]}},\n"
                       "     energies: [{{type: neo_hookean, young: 1e7}}]}}\n", cells);
  };
  CHECK_THAT(first_text(warnings(ground + ball(4), sticky), WarningKind::coarse_curvature), Contains("'cube'"));
}

TEST_CASE("resolution: a contact distance above the elements is warned of, and so are forces of a body on itself") {
  const auto lines = warnings(ground + cube(60), "  distance: 2 mm\n");
  CHECK_THAT(first_text(lines, WarningKind::contact_distance), Contains("0.002 m") && Contains("'cube'"));
  CHECK_FALSE(warned(lines, WarningKind::self_contact_force));  // neighbours at rest are none
}

TEST_CASE("resolution: a range above the thickness is warned of") {
  const std::string sheet = "  - {name: cube, shape: {type: box, size: [0.1, 0.0005, 0.1], cells: [10, 1, 10]},\n"
                            "     place: {translate: [0, 0.0015, 0]}, energies: [{type: neo_hookean, young: 1e5}]}\n";
  CHECK_THAT(first_text(warnings(ground + sheet, "  distance: 1 mm\n"), WarningKind::self_contact_range), Contains("'cube'"));
}

TEST_CASE("resolution: copies of an object are warned of in one line") {
  const std::string grains = "  - {name: grain, shape: {type: sphere, radius: 1 cm, cells: 8, surface: true}, body: {type: affine, density: 1000},\n"
                             "     fill: {region: {type: box, size: [0.2, 0.2, 0.2], place: {translate: [0, 0.2, 0]}}, count: 5, clearance: 6 mm}}\n";
  const auto lines = warnings(ground + grains, "  distance: 5 mm\n");
  CHECK_THAT(only_text(lines, WarningKind::contact_distance), Contains("'grain_1'") && Contains("(and so it is for 4 more copies of 'grain')"));
}

TEST_CASE("resolution: two objects that start within the contact distance are warned of if that squeezes one or throws it off") {
  const auto bar = [](double gap) {
    return fmt::format("  - {{name: walls, shape: {{type: parts, parts: [{{shape: {{type: box, size: [0.3, 0.1, 0.3]}}, place: {{translate: [0, {0}, 0]}}}},\n"
                       "     {{shape: {{type: box, size: [0.3, 0.1, 0.3]}}, place: {{translate: [0, -{0}, 0]}}}}]}}, motion: [fixed]}}\n"
                       "  - {{name: cube, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}, energies: [{{type: neo_hookean, young: 1e7}}]}}\n", 0.1 + gap);
  };
  const auto presses = [](const std::vector<Warning>& given) { return warned(given, WarningKind::squeezed_object) || warned(given, WarningKind::thrown_object); };
  CHECK_THAT(first_text(warnings(bar(1e-4), "  distance: 0.5 mm\n"), WarningKind::squeezed_object), Contains("'walls' and 'cube' start 0.0001 m apart") && Contains("(0.0005 m)"));
  CHECK_FALSE(presses(warnings(bar(6e-4), "  distance: 0.5 mm\n")));
  // There is no warning of a cube at the gap that carries its weight. There is one of a cube that starts much nearer and is thrown off.
  const auto above = [](double gap) {
    return fmt::format("  - {{name: cube, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}, place: {{translate: [0, {}, 0]}}, energies: [{{type: neo_hookean, young: 1e7}}]}}\n",
                       0.05 + gap);
  };
  CHECK_FALSE(presses(warnings(ground + above(0.98e-3), "  distance: 1 mm\n")));
  CHECK_THAT(first_text(warnings(ground + above(1e-5), "  distance: 1 mm\n"), WarningKind::thrown_object), Contains("'cube'"));
}
