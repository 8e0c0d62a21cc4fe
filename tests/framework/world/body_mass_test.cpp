// Masses of bodies: scalar dofs, which have an inertia, count for nothing.
#include "framework/world/body_mass.hpp"

#include <catch2/catch.hpp>

#include "framework/experiment/time_scales.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

TEST_CASE("masses of bodies are without the twists of rods", "[world]") {
  const TestScene scene(
      "time: {step: 1e-2, duration: 1e-2}\n"
      "objects:\n"
      "  - {name: cube, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 1 MPa, density: 1000}]}\n"
      "  - {name: rod, shape: {type: helix, radius: 0.1, pitch: 0.1, turns: 2, edges: 64}, place: {translate: [1, 0, 0]}, rod: {radius: 5 mm},\n"
      "     energies: [{type: elastic_rod, young: 1 MPa, density: 1000}]}\n"
      "  - {name: stone, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [2, 0, 0]}, body: {type: affine, density: 2000}}\n"
      "  - {name: floor, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -1, 0]}, motion: [fixed]}\n");
  const std::vector<double> masses = body_masses(*scene.world);
  REQUIRE(masses.size() == 4);
  CHECK(masses[0] == Approx(1));
  CHECK(masses[1] == Approx(0.09978).epsilon(1e-4));  // pi r^2 times the length of the edges
  CHECK(masses[2] == Approx(2));
  CHECK(masses[3] == 0);
  double with_twists = 0;
  for (const int v : scene.world->vertices_of(1)) with_twists += scene.world->mass(v);
  CHECK(with_twists > 1.5 * masses[1]);  // the test would be void otherwise
  CHECK(*wave_time(scene.config, *scene.world, 0) == Approx(0.1 * std::sqrt(1000 / 1e6)));
  CHECK_FALSE(wave_time(scene.config, *scene.world, 1));  // no tets
}
