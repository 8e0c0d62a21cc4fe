#include "framework/config/parameters.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "framework/config/describe.hpp"
#include "framework/config/parse.hpp"
#include "framework/config/units.hpp"
#include "framework/config/yaml_text.hpp"
#include "framework/experiment/kept_expressions.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "geometry/errors.hpp"
#include "tests/framework/config/toy.hpp"

using namespace tack;
using toy::message_of;

namespace {

Parameters parameters_of(const std::string& map) { return Parameters::of(parse_string("parameters: " + map, "scene.yaml")); }

double number(const Parameters& p, const std::string& expression, const Unit& unit) { return to_si(p.evaluated(expression), unit); }

constexpr const char* scene = R"(
name: parametric
parameters: {width: 20 mm, height: width / 2, speed: 4 mm/s, n: 3, stiffness: 1 MPa}
time: {step: width / speed / 100, duration: 2 * width / speed}
objects:
  - name: block
    shape: {type: box, size: [2 * width, height, width], cells: [2 * n, n, n]}
    energies: [{type: neo_hookean, young: stiffness / 2, poisson: 0.3}]
    motion:
      - {type: translate, velocity: [0, speed, 0], select: {type: face, direction: [0, 1, 0]}}
      - {type: formula, x: width * sin(2 * t), select: {type: face, direction: [0, -1, 0]}}
probes:
  - {name: height_now, type: centre_of_mass, object: block, direction: [0, 1, 0]}
  - {name: part, type: formula, of: height_now / width}
)";

LoadedExperiment loaded(const std::string& override = "") {
  Value root = parse_string(scene, "scene.yaml");
  if (!override.empty()) apply_override(root, override);
  return bound_experiment(std::move(root));
}

}  // namespace

TEST_CASE("expressions have the unit that follows from their parts") {
  const Parameters p = parameters_of("{width: 20 mm, speed: 4 mm/s, mass: 2 kg, area: width^2, zero: 0 m, angle: 30 deg}");
  CHECK(number(p, "2 * width", units::length) == Approx(0.04).epsilon(1e-15));
  CHECK(number(p, "width / speed", units::time) == Approx(5).epsilon(1e-15));
  CHECK(number(p, "width/speed + 0.5 s", units::time) == Approx(5.5).epsilon(1e-15));
  CHECK(number(p, "sqrt(area)", units::length) == Approx(0.02).epsilon(1e-15));
  CHECK(number(p, "mass * 9.81 m/s^2 / area", units::pressure) == Approx(2 * 9.81 / 4e-4).epsilon(1e-14));
  CHECK(number(p, "1.5e3 kg/m^3 * area * width", units::mass) == Approx(1500 * 8e-6).epsilon(1e-14));
  CHECK(number(p, "width - 20 mm", units::length) == 0);
  CHECK(number(p, "zero", units::length) == 0);
  CHECK(number(p, "max(width, 3 cm)", units::length) == Approx(0.03).epsilon(1e-15));
  CHECK(number(p, "width > 1 cm ? 2 * width : width", units::length) == Approx(0.04).epsilon(1e-15));
  CHECK(number(p, "sin(angle)", units::none) == Approx(0.5).epsilon(1e-15));
  CHECK(number(p, "angle", units::angle) == Approx(std::acos(-1) / 6).epsilon(1e-15));
  CHECK(number(p, "width / 5 mm", units::none) == Approx(4).epsilon(1e-14));
  CHECK(number(p, "exp(width / 20 mm) * 1 Pa", units::pressure) == Approx(std::exp(1)).epsilon(1e-14));
  CHECK(number(p, "-width", units::length) == Approx(-0.02).epsilon(1e-15));
}

