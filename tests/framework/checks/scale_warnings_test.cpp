#include "framework/checks/scale_warnings.hpp"

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"

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
    const std::vector<std::string> lines = scale_warnings(scene.config, *scene.world);
    REQUIRE(lines.size() == 1);  // the plate may be as large as it likes
    CHECK(contains(lines[0], "object 'cube' is 100 m large, 1e+05 times the contact distance (0.001 m): lengths without a unit are metres"));
  }
}

TEST_CASE("a body that its own weight would crush is doubted without contact as well", "[checks]") {
  std::string text = scaled(1000, soft);
  text.erase(text.find("contact:"), std::string("contact: {distance: 1 mm}\n").size());
  TestScene scene(text);
  const std::vector<std::string> lines = scale_warnings(scene.config, *scene.world);
  REQUIRE(lines.size() == 1);
  CHECK(contains(lines[0], "its weight presses on its base with 9.81e+05 Pa, more than Young's modulus (2e+05 Pa)"));
}

TEST_CASE("sizes, masses and speeds of bodies", "[checks]") {
  TestScene scene(scaled(1, soft));
  CHECK(size_text(*scene.world, 0).starts_with("0.3 x 0.1 x 0.3 m"));
  CHECK(size_text(*scene.world, 1) == "0.1 x 0.1 x 0.1 m, 1 kg, 2 m/s");
}
