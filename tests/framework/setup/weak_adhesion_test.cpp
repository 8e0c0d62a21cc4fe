// The default barrier beside adhesion that is weaker than the contact pressure.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/output/used_stiffness.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

// Returns the barrier stiffness [Pa] between a floor and a block of 1.96 N, that is 280 Pa on a quarter of its surface.
double barrier(double peak) {
  const TestScene scene(fmt::format(
      "time: {{step: 5 ms, duration: 0.2}}\ngravity: [0, -9.81, 0]\n"
      "objects:\n"
      "  - {{name: floor, shape: {{type: box, size: [0.4, 0.02, 0.2]}}, place: {{translate: [0, -0.01, 0]}}, motion: [fixed]}}\n"
      "  - {{name: block, shape: {{type: box, size: [0.1, 0.02, 0.1]}}, place: {{translate: [0, 0.0109, 0]}}, energies: [{{type: neo_hookean, young: 0.5 MPa, density: 1000}}]}}\n"
      "contact:\n  distance: 1 mm\n  pairs: [{{between: [block, floor], adhesion: {{type: fang, peak_traction: {}}}}}]\n", peak));
  for (const auto& b : used_stiffness(*scene.world).barriers)
    if (b.between[0] != b.between[1]) return b.stiffness;
  return 0;
}

}  // namespace

TEST_CASE("with vanishing adhesion, the barrier carries the contact pressure", "[setup]") {
  for (const double peak : {1e-6, 1e-3, 1.0}) {
    INFO(peak);
    CHECK(barrier(peak) == Approx(280).epsilon(0.05));
  }
  // Continuous, and as ever where adhesion is felt.
  for (double peak = 1; peak < 200; peak *= 1.2) CHECK(std::abs(barrier(1.2 * peak) - barrier(peak)) <= 2.5 * peak);
  CHECK(barrier(28) == Approx(0.05 * 28));
  CHECK(barrier(1e4) == Approx(0.05 * 1e4));
}
