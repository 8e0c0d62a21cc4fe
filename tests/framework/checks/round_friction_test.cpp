#include "framework/checks/round_friction.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

const std::string floor_under = "  - {name: floor, shape: {type: box, size: [2, 0.1, 2]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n";

std::vector<Warning> warnings(const std::string& object, const std::string& contact = "friction: {mu: 0.5}") {
  TestScene scene("objects:\n" + floor_under + "  - {name: it, contact_offset: 5 mm, place: {translate: [0, 0.01, 0]}, " + object +
                  "}\ncontact: {distance: 1 mm, " + contact + "}\n");
  return round_friction_warnings(scene.config, *scene.world);
}

std::string rod(const std::string& more = "", const std::string& section = "radius: 5 mm", const std::string& energy = "elastic_rod") {
  return fmt::format("shape: {{type: segment, length: 0.1, edges: 5}}, rod: {{{}}}, energies: [{{type: {}, young: 10 MPa}}]{}", section, energy, more);
}

std::string particles(const std::string& more = "") {
  return "shape: {type: points, size: [0.1, 0, 0.1], counts: [3, 1, 3]}, particle: {radius: 5 mm}, energies: [particle]" + more;
}

}  // namespace

TEST_CASE("rods and particles that can rub are warned to slide without turning") {
  for (const std::string& object : {rod(), rod("", "radius: 5 mm", "string"), particles()}) {
    CHECK_THAT(only_text(warnings(object), WarningKind::sliding_round_bodies), Catch::Contains("of 'it' are round and can rub on 'floor' (mu 0.5), and they slide without turning"));
  }
  CHECK_THAT(warnings(rod())[0].text, Catch::StartsWith("the rods of 'it'") && Catch::Contains("give its energy elastic_rod `rolling: true`"));
  CHECK_THAT(warnings(rod("", "radius: 5 mm", "string"))[0].text, Catch::Contains("give it the energy elastic_rod with `rolling: true`"));
  CHECK_THAT(warnings(particles())[0].text, Catch::StartsWith("the particles of 'it'"));
  // Where a pair alone rubs.
  CHECK(warnings(rod(), "pairs: [{between: [it, floor], friction: {mu: 0.2}}]").size() == 1);
  // Several objects, one line.
  const auto lines = warnings(rod() + "}\n  - {name: other, contact_offset: 5 mm, place: {translate: [0, 0.1, 0]}, " + rod());
  REQUIRE(lines.size() == 1);
  CHECK_THAT(lines[0].text, Catch::StartsWith("the rods of 'it', and of 1 more object, are round"));
  // One end that is let go later on: then it rolls.
  CHECK(warnings(rod(", motion: [{type: fixed, until: 1 s, select: {type: indices, vertices: [0]}}]")).size() == 1);
}

TEST_CASE("objects that cannot roll, that roll, or that do not rub give no warning") {
  CHECK(warnings("shape: {type: points}, particle: {radius: 5 mm}, energies: [{type: particle, rolling: true}]").empty());
  CHECK(warnings(rod(), "friction: {mu: 0}").empty());
  CHECK(warnings(rod(), "pairs: [{between: [it, it], friction: {mu: 0.2}}]").empty());  // one rod and itself
  CHECK(warnings(rod(", motion: [{type: fixed, select: {type: indices, vertices: [0]}}]")).empty());
  CHECK(warnings(rod("", "width: 10 mm, height: 5 mm, normal: [0, 1, 0]")).empty());
  CHECK(warnings("shape: {type: box, size: [5 mm, 5 mm, 5 mm]}, energies: [{type: neo_hookean, young: 1 MPa}]").empty());
  // Particles and each other.
  CHECK(warnings(particles(), "pairs: [{between: [it, it], friction: {mu: 0.2}}]").size() == 1);
}
