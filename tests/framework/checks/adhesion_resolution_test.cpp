#include "framework/checks/adhesion_resolution.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/world/world.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/warnings.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

constexpr double length = 0.01, distance = 1e-4;  // m: of the plate; where its adhesion peaks, with half its range

// A plate over a wide one, tilted about an edge that is `gap` above it.
std::string tilted(double degrees, int cells, double gap = 0.7 * distance) {
  const double tilt = degrees * std::numbers::pi / 180;
  return fmt::format(
      "objects:\n"
      "  - {{name: lower, shape: {{type: box, size: [0.04, 0.002, 0.04], cells: [2, 1, 2]}}, place: {{translate: [0, -0.001, 0]}}, motion: [fixed]}}\n"
      "  - {{name: upper, shape: {{type: box, size: [0.01, 0.002, 0.01], cells: [{0}, 1, {0}]}},\n"
      "     place: {{axis: [0, 0, 1], angle: {1} deg, translate: [{2}, {3}, 0]}}, body: {{type: affine, density: 1000}}}}\n"
      "contact: {{distance: {4}, pairs: [{{between: [upper, lower], integrate: upper, adhesion: {{type: fang, peak_traction: 1 kPa}}}}]}}\n",
      cells, degrees, -0.001 * std::sin(tilt), gap + 0.001 * std::cos(tilt) + length / 2 * std::sin(tilt), distance);
}

// Integral of the traction, which rises linearly to its peak and falls over an equal distance.
double exact(double degrees, double gap = 0.7 * distance) {
  const double slope = std::sin(degrees * std::numbers::pi / 180);
  double sum = 0;
  constexpr int parts = 20000;
  for (int i = 0; i < parts; ++i) {
    const double s = (gap + (i + 0.5) / parts * length * slope) / distance;
    sum += s < 1 ? s : std::max(0.0, 2 - s);
  }
  return 1000 * length * length * sum / parts;
}

struct Adhered {
  VecX forces;  // on all vertices, at the start [N]
  std::vector<Warning> warnings;
};
Adhered adhered(const std::string& yaml) {
  TestScene scene(yaml);
  World& world = *scene.world;
  world.contact->begin_step({world.start.x});
  world.contact->move_to(world.start.x);
  AdhesionResolution resolution(scene.config, world);
  resolution.examine(world.start.x, 1);
  return {contact_term(world).forces(world.start.x, LawTerm::adhesion), resolution.warnings()};
}
// Over the exact one, across the lower plate; that on it comes first.
double pull(const Adhered& adhered, double degrees) {
  double sum = 0;
  for (int v = 0; 3 * v < adhered.forces.size(); ++v) sum += std::abs(adhered.forces(3 * v + 1)) / 2;
  return sum / exact(degrees);
}

}  // namespace

TEST_CASE("adhesion on elements across which the gap changes by much of its range is warned of", "[contact]") {
  const Adhered coarse = adhered(tilted(10, 26));  // just smaller than twice the range
  CHECK(std::abs(pull(coarse, 10) - 1) > 0.1);
  CHECK(contains(only_text(coarse.warnings, WarningKind::coarse_adhesion), "where 'upper' adhered to 'lower', the gap changed by more than a quarter of the range"));
  INFO(coarse.warnings[0].text);
  CHECK(contains(coarse.warnings[0].text, "elements of 0.0002"));  // no more than a quarter of the range over sin(10 degrees), 0.29 mm
}

TEST_CASE("adhesion on elements of the recommended size is right and gives no warning, nor on elements above twice the range", "[contact]") {
  for (const auto& [degrees, cells] : {std::pair(5, 24), std::pair(5, 8), std::pair(5, 2), std::pair(1, 8), std::pair(0, 2)}) {
    INFO(degrees << " degrees, " << cells << " cells");
    const Adhered fine = adhered(tilted(degrees, cells));
    CHECK(fine.warnings.empty());
    CHECK(pull(fine, degrees) == Approx(1).epsilon(0.02));
  }
}

TEST_CASE("adhesion where ridges cross between vertices is warned of", "[contact]") {
  // Two bars on an edge each, the one across the other.
  const auto ridges = [](int cells) {
    return fmt::format(
        "objects:\n"
        "  - {{name: low, shape: {{type: box, size: [0.1, 0.01, 0.01], cells: [{0}, {1}, {1}]}}, place: {{axis: [1, 0, 0], angle: 45 deg, translate: [0.003, 0, 0]}}, motion: [fixed]}}\n"
        "  - {{name: high, shape: {{type: box, size: [0.01, 0.01, 0.1], cells: [{1}, {1}, {0}]}}, place: {{axis: [0, 0, 1], angle: 45 deg, translate: [0, {2}, 0.002]}},\n"
        "     body: {{type: affine, density: 1000}}}}\n"
        "contact: {{distance: 0.5 mm, pairs: [{{between: [high, low], adhesion: {{type: fang, peak_traction: 1 kPa}}}}]}}\n",
        10 * cells, cells, 0.01 * std::sqrt(2.0) + 1e-4);
  };
  const auto warnings = adhered(ridges(1)).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "the gap changed by more than a quarter of the range"));
}
