// Pairs of primitives of one object with a gap at rest: the angle and the path of rest_gaps.hpp, on
// shapes on either side of both limits.
#include "framework/contact/surface/rest_gaps.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "framework/contact/contact_system.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

bool has_gap(const std::string& shape) {
  const TestScene scene(fmt::format("objects:\n  - {{name: it, shape: {}, shell: {{thickness: 0.1 mm}}, energies: [{{type: stvk_membrane, young: 1 MPa, density: 1000}}]}}\n"
                                    "contact: {{distance: 4 mm}}\n", shape));
  const ContactSurface& surface = scene.world->contact->surface();
  if (!surface.rest_gaps) return false;
  for (const int v : surface.mesh.vertices)
    for (const Triangle& t : surface.mesh.triangles)
      if (std::find(t.begin(), t.end(), v) == t.end() && surface.rest_gaps->gap_between(std::array{v}, t)) return true;
  return false;
}

// Two leaves that meet in a crease: the path from one to the other is 1 / sin(angle / 2) of their distance.
bool crease(double degrees) {
  const double half = degrees / 2 * M_PI / 180;
  return has_gap(fmt::format("{{type: warped, of: {{type: grid, size: [0.04, 0.006], cells: [40, 6]}}, x: sqrt(x^2 + 1e-12) * {}, y: x * {}, z: z}}", std::cos(half), std::sin(half)));
}

// A flat ring that is cut, with its ends lifted apart: the line between them leaves the ring at that angle.
bool cut_ring(double degrees) {
  const double cut = 0.05, radius = 0.01, lift = cut * radius * std::tan(degrees * M_PI / 180);
  return has_gap(fmt::format("{{type: warped, of: {{type: grid, size: [{}, 0.002], cells: [60, 3]}}, x: ({} + z) * cos(x), y: {} * x, z: ({} + z) * sin(x)}}", 2 * M_PI - cut, radius,
                             lift / (2 * M_PI - cut), radius));
}

}  // namespace

TEST_CASE("pins the length of path over distance, three, from which a crease is a gap", "[contact][rest]") {
  for (const double neighbours : {120.0, 90.0, 60.0}) {  // 1.2, 1.4 and 2 distances
    INFO(neighbours);
    CHECK_FALSE(crease(neighbours));
  }
  for (const double gap : {25.0, 15.0}) {  // 4.6 and 7.7
    INFO(gap);
    CHECK(crease(gap));
  }
}

TEST_CASE("pins the angle to the surface, 45 degrees, from which a cut is a gap", "[contact][rest]") {
  for (const double neighbours : {0.0, 15.0, 30.0}) {
    INFO(neighbours);
    CHECK_FALSE(cut_ring(neighbours));
  }
  for (const double gap : {60.0, 75.0}) {
    INFO(gap);
    CHECK(cut_ring(gap));
  }
}
