#include <catch2/catch.hpp>

#include "tests/framework/config/toy.hpp"

using namespace tack;
using toy::bind_error;

TEST_CASE("unknown keys are named with the nearest one") {
  CHECK(bind_error("time: {step: 1, stpes: 3}\n") ==
        "s.yaml:1:17: unknown key 'stpes' in time; did you mean 'steps'? (keys: step, steps)");
  CHECK(bind_error("energy:\n  type: toy_solid\n  yong: 1\n  young: 1\n  density: 1\n") ==
        "s.yaml:3:3: unknown key 'yong' in toy_energy 'toy_solid'; did you mean 'young'? (keys: "
        "density, type, young)");
  CHECK(
      bind_error("objects: [{name: a}, {name: desk, siez: 1}]\n") ==
      "s.yaml:1:35: unknown key 'siez' in objects 'desk'; did you mean 'size'? (keys: name, size)");
  CHECK(bind_error("clocks: {fast: {zzzzzz: 2}}\n") ==
        "s.yaml:1:17: unknown key 'zzzzzz' in clocks 'fast' (keys: step, steps)");
}

TEST_CASE("missing keys are named with their meaning") {
  CHECK(bind_error("energy: {type: toy_solid, density: 1}\n") ==
        "s.yaml:1:9: missing key 'young' in toy_energy 'toy_solid': Young's modulus; expects a "
        "pressure (Pa)");
  CHECK(bind_error("objects:\n  - size: [1, 1, 1]\n") ==
        "s.yaml:2:5: missing key 'name' in objects[0]: how others refer to it; expects a text");
  CHECK_THAT(bind_error("energies: [toy_solid]\n"),
             Catch::StartsWith("s.yaml:1:12: missing key 'young' in toy_energy 'toy_solid'"));
}

TEST_CASE("numbers out of range are refused") {
  CHECK(bind_error("density: -3\n") == "s.yaml:1:10: density: -3 kg/m^3 must be positive");
  CHECK(bind_error("density: -3 g/cm^3\n") == "s.yaml:1:10: density: -3 g/cm^3 must be positive");
  CHECK(bind_error("young: 0\n") == "s.yaml:1:8: young: 0 Pa must be positive");
  CHECK(bind_error("count: 11\n") == "s.yaml:1:8: count: 11 must be in [0, 10]");
  CHECK(bind_error("time: {steps: 0}\n") == "s.yaml:1:15: steps: 0 must be at least 1");
  CHECK(bind_error("cells: [1, 0, 1]\n") == "s.yaml:1:12: cells: 0 must be at least 1");
  CHECK(bind_error("spring: {rest: -1}\n") == "s.yaml:1:16: rest: -1 m must be not negative");
}

