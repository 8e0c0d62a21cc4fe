// Default barriers and safety barriers of pairs of objects.
#include <catch2/catch.hpp>
#include <array>
#include <cmath>
#include <fmt/format.h>

#include "framework/contact/contact_system.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

// A cube of 0.1 m that flies at a floor.
std::string flying(double young, double speed, double turned = 0, const std::string& gravity = "", const std::string& contact = "") {
  return fmt::format(
      "{}objects:\n"
      "  - {{name: cube, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}}, place: {{axis: [0.3, 0.5, 0.2], angle: {}, translate: [0, 0.2, 0]}},\n"
      "     velocity: [0, {}, 0], energies: [{{type: neo_hookean, young: {}, poisson: 0.3, density: 500}}]}}\n"
      "  - {{name: floor, shape: {{type: box, size: [0.3, 0.1, 0.3]}}, place: {{translate: [0, -0.05, 0]}}, motion: [fixed]}}\n"
      "contact: {{distance: 1 mm{}}}\n",
      gravity, turned, -speed, young, contact);
}

// A sheet of 0.2 x 0.1 m and 1 kg/m^2 that flies at a floor in steps of 10 ms.
std::string sheet(const char* young, double speed, const std::string& rest = "", const char* pulled = "") {
  return fmt::format(
      "{2}time: {{step: 10 ms}}\n"
      "objects:\n"
      "  - {{name: sheet, shape: {{type: grid, size: [0.2, 0.1], cells: [2, 2]}}, place: {{translate: [0, 0.2, 0]}}, shell: {{thickness: 1 mm}},\n"
      "     velocity: [0, {1}, 0], energies: [{{type: neo_hookean_membrane, young: {0}, poisson: 0.3, density: 1000}}]{3}}}\n"
      "  - {{name: floor, shape: {{type: box, size: [0.3, 0.1, 0.3]}}, place: {{translate: [0, -0.05, 0]}}, motion: [fixed]}}\n"
      "contact: {{distance: 1 mm}}\n",
      young, -speed, rest, pulled);
}

// Inverted from the barrier's traction at half the contact distance of 1 mm.
double barrier_of(const std::string& text) {
  const TestScene scene(text);
  const PairTable& pairs = scene.world->contact->pairs();
  const double traction = -pairs.laws()[pairs.point(0, 1).law].at(0.5e-3).slope;
  return traction / (std::log(2.0) + 0.5);
}

template <class... Of>
double stiffness(const Of&... of) {
  return barrier_of(flying(of...));
}

// Returns ranges of safety barriers in contact distances: of edge pairs, and of points.
template <class... Of>
std::array<double, 2> guards(const Of&... of) {
  const TestScene scene(flying(of...));
  const PairTable& pairs = scene.world->contact->pairs();
  return {pairs.edge(0, 1).range / 1e-3, pairs.point(0, 1).safety_barrier_range / 1e-3};
}

}  // namespace

TEST_CASE("the barrier is a tenth as stiff as the softer body", "[contact][barrier]") {
  CHECK(stiffness(1e6, 0) == Approx(1e5));
  CHECK(stiffness(1e6, 10) == Approx(1e5));  // of 1 MPa, waves run at 45 m/s
  CHECK(stiffness(1e4, 4) == Approx(1e3));   // and at 4.5 m/s of 10 kPa
}

TEST_CASE("the barrier carries the dynamic pressure of a soft body faster than its elastic waves", "[contact][barrier]") {
  CHECK(stiffness(1e4, 6) == Approx(0.1 * 500 * 36));
  CHECK(stiffness(1e4, 10) == Approx(0.1 * 500 * 100));
  CHECK(stiffness(1e4, 100) == Approx(1e4));  // the modulus at most
  CHECK(stiffness(1e6, 100) == Approx(0.1 * 500 * 1e4));
  CHECK(stiffness(1e4, 10, 1.234) == stiffness(1e4, 10));  // for any orientation
  CHECK(stiffness(1e4, 0, 0, "gravity: [0, -200, 0]\n") == Approx(0.1 * 500 * 2 * 200 * 0.35));  // a fall over the whole scene
  CHECK(stiffness(1e4, 100, 0, "", ", barrier: {stiffness: 3 kPa}") == Approx(3e3));
}

