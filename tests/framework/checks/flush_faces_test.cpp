#include "framework/checks/flush_faces.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

// A block on a block or plate of that width, under gravity.
std::vector<Warning> warnings(double width, const char* contact = "", const char* upper = "", const char* shape = "{type: box, size: [0.1, 0.1, 0.1]}") {
  const TestScene scene(fmt::format("gravity: [0, -9.81, 0]\ncontact: {{distance: 1 mm{}}}\nobjects:\n"
                                    "  - {{name: lower, shape: {{type: box, size: [{}, 0.1, 0.1]}}, place: {{translate: [0, -0.05, 0]}}, motion: [fixed]}}\n"
                                    "  - {{name: upper, shape: {}, place: {{translate: [0, 0.0508, 0]}}, energies: [{{type: neo_hookean, young: 1 MPa, density: 1000}}]{}}}\n",
                                    contact, width, shape, upper));
  return flush_face_warnings(scene.config, *scene.world);
}

}  // namespace

TEST_CASE("flush faces of equal extent without friction are doubted", "[checks]") {
  const std::string line = only_text(warnings(0.1), WarningKind::flush_faces);
  CHECK(contains(line, "'upper' and 'lower' lie on each other with flat faces of equal extent and without friction"));
  CHECK(contains(line, "larger by more than contact.distance (0.001 m)"));
  CHECK(warnings(0.103).empty());
  CHECK(warnings(0.1, ", friction: {mu: 0.1}").empty());
  CHECK(warnings(0.1, ", pairs: [{between: [upper, lower], adhesion: {type: fang, peak_traction: 1 kPa}}]").empty());
  CHECK(warnings(0.1, "", ", motion: [{type: fixed, select: {type: face, direction: [0, 1, 0]}}]").empty());
  CHECK(warnings(0.1, "", "", "{type: sphere, radius: 0.05, cells: 4}").empty());
}