TEST_CASE("expressions whose parts do not fit have none") {
  const Parameters p = parameters_of("{width: 20 mm, speed: 4 mm/s}");
  CHECK(message_of([&] { p.evaluated("width + speed"); }).find("'width + speed' has no unit: ") == 0);
  CHECK(message_of([&] { p.evaluated("width + 0.1"); }).find("numbers in it need their units") != std::string::npos);
  CHECK(message_of([&] { p.evaluated("sin(width)"); }).find("has no unit") != std::string::npos);
  CHECK(message_of([&] { p.evaluated("width = 3"); }).find("did you mean `==`?") != std::string::npos);
  CHECK(message_of([&] { p.evaluated("width / (speed - 4 mm/s)"); }).find("is inf") != std::string::npos);
  CHECK(message_of([&] { p.evaluated("2 * widht"); }) == "'widht' is no parameter; did you mean 'width'? (parameters: speed, width)");
  CHECK(message_of([&] { number(p, "2 * width", units::time); }).find("which is a length") != std::string::npos);
}

TEST_CASE("errors of expressions show them as they are written, with their parameters without units") {
  CHECK(message_of([] { parameters_of("{speed: \"0,1 mm/s\"}"); }) ==
        "scene.yaml:1:21: parameters: speed: formula '0,1 mm/s': a comma makes 2 formulas of it; write numbers with a point, as 0.02");
  const auto error = [](const std::string& override) { return message_of([&] { loaded(override); }); };
  CHECK(error("height=0 mm").find("size: 'height' (0 m) must be positive") != std::string::npos);
  CHECK(error("stiffness=-1 MPa").find("young: 'stiffness / 2' (-500000 Pa) must be positive") != std::string::npos);
  const std::string bare = error("width=20");
  INFO(bare);
  CHECK(bare.find("; it is 'width / speed / 100', where width has no unit") != std::string::npos);
}

// In a batch or a calibration, each case runs its resolved scene.
TEST_CASE("the resolved scene of a run with sensitivities keeps expressions of parameters") {
  const LoadedExperiment numbers = loaded(), asked = loaded("output.gradients=[{key: stiffness}]");
  CHECK(value_at(resolved_scene(numbers.root, numbers.experiment), "objects.block.energies.0.young")->text == "500000");
  const std::string text = yaml_text(resolved_scene(asked.root, asked.experiment));
  const auto bound = [&](const std::vector<std::string>& overrides) { return parse_experiment(text, "kept.yaml", overrides); };
  CHECK(to_yaml(fields_of(bound({}).experiment)) == to_yaml(fields_of(asked.experiment)));
  const Value stiff = to_value(fields_of(bound({"stiffness=4 MPa", "width=40 mm"}).experiment));
  CHECK(value_at(stiff, "objects.block.energies.0.young")->text == "2000000");
  CHECK(value_at(stiff, "parameters.height")->text == "0.02 m");  // itself an expression
  CHECK(value_at(stiff, "probes.part.of")->text == "height_now / (0.04)");
}

TEST_CASE("names are found, and only names") {
  const Parameters p = parameters_of("{width: 20 mm, m: 3, s: 2 kg}");
  CHECK(p.named_in("2 * width"));
  CHECK_FALSE(p.named_in("widths"));
  CHECK_FALSE(p.named_in("2 m"));      // metres
  CHECK_FALSE(p.named_in("10 m s-1"));
  CHECK(p.named_in("2 * m"));
  CHECK_FALSE(p.named_in("4 mm / s"));  // a number with a unit is no expression
  CHECK_FALSE(Parameters().named_in("width"));
}

TEST_CASE("parameters may need others, but not each other") {
  CHECK(number(parameters_of("{a: 2 * b, b: c + 1 mm, c: 1 mm}"), "a", units::length) == Approx(0.004).epsilon(1e-15));
  CHECK(message_of([] { parameters_of("{a: b, b: 2 * a}"); }) == "scene.yaml:1:17: parameters: a: a, b need each other; give one of them as a number");
  CHECK(message_of([] { parameters_of("{a: 2 * a}"); }) == "scene.yaml:1:17: parameters: a: needs itself; give it as a number");
  CHECK(message_of([] { parameters_of("{2a: 1}"); }).find("'2a' cannot stand in an expression") != std::string::npos);
  CHECK(message_of([] { parameters_of("{sin: 1}"); }).find("'sin' is a function or a constant of formulas") != std::string::npos);
  CHECK(message_of([] { parameters_of("[1]"); }).find("expects names with numbers") != std::string::npos);
  CHECK(message_of([] { parameters_of("{a: [1]}"); }).find("a: expects a number with its unit") != std::string::npos);
  CHECK(message_of([] { parameters_of("{a: 3 mmm}"); }).find("parameters: a: ") != std::string::npos);
}

