#include "framework/config/describe.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "framework/config/yaml_text.hpp"
#include "tests/framework/config/toy.hpp"

using namespace tack;

TEST_CASE("YAML text reads back as the same tree") {
  const char* const texts[] = {"a",     "",      "null", "~",    "true",    "5 mm",  "a: b",
                               "# no",  "- x",   "[1",   "x\ny", "t\t\x01", "\"q\"", "b\\c",
                               "a, b",  "&x",    "*x",   "!t",   "%",       "@",     "'",
                               "µm",    " pad ", "-",    "1e3",  "-2",      "x#y",   "?",
                               "a'b\"", "=",     "<<",   "0x10", "2001-01", "---",   "..."};
  Value v = Value::map();
  Value list = Value::sequence();
  for (const char* text : texts) {
    list.items.push_back(Value::scalar(text));
    v.set(std::string("key ") + text, Value::scalar(text));
  }
  v.set("flat", list);
  v.set("empty", Value::sequence());
  v.set("none", Value::map());
  v.set("null", Value());
  Value inner = Value::map();
  inner.set("a", list);
  inner.set("b", inner);
  v.set("blocks", Value::sequence({inner, Value::sequence({inner, list}), Value::map(), Value()}));
  const std::string text = yaml_text(v);
  INFO(text);
  CHECK(inline_text(parse_string(text, "echo")) == inline_text(v));
  CHECK(inline_text(parse_string(inline_text(v), "echo")) == inline_text(v));
}

TEST_CASE("the echo holds every value in SI with its unit") {
  toy::Scene s = toy::bound("young: 5 MPa\npull: [[0, 0], [1, 5 cm]]\nobjects: [{name: desk}]\n");
  CHECK(to_yaml(fields_of(s)) ==
        "density: 1000  # kg/m^3\n"
        "young: 5000000  # Pa\n"
        "count: 3\n"
        "seed: null\n"
        "verbose: false\n"
        "title: toy\n"
        "mesh: \"\"\n"
        "gravity: [0, -9.81, 0]  # m/s^2\n"
        "extent: [1, 1]  # m\n"
        "cells: [1, 2, 3]\n"
        "grid: [4, 5]\n"
        "target: null  # m\n"
        "angles: [0.5]  # rad\n"
        "tags: [a, b]\n"
        "form: plain\n"
        "time:\n"
        "  step: 0.01  # s\n"
        "  steps: 10\n"
        "ramp: null\n"
        "objects:\n"
        "  - name: desk\n"
        "    size: [1, 2, 3]  # m\n"
        "clocks: {}\n"
        "energy: null\n"
        "spring:\n"
        "  type: toy_spring\n"
        "  stiffness: 2  # N/m\n"
        "  rest: 0.25  # m\n"
        "  range: 1  # m\n"
        "energies: []\n"
        "pull: [[0, 0], [1, 0.05]]  # [s, m]\n"
        "later: null\n");
}

TEST_CASE("the echo reads back bit for bit") {
  toy::Scene s = toy::bound(
      "density: 1.1 g/cm^3\nyoung: 0.3 kPa\nmesh: x/y z.obj\ntitle: \"a: b # c\"\n"
      "target: [0.1, 1e-300, -7.3e22]\nangles: [1 deg, 2 deg, 1e16, 123456789.123456789]\n"
      "ramp: {step: 3 us}\nobjects: [{name: \"1\"}, {name: b, size: [0.1 mm, 1, 1]}]\n"
      "clocks: {a b: {step: 7 ns}}\nenergies: [{type: toy_sum, terms: [toy_spring]}, toy_nothing]\n"
      "energy: {type: toy_solid, young: 1 psi, density: 3}\npull: [[0.1, 1 in], [0.2, 2 in]]\n"
      "later: {a: [1, {b: c d}], e: 5 mm}\nspring: \n");
  s.gravity = Vec3(std::nextafter(0.1, 1), std::numeric_limits<double>::denorm_min(), -0.0);
  const std::string echo = to_yaml(fields_of(s));
  INFO(echo);
  toy::Scene again;
  bind(parse_string(echo, "/elsewhere/scene.yaml"), again, "scene");
  CHECK(again.density == s.density);
  CHECK(again.young == s.young);
  CHECK(again.mesh == s.mesh);
  CHECK(again.title == s.title);
  CHECK(again.target == s.target);
  CHECK(again.angles == s.angles);
  CHECK(again.ramp->step == s.ramp->step);
  CHECK(again.objects[1].size == s.objects[1].size);
  CHECK(again.clocks.at("a b").step == s.clocks.at("a b").step);
  CHECK(again.energy->value() == s.energy->value());
  CHECK(again.energies[0]->value() == s.energies[0]->value());
  CHECK(again.spring == nullptr);
  CHECK(again.pull == s.pull);
  CHECK(again.gravity == s.gravity);
  CHECK(std::signbit(again.gravity.z()));
  CHECK(to_yaml(fields_of(again)) == echo);
}

