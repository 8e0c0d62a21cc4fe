// Contact models as components of a scene: names, deprecated keys, refusals, terms.
#include "framework/contact/contact_model.hpp"

#include <catch2/catch.hpp>

#include "framework/config/describe.hpp"
#include "geometry/errors.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/experiment/retired_key_warnings.hpp"
#include "tests/support/contact_terms.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;
using Catch::Contains;

namespace {

const std::string two_boxes =
    "objects:\n"
    "  - {name: a, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
    "  - {name: b, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0.102, 0.01, 0.02]}, motion: [fixed]}\n";
const std::string adhesion = "adhesion: {type: fang, peak_traction: 1 kPa}";
const std::string rcc = "adhesion: {type: rcc, normal_stiffness: 1 MPa/mm, work_of_adhesion: 1 J/m^2}";

std::string contact(const std::string& settings, const std::string& pair = "") {
  return two_boxes + "contact: {distance: 5 mm" + (settings.empty() ? "" : ", " + settings) +
         (pair.empty() ? "" : ", pairs: [{between: [a, b], " + pair + "}]") + "}\n";
}

double energy(const std::string& scene) {
  TestScene test(scene);
  World& world = *test.world;
  world.contact->begin_step({world.rest});
  world.contact->move_to(world.rest);
  return contact_term(world).value(world.rest);
}

LoadedExperiment loaded(const std::string& scene) { return parse_experiment("name: s\n" + scene, "s.yaml"); }

}  // namespace

TEST_CASE("contact models: the default is area_integral", "[contact_model]") {
  CHECK(energy(contact("")) == energy(contact("model: area_integral")));
  CHECK(energy(contact("")) == energy(contact("model: {type: area_integral}")));
  CHECK(energy(contact("model: ipc")) != energy(contact("")));
}

TEST_CASE("contact models: deprecated keys stand for models", "[contact_model]") {
  CHECK(energy(contact("weights: pair", adhesion)) == energy(contact("model: ipc", adhesion)));
  CHECK(energy(contact("weights: area", adhesion)) == energy(contact("", adhesion)));
  TestScene clipped(contact("integral: clipped", adhesion));
  CHECK(clipped_adhesion(*clipped.world) != nullptr);
  for (const auto& [key, value, model] : {std::array{"weights", "pair", "ipc"}, {"integral", "clipped", "clipped"}}) {
    const LoadedExperiment scene = loaded(contact(std::string(key) + ": " + value));
    CHECK(scene.experiment.contact->model->type() == model);
    const std::string text = to_yaml(fields_of(scene.experiment));
    CHECK_THAT(text, Contains(std::string("type: ") + model));
    CHECK_THAT(text, !Contains(std::string(key) + ": " + value));
    const std::vector<Warning> warnings = retired_key_warnings(scene.root, scene.experiment);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0].text, Contains(std::string("'") + key + "' is deprecated: contact.model"));
    CHECK_THROWS_WITH(loaded(contact(std::string(key) + ": " + value + ", model: " + (std::string(model) == "ipc" ? "clipped" : "ipc"))),
                      Contains("take one of them out"));
  }
}

TEST_CASE("contact models: features that a model does not have are refused at their line", "[contact_model]") {
  const auto refuses = [](const std::string& scene, const std::string& message) {
    CHECK_THROWS_WITH(TestScene(scene), Contains(":5:") && Contains("contact.model: ") && Contains(message) && Contains("or choose model: area_integral"));
  };
  refuses(contact("model: ipc", rcc), "ipc has no adhesion by bonds");
  refuses(two_boxes + "contact: {distance: 5 mm, model: ipc, pairs: [{between: [{object: a, select: all}, b]}]}\n", "ipc has no regions of objects");
  CHECK_NOTHROW(TestScene(contact("model: clipped", rcc + ", integrate: both")));
}

