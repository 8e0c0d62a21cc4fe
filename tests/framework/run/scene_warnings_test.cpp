#include "framework/run/scene_warnings.hpp"

#include <catch2/catch.hpp>

#include "tests/support/scene.hpp"
#include "tests/support/tiny_scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::vector<Warning> warnings(const std::string& yaml) {
  TestScene scene(yaml);
  return scene_warnings(scene.config, *scene.world);
}

}  // namespace

TEST_CASE("a barrier that takes much of the work of adhesion is warned of", "[checks]") {
  const std::string tiny = tiny_scene.substr(tiny_scene.find("time:"));
  CHECK_FALSE(warned(warnings(tiny), WarningKind::adhesion_in_barrier));
  std::string stiff = tiny;
  stiff.insert(stiff.find("  pairs:"), "  barrier: {stiffness: 1 GPa}\n");
  CHECK_THAT(first_text(warnings(stiff), WarningKind::adhesion_in_barrier), Contains("'floor' - 'block'") && Contains("contact.barrier.stiffness"));
}

TEST_CASE("a bound that a mesh operation missed is warned of once for all copies", "[checks][meshing]") {
  const auto ball = [](const char* edge_length) {
    return std::string("objects:\n  - {name: ball, shape: {type: processed, of: {type: sphere, radius: 1, cells: 16, surface: true}, steps: [{type: remesh, edge_length: ") + edge_length +
           "}]}, motion: [fixed]}\n  - {name: block, shape: {type: box, size: [1, 1, 1]}, place: {translate: [9, 0, 0]}, energies: [{type: neo_hookean, young: 1 MPa}]}\n";
  };
  CHECK_THAT(only_text(warnings(ball("1.2")), WarningKind::mesh_bound), Contains("object 'ball': its area is"));
  CHECK_FALSE(warned(warnings(ball("0.2")), WarningKind::mesh_bound));
}

TEST_CASE("an object that starts with contact forces on itself is warned of", "[checks]") {
  const auto grains = [](const char* radius) {
    return std::string("objects:\n  - {name: grains, contact_offset: ") + radius + ", shape: {type: points, size: [0.1, 0, 0], counts: [2, 1, 1]}, particle: {radius: " + radius +
           "}, energies: [particle]}\ncontact: {distance: 1 mm}\n";
  };
  CHECK_THAT(first_text(warnings(grains("49.8 mm")), WarningKind::self_contact_force), Contains("'grains'"));
  CHECK_FALSE(warned(warnings(grains("49 mm")), WarningKind::self_contact_force));
}