TEST_CASE("the safety barrier of a body faster than its elastic waves acts over the whole contact distance", "[contact][barrier]") {
  using Ranges = std::array<double, 2>;
  CHECK(guards(1e4, 4) == Ranges{0.5, 0.5});
  CHECK(guards(1e4, 6) == Ranges{1, 1});
  CHECK(guards(1e4, 0, 0, "gravity: [0, -200, 0]\n") == Ranges{1, 1});
  CHECK(guards(1e4, 6, 0, "", ", safety_barrier: 0.25") == Ranges{0.25, 0.25});
  CHECK(guards(1e4, 6, 0, "", ", barrier: {stiffness: 3 kPa}") == Ranges{1, 1});
}

TEST_CASE("the barrier of a sheet scales with the contact pressure, not with its material", "[contact][barrier][shell]") {
  CHECK(barrier_of(sheet("10 kPa", 2)) == Approx(1e3));  // a soft one presses with what its material can
  // 1 kg/m^2 that 10 ms stop at 2 m/s press with 200 Pa; a strain of 1e-3 around a tenth of sqrt(0.02) m with 71 Pa per MPa.
  CHECK(barrier_of(sheet("100 MPa", 2)) == Approx(100 * 200 + 7071).epsilon(0.02));
  CHECK(barrier_of(sheet("1 GPa", 2)) == Approx(100 * 200 + 70711).epsilon(0.02));
  CHECK(barrier_of(sheet("100 MPa", 20)) == Approx(100 * 2000 + 7071).epsilon(0.02));
  // With gravity: an impact after a fall over the 0.5 m of the scene, and a weight of 10 Pa.
  const double fall = std::sqrt(2 * 10 * (0.2 + 0.1));
  CHECK(barrier_of(sheet("100 MPa", 0, "gravity: [0, -10, 0]\n")) == Approx(100 * (100 * fall + 10) + 7071).epsilon(0.02));
}

TEST_CASE("a sheet that a motion, a load or a spring may stretch has a barrier by its material", "[contact][barrier][shell]") {
  CHECK(barrier_of(sheet("100 MPa", 2, "", ",\n     motion: [{type: fixed, until: 1 s, select: {type: face, direction: [1, 0, 0]}}]")) == Approx(1e7));
  CHECK(barrier_of(sheet("100 MPa", 2, "", ",\n     loads: [{type: pressure, value: 1 kPa}]")) == Approx(1e7));
  CHECK(barrier_of(sheet("100 MPa", 2, "interactions:\n  - {type: spring, from: {object: sheet, select: {type: indices, vertices: [0]}}, to: {object: floor}, stiffness: 1 N/m}\n")) == Approx(1e7));
}

TEST_CASE("copies of a sheet have one barrier in any orientation", "[contact][barrier][shell]") {
  const TestScene scene("gravity: [0, -10, 0]\n"
                        "objects:\n"
                        "  - {name: sheet, shape: {type: grid, size: [4 cm, 3 cm], cells: [2, 2]}, shell: {thickness: 0.1 mm}, place: {axis: [1, 2, 3], angle: 33 deg},\n"
                        "     energies: [{type: neo_hookean_membrane, young: 3 GPa, poisson: 0.3, density: 800}],\n"
                        "     fill: {region: {type: box, size: [0.4, 0.4, 0.4]}, count: 6, clearance: 5 mm}}\n"
                        "contact: {distance: 1 mm}\n");
  const PairTable& pairs = scene.world->contact->pairs();
  for (int other = 2; other < 6; ++other) CHECK(pairs.point(0, other).law == pairs.point(0, 1).law);
}