TEST_CASE("a scene has expressions wherever it has numbers") {
  const LoadedExperiment l = loaded();
  CHECK(l.experiment.time.step == Approx(0.05).epsilon(1e-14));
  CHECK(l.experiment.time.duration == Approx(10).epsilon(1e-14));
  CHECK(l.experiment.parameters.at("height").si == Approx(0.01).epsilon(1e-15));
  const LoadedExperiment wide = loaded("width=40 mm");
  CHECK(wide.experiment.time.step == Approx(0.1).epsilon(1e-14));
  CHECK(loaded("parameters.width=40 mm").experiment.time.step == wide.experiment.time.step);
}

TEST_CASE("the parameters of a resolved scene bind again") {
  LoadedExperiment l = loaded("n=2");
  const std::string kept = to_yaml(fields_of(l.experiment));
  const LoadedExperiment again = parse_experiment(kept, "kept.yaml");
  CHECK(to_yaml(fields_of(again.experiment)) == kept);
  CHECK(kept.find("cells: [4, 2, 2]") != std::string::npos);
  CHECK(kept.find("speed: \"0.004 m s^-1\"") != std::string::npos);
}

// Base and derived units beside numbers that need them all.
TEST_CASE("parameters may be called as units are") {
  for (const std::string name : {"m", "s", "kg", "K", "N", "J", "Pa", "g", "h"}) {
    INFO(name);
    const std::string map = "{" + name + ": 2 mm, stiff: 0.1 MPa, viscous: 3 Pa s, fast: 4 m/s, total: stiff + 1 kg m^-1 s^-2, twice: 2 * " + name + "}";
    const Parameters p = parameters_of(map);
    CHECK(number(p, "stiff", units::pressure) == 1e5);
    CHECK(number(p, "fast", units::velocity) == 4);
    CHECK(number(p, "total", units::pressure) == Approx(100001).epsilon(1e-15));
    CHECK(number(p, "2 * " + name, units::length) == Approx(0.004).epsilon(1e-15));
    CHECK(number(p, "twice", units::length) == Approx(0.004).epsilon(1e-15));
    // The resolved scene is complete: parsed again, it resolves to the same text.
    std::string text = scene;
    const std::string from = "{width: 20 mm, height: width / 2, speed: 4 mm/s, n: 3, stiffness: 1 MPa}";
    text.replace(text.find(from), from.size(), "{width: 20 mm, height: width / 2, speed: 4 mm/s, n: 3, stiffness: 1 MPa, " + name + ": 2 mm}");
    const std::string kept = to_yaml(fields_of(parse_experiment(text, "scene.yaml").experiment));
    CHECK(to_yaml(fields_of(parse_experiment(kept, "kept.yaml").experiment)) == kept);
  }
}

TEST_CASE("wrong expressions are reported with their locations") {
  const auto error = [](const std::string& override) { return message_of([&] { loaded(override); }); };
  CHECK(error("time.step=2 * width").find("step: expects a time (s), got '0.04 m', which is a length") != std::string::npos);
  CHECK(error("objects.block.shape.cells=[n / 2, 1, 1]").find("expects a whole number") != std::string::npos);
  CHECK(error("parameters.t=1").find("'t' is a variable of this formula, and a parameter of the scene") != std::string::npos);
  CHECK(error("parameters.part=1").find("the probe 'part' has the name of a parameter") != std::string::npos);
  CHECK(error("parameters=7").find("parameters: expects names with numbers") != std::string::npos);
}