TEST_CASE("help lists kinds, components and parameters") {
  CHECK_THAT(list_kinds(),
             Catch::Contains("  toy_energy") && Catch::Contains("  Energy of the tests.\n"));
  CHECK(list_kind("toy_energy") ==
        "toy_energy: Energy of the tests.\n"
        "  toy_nothing  No energy.\n"
        "  toy_solid    A solid with required parameters.\n"
        "  toy_spring   A linear spring.\n"
        "  toy_sum      The sum of other energies.\n");
  CHECK(list_component("toy_energy", "toy_spring") ==
        "toy_energy 'toy_spring': A linear spring.\n"
        "source: Hooke 1678, p. 1\n"
        "file: tests/framework/config/registry_test.cpp\n"
        "parameters:\n"
        "  stiffness: stiffness (N/m), positive, default 2\n"
        "      force per elongation\n"
        "  rest: length (m), not negative, default 0.25\n"
        "      length without force\n"
        "  range: length (m), positive, default 1\n"
        "      largest length\n");
  CHECK_THAT(list_component("toy_energy", "toy_solid"),
             Catch::Contains("  young: pressure (Pa), positive, required\n"));
  CHECK_THAT(toy::message_of([] { list_kind("toy_enrgy"); }),
             Catch::StartsWith("unknown kind 'toy_enrgy'; did you mean 'toy_energy'? (kinds: "));
}

TEST_CASE("the reference page holds the scene and every component") {
  const std::string page = reference_page(prototype<toy::Scene>(), "Toy scene");
  for (const char* line :
       {"# Toy scene\n", "| key | value | default | range | meaning |\n",
        "| `density` | density (kg/m^3) | `1000` | positive | mass per volume |\n",
        "| `young` | pressure (Pa) | unset | positive | stiffness |\n",
        "| `time` | map |  |  | when |\n| `time.step` | time (s) | `0.01` | positive | time step "
        "|\n",
        "| `objects[].name` | text | required |  | how others refer to it |\n",
        "| `angles` | list of angles (rad) | `[0.5]` | not empty | some angles |\n",
        "| `form` | one of plain, squared | `plain` |  | argument of the law<br>`plain`: in the "
        "gap",
        "| `spring` | [toy_energy](#toy_energy) | `toy_spring` |  | an energy with a default |\n",
        "\n## toy_energy\n\nEnergy of the tests.\n", "\n### toy_energy `toy_spring`\n",
        "Source: Hooke 1678, p. 1.\n", "Code: `tests/framework/config/registry_test.cpp`.\n",
        "No parameters.\n"}) {
    INFO(line << "\nin\n" << page);
    CHECK(page.find(line) != std::string::npos);
  }
}

TEST_CASE("the reference pages are an index, one page per format and one per kind") {
  const Fields scene = prototype<toy::Scene>();
  const auto pages = reference_pages({{"toy", "Toy files", "Read by tests.", &scene}});
  CHECK(pages.size() == registered_kinds().size() + 2);
  const auto has = [&](const char* file, const std::string& text) {
    INFO(text << "\nin\n" << pages.at(file));
    CHECK(pages.at(file).find(text) != std::string::npos);
  };
  has("README.md", "| [Toy files](toy.md) | Read by tests. |\n");
  has("README.md", "| [toy_energy](toy_energy.md) | 4 | Energy of the tests. |\n");
  has("toy.md", "| `time` | map |  |  | when |\n| `ramp` |");
  has("toy.md", "\n## `time`\n\nWhen.\n\n| key | value | default | range | meaning |\n| --- | --- | --- | --- | --- |\n| `time.step` |");
  has("toy.md", "| `spring` | [toy_energy](toy_energy.md) | `toy_spring` |");
  has("toy_energy.md", "# Toy energies\n\nEnergy of the tests.\n");
  has("toy_energy.md", "| [`toy_spring`](#toy_spring) | A linear spring. |\n");
  has("toy_energy.md", "\n## `toy_spring`\n\nA linear spring.\nSource: Hooke 1678, p. 1.\n");
}