TEST_CASE("values of another kind are refused") {
  CHECK(bind_error("density: 5 mm\n") ==
        "s.yaml:1:10: density: expects a density (kg/m^3), got '5 mm', which is a length");
  CHECK(bind_error("density: [1]\n") ==
        "s.yaml:1:10: density: expects a density (kg/m^3), got a list of 1");
  CHECK(bind_error("density:\n") == "s.yaml:1:1: density: expects a density (kg/m^3), got nothing");
  CHECK(bind_error("count: 1.5\n") == "s.yaml:1:8: count: expects a whole number, got '1.5'");
  CHECK(bind_error("count: 99999999999\n") ==
        "s.yaml:1:8: count: 99999999999 is too large; whole numbers go from -2147483648 to 2147483647");
  CHECK(bind_error("count: -99999999999\n") ==
        "s.yaml:1:8: count: -99999999999 is too small; whole numbers go from -2147483648 to 2147483647");
  CHECK(bind_error("count: 99999999999x\n") == "s.yaml:1:8: count: expects a whole number, got '99999999999x'");
  CHECK(bind_error("verbose: yes\n") == "s.yaml:1:10: verbose: expects true or false, got 'yes'");
  CHECK(bind_error("title: [a]\n") == "s.yaml:1:8: title: expects a text, got a list of 1");
  CHECK(bind_error("mesh: {a: b}\n") == "s.yaml:1:7: mesh: expects a text, got a map");
  CHECK(bind_error("extent: 3\n") ==
        "s.yaml:1:9: extent: expects a list of 2 lengths (m), got '3'");
  CHECK(bind_error("gravity: [1, 2]\n") ==
        "s.yaml:1:10: gravity: expects a list of 3 accelerations (m/s^2), got a list of 2");
  CHECK(bind_error("cells: [1, 2, x]\n") == "s.yaml:1:15: cells: expects a whole number, got 'x'");
  CHECK(bind_error("grid: [1, 2, 3]\n") ==
        "s.yaml:1:7: grid: expects a list of 2 whole numbers, got a list of 3");
  CHECK(bind_error("angles: []\n") ==
        "s.yaml:1:9: angles: must not be empty; expects a list of angles (rad)");
  CHECK(bind_error("tags: a\n") == "s.yaml:1:7: tags: expects a list of texts, got 'a'");
  CHECK(bind_error("form: square\n") ==
        "s.yaml:1:7: form: expects one of plain, squared, got 'square'; did you mean 'squared'?");
  CHECK(bind_error("form: 3\n") == "s.yaml:1:7: form: expects one of plain, squared, got '3'");
  CHECK(bind_error("time: 3\n") == "s.yaml:1:7: time expects a map, got '3'");
  CHECK(bind_error("objects: {name: a}\n") ==
        "s.yaml:1:10: objects: expects a list of maps, got a map");
  CHECK(bind_error("objects: [3]\n") == "s.yaml:1:11: objects[0] expects a map, got '3'");
  CHECK(bind_error("clocks: [3]\n") ==
        "s.yaml:1:9: clocks: expects a map of names to maps, got a list of 1");
  CHECK(bind_error("- 1\n") == "s.yaml:1:1: scene expects a map, got a list of 1");
}

TEST_CASE("unknown components are named with the nearest one") {
  CHECK(bind_error("energy: {type: toy_sprung}\n") ==
        "s.yaml:1:16: energy: unknown toy_energy 'toy_sprung'; did you mean 'toy_spring'? "
        "(toy_energies: toy_nothing, toy_solid, toy_spring, toy_sum)");
  CHECK(bind_error("energy: {rest: 1}\n") ==
        "s.yaml:1:9: energy: expects 'type', the name of a toy_energy (toy_nothing, toy_solid, "
        "toy_spring, toy_sum), got no 'type'");
  CHECK(
      bind_error("energies: [[a]]\n") ==
      "s.yaml:1:12: energies[0]: expects 'type', the name of a toy_energy (toy_nothing, toy_solid, "
      "toy_spring, toy_sum), got a list of 1");
  CHECK(bind_error("energies: toy_spring\n") ==
        "s.yaml:1:11: energies: expects a list of toy_energies, got 'toy_spring'");
}

TEST_CASE("conditions between fields are reported at their key") {
  const std::string rule = "rest: must be smaller than range; raise range or lower it";
  CHECK(bind_error("energy: {type: toy_spring, rest: 3}\n") == "s.yaml:1:34: " + rule);
  CHECK(bind_error("energy: {type: toy_spring, range: 0.1}\n") == "s.yaml:1:9: " + rule);
  // Not when the fields themselves are wrong already.
  CHECK(bind_error("energy: {type: toy_spring, rest: 3, stiffness: -1}\n") ==
        "s.yaml:1:48: stiffness: -1 N/m must be positive");
}

TEST_CASE("all errors of a file are reported in its order, twenty at most") {
  CHECK(bind_error("form: x\ndensity: -1\ntime: {step: 0}\n") ==
        "s.yaml:1:7: form: expects one of plain, squared, got 'x'\n"
        "s.yaml:2:10: density: -1 kg/m^3 must be positive\n"
        "s.yaml:3:14: step: 0 s must be positive");
  std::string many = "tags:\n";
  for (int i = 0; i < 23; ++i) many += "  - []\n";
  const std::string message = bind_error(many);
  CHECK(std::count(message.begin(), message.end(), '\n') == 20);
  CHECK_THAT(message, Catch::EndsWith("s.yaml:21:5: tags: expects a text, got a list of 0\n"
                                      "... and 3 more errors"));
}
