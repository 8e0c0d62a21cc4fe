// Contact models as components of a scene: names, deprecated keys, refusals, terms.
#include "framework/contact/contact_model.hpp"

#include <catch2/catch.hpp>

#include "framework/config/describe.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/experiment/retired_key_warnings.hpp"
#include "tests/support/contact_terms.hpp"
#include "tests/support/scene.hpp"

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

TEST_CASE("contact models: terms of contact are those of the model, then bonds and friction", "[contact_model]") {
  const auto names = [](const std::string& scene) {
    TestScene test(scene);
    std::vector<std::string> all;
    for (const Term* term : test.world->contact_terms()) all.push_back(term->name());
    return all;
  };
  const std::string friction = ", friction: {mu: 0.5}";
  using Names = std::vector<std::string>;
  CHECK(names(contact("", adhesion + friction)) == Names{"contact", "rim", "friction"});
  CHECK(names(contact("model: clipped", adhesion + friction)) == Names{"contact", "clipped_adhesion", "friction"});
  CHECK(names(contact("model: ipc", adhesion + friction)) == Names{"contact", "friction"});
  CHECK(names(contact("", rcc + friction)) == Names{"contact", "bonds", "friction"});
}
