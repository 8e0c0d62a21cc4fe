#include "framework/scene/resolution.hpp"

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

TEST_CASE("resolution: elements above the process zone are told") {
  const auto lines = warnings(ground + cube(3, 1e5), "  distance: 1 mm\n  pairs: [{between: [cube, ground], "
                                                     "adhesion: {type: fang, peak_traction: 30 kPa}}]\n");
  REQUIRE(lines.size() == 1);
  CHECK(one_with(lines, "elements of 'cube'"));
  CHECK(one_with(lines, "E W / sigma^2 = 0.00333 m"));  // E dhat_a / (2 sigma)
}

TEST_CASE("resolution: a coarse sphere is told") {
  const auto ball = [](int cells) {
    return fmt::format("  - {{name: cube, shape: {{type: sphere, radius: 0.05, cells: {}}}, place: {{translate: [0, 0.0511, 0]}},\n"
                       "     energies: [{{type: neo_hookean, young: 1e7}}]}}\n", cells);
  };
  CHECK(one_with(warnings(ground + ball(4), sticky), "the surface of 'cube' is coarse"));
}

TEST_CASE("resolution: a contact distance above the elements is told, and forces of a body on itself") {
  const auto lines = warnings(ground + cube(60), "  distance: 2 mm\n");
  CHECK(one_with(lines, "contact.distance (0.002 m) exceeds the elements of 'cube'"));
  CHECK_FALSE(one_with(lines, "starts with contact forces"));  // neighbours at rest are none
}

TEST_CASE("resolution: a range above the thickness is told") {
  const std::string sheet = "  - {name: cube, shape: {type: box, size: [0.1, 0.0005, 0.1], cells: [10, 1, 10]},\n"
                            "     place: {translate: [0, 0.0015, 0]}, energies: [{type: neo_hookean, young: 1e5}]}\n";
  CHECK(one_with(warnings(ground + sheet, "  distance: 1 mm\n"), "above its thickness"));
}
