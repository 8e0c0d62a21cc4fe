#include "framework/config/field.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "tests/framework/config/toy.hpp"

using namespace tack;
using toy::bound;

TEST_CASE("absent keys leave the defaults") {
  const toy::Scene s = bound("");
  CHECK(s.density == 1000);
  CHECK_FALSE(s.young);
  CHECK(s.gravity == Vec3(0, -9.81, 0));
  CHECK(s.energy == nullptr);
  CHECK(s.tags.size() == 2);
}

TEST_CASE("plain fields are bound") {
  const toy::Scene s = bound(
      "density: 1 g/cm^3\nyoung: 5 MPa\ncount: +7\nseed: -2\nverbose: true\ntitle: a title\n"
      "gravity: [0, 0, -10]\nextent: [1 cm, 2]\ncells: [4, 5, 6]\ngrid: [-1, 2]\n"
      "target: [1, 2, 3 mm]\nangles: [0, 180 deg]\ntags: []\nform: squared\n");
  CHECK(s.density == Approx(1000).epsilon(1e-14));
  CHECK(s.young == 5e6);
  CHECK(s.count == 7);
  CHECK(s.seed == -2);
  CHECK(s.verbose);
  CHECK(s.title == "a title");
  CHECK(s.gravity == Vec3(0, 0, -10));
  CHECK(s.extent.x() == Approx(0.01));
  CHECK(s.cells == std::array{4, 5, 6});
  CHECK(s.grid == std::array{-1, 2});
  CHECK(s.target->z() == Approx(0.003));
  CHECK(s.angles[1] == Approx(3.141592653589793));
  CHECK(s.tags.empty());
  CHECK(s.form == toy::Form::squared);
}

TEST_CASE("null unsets optional fields") {
  toy::Scene s;
  s.young = 1;
  s.seed = 1;
  s.target = Vec3(1, 1, 1);
  s.ramp.emplace();
  bind(parse_string("young:\nseed: ~\ntarget: null\nramp:\nspring:\n", "s.yaml"), s, "scene");
  CHECK_FALSE(s.young);
  CHECK_FALSE(s.seed);
  CHECK_FALSE(s.target);
  CHECK_FALSE(s.ramp);
  CHECK(s.spring == nullptr);
}

TEST_CASE("structs, lists and maps of structs are bound") {
  const toy::Scene s = bound(
      "time: {step: 1 ms}\nramp: {}\nobjects: [{name: a}, {name: b, size: [1, 1, 1]}]\n"
      "clocks: {fast: {steps: 2}, slow: }\n");
  CHECK(s.time.step == Approx(1e-3));
  CHECK(s.time.steps == 10);
  CHECK(s.ramp->steps == 10);
  REQUIRE(s.objects.size() == 2);
  CHECK(s.objects[0].size == Vec3(1, 2, 3));
  CHECK(s.objects[1].name == "b");
  CHECK(s.clocks.at("fast").steps == 2);
  CHECK(s.clocks.at("slow").steps == 10);
}

TEST_CASE("components are chosen by type or bare name") {
  const toy::Scene s = bound(
      "energy: {type: toy_spring, rest: 50 cm}\n"
      "energies: [toy_nothing, {type: toy_sum, terms: [toy_spring, toy_spring]}]\n");
  CHECK(s.energy->type() == "toy_spring");
  CHECK(s.energy->value() == 0.25);
  REQUIRE(s.energies.size() == 2);
  CHECK(s.energies[0]->type() == "toy_nothing");
  CHECK(s.energies[1]->value() == 2 * 0.0625);
}

TEST_CASE("a map without type sets the default component") {
  const toy::Scene s = bound("spring: {rest: 0.5}\n");
  CHECK(s.spring->type() == "toy_spring");
  CHECK(s.spring->value() == 0.25);
  CHECK(toy::bind_error("spring: {rset: 0.5}\n") ==
        "s.yaml:1:10: unknown key 'rset' in toy_energy 'toy_spring'; did you mean 'rest'? (keys: "
        "range, rest, stiffness, type)");
}

TEST_CASE("a component is bound on its own") {
  const auto energy =
      bind_component<toy::Energy>(parse_string("type: toy_spring\nrest: 0.5\n", "s"));
  CHECK(energy->value() == 0.25);
  CHECK(toy::message_of([] { bind_component<toy::Energy>(Value::scalar("toy_sprin")); }) ==
        "(built in): toy_energy: unknown toy_energy 'toy_sprin'; did you mean 'toy_spring'? "
        "(toy_energies: toy_nothing, toy_solid, toy_spring, toy_sum)");
}

TEST_CASE("paths become absolute and raw values stay as they are") {
  const toy::Scene s = bound("mesh: m/cube.obj\nlater: {a: [1 mm, x]}\n");
  CHECK(s.mesh == (std::filesystem::current_path() / "m/cube.obj").string());
  CHECK(s.later.find("a")->items[0].text == "1 mm");
  CHECK(s.later.find("a")->items[0].mark.text() == "s.yaml:2:13");
  CHECK(bound("mesh: \"\"\n").mesh == "");
}

TEST_CASE("wrong declarations are found at once") {
  double x = 0;
  double infinite = std::numeric_limits<double>::infinity();
  std::string relative = "a/b";
  Fields f;
  f.number("x", x, units::none, "doc");
  CHECK_THROWS_WITH(f.number("x", x, units::none, "doc"), "field 'x' is declared twice");
  CHECK_THROWS_WITH(f.number("type", x, units::none, "doc"), "'type' cannot be the key of a field");
  CHECK_THROWS_WITH(f.number("aB", x, units::none, "doc"), "'aB' cannot be the key of a field");
  CHECK_THROWS_WITH(f.number("y", x, units::none, ""), "field 'y' needs a description");
  CHECK_THROWS_AS(f.number("z", infinite, units::none, "doc"), std::logic_error);
  CHECK_THROWS_WITH(f.path("p", relative, "doc"), "the path 'p' must be empty or absolute");
}