TEST_CASE("contact models: each has each kind of object, or refuses it with line, object and remedy", "[contact_model]") {
  struct Kind {
    const char *name, *described;
    bool rods, particles;
  };
  const std::string membrane = "{type: stvk_membrane, young: 1e6, poisson: 0.3, density: 1000}, {type: hinge_bending, young: 1e6, poisson: 0.3}", of_rod = "{type: elastic_rod, young: 1e7, density: 1000}";
  const std::string sheet = "{type: grid, size: [0.1, 0.1], cells: [3, 3]}", segment = "{type: segment, length: 0.08, edges: 4}";
  const std::string of_sheet = "shape: " + sheet + ", shell: {thickness: 1 mm}, energies: [" + membrane + "]";
  const std::string rod = "shape: " + segment + ", rod: {radius: 1 mm}, energies: [" + of_rod + "]";
  const std::string fringed = "shape: {type: parts, parts: [{shape: " + sheet + "}, {shape: " + segment + ", place: {translate: [0, 0, 0.1]}}]}, shell: {thickness: 1 mm}, rod: {radius: 1 mm}, energies: [" + membrane + ", " + of_rod + "]";
  const std::vector<Kind> kinds = {
      {"volume", "shape: {type: box, size: [0.1, 0.02, 0.1], cells: [3, 1, 3]}, energies: [{type: neo_hookean, young: 1e6, density: 1000}]", false, false},
      {"affine", "shape: {type: box, size: [0.1, 0.02, 0.1], cells: [3, 1, 3]}, body: affine", false, false},
      {"sheet", of_sheet.c_str(), false, false},
      {"rod", rod.c_str(), true, false},
      {"fringed sheet", fringed.c_str(), true, false},
      {"particles", "shape: {type: points, size: [0.06, 0, 0.06], counts: [3, 1, 3]}, particle: {radius: 1 mm}, energies: [{type: particle, density: 2000}]", false, true}};
  for (const std::string& model : Registry<ContactModel>::kind().names())
    for (const Kind& lower : kinds)
      for (const Kind& upper : kinds) {
        INFO(model << ": " << lower.name << " below " << upper.name);
        const std::string scene = std::string("objects:\n  - {name: low, ") + lower.described + "}\n  - {name: high, " + upper.described +
                                  ", place: {translate: [0.003, 0.0205, 0.002]}}\ntime: {step: 1 ms, duration: 1 ms}\ncontact:\n  distance: 1 mm\n  model: " + model + "\n";
        try {
          TestRun run(scene);
          run.step();
          CHECK_FALSE(run.intersects());
        } catch (const InputError& error) {
          const std::string text = error.what();
          const auto names = [&](bool has, const char* what, const char* object) {
            return has && text.find("contact.model: " + model + " has no " + what + ", and object '" + object + "' has some: ") != std::string::npos;
          };
          INFO(text);
          CHECK((names(lower.rods, "rods", "low") || names(upper.rods, "rods", "high") || names(lower.particles, "particles", "low") || names(upper.particles, "particles", "high")));
          CHECK_THAT(text, Contains("test.yaml:8:") && Contains("; make the object a surface or a solid, or choose model: area_integral"));
        }
      }
  // The default has all of them, so that the remedy is one.
  for (const std::string model : {"area_integral", "ipc", "clipped"})
    CHECK_NOTHROW(TestScene("objects:\n  - {name: low, " + rod + "}\n  - {name: high, " + fringed + ", place: {translate: [0, 0.02, 0]}}\ncontact: {distance: 1 mm, model: " + model + "}\n"));
}

TEST_CASE("contact models: terms of contact are those of the model, then bonds and friction", "[contact_model]") {
  const auto names = [](const std::string& scene) {
    TestScene test(scene);
    std::vector<std::string> all;
    for (const Term* term : test.world->contact_terms()) all.push_back(term->name());
    return all;
  };
  const std::string friction = ", friction: {mu: 0.5}";
  using Names = std::vector<std::string>;
  CHECK(names(contact("", adhesion + friction)) == Names{"contact", "rim", "overhangs", "friction"});
  CHECK(names(contact("model: clipped", adhesion + friction)) == Names{"contact", "clipped_adhesion", "friction"});
  CHECK(names(contact("model: ipc", adhesion + friction)) == Names{"contact", "friction"});
  CHECK(names(contact("", rcc + friction)) == Names{"contact", "bonds", "friction"});
}
