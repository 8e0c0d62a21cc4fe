// The potential of a step is a continuous function of positions, and no area counts twice.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "framework/contact/terms/contact_term.hpp"
#include "tests/framework/contact/barrier_and_fang.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

TEST_CASE("contact integral: within a step the energy is one function, whichever triangles come near at any time", "[contact]") {
  // A sheet, tilted about its left edge, comes down on another one, across whose mesh its own lies.
  const double side = 0.04, height = 1.2e-3;
  for (const auto& [cells, other] : {std::pair(8, 11), std::pair(20, 13), std::pair(7, 30)})
    for (const double opening : {0.08, 0.3})
      for (const char* integrates : {"upper", "lower", "automatic", "both"}) {
        const auto sheet = [&](const char* name, int n, double y) {
          return fmt::format("  - {{name: {0}, shape: {{type: grid, size: [{1}, {1}], cells: [{2}, {2}]}}, shell: {{thickness: 0.1 mm}},\n"
                             "     place: {{translate: [0, {3}, 0]}}, energies: [{{type: neo_hookean_membrane, young: 1e5}}]}}\n", name, side, n, y);
        };
        TestScene scene("objects:\n" + sheet("upper", cells, height) + sheet("lower", other, 0) +
                        contact(fmt::format("between: [upper, lower], integrate: {}{}", integrates, sticks)));
        World& world = *scene.world;
        const auto at = [&](double angle) {
          VecX x = world.rest;
          for (int v = 0; v < world.bodies[0].vertex_count; ++v) {
            const double along = world.rest[3 * v] + side / 2;
            vertex(x, v) = Vec3(along * std::cos(angle) - side / 2, height + along * std::sin(angle), world.rest[3 * v + 2]);
          }
          return x;
        };
        world.contact->begin_step({at(opening)});
        const int n = 400;
        double before = 0, slope_before = 0, least = 0, worst = 0;
        for (int i = 0; i <= n; ++i) {
          const double angle = opening * (1 - i / static_cast<double>(n));
          const VecX x = at(angle);
          world.contact->move_to(x);
          const double value = contact_term(world).value(x);
          const double slope = dense_gradient(contact_term(world), x).dot((at(angle - 1e-6) - at(angle + 1e-6)) / 2e-6) * opening / n;
          if (i > 0) worst = std::max(worst, std::abs(value - before - (slope + slope_before) / 2));
          before = value;
          slope_before = slope;
          least = std::min(least, value);
        }
        INFO(cells << " cells on " << other << ", opening " << opening << ", integrates: " << integrates << ": " << worst / -least);
        CHECK(worst <= 2e-3 * -least);
        // A region that comes near later counts its area once, not both from samples and from its
        // corners: the area of the sheet at the start of the step.
        const double all = side * side * std::cos(opening) * laws_at(height).value;
        CHECK(before == Approx(all).epsilon(std::string(integrates) == "upper" && opening < 0.1 ? 1e-6 : 0.12));
      }
}

TEST_CASE("contact integral: fixed vertices of a sheet cause no jump when the other vertices move", "[contact]") {
  // Two equal sheets, vertex over vertex, the left halves held: what a held vertex is nearest to is now an edge that moves at its other end, now the held
  // vertex itself.
  const auto sheet = [](const char* name, double y) {
    return fmt::format("  - {{name: {}, shape: {{type: grid, size: [0.04, 0.04], cells: [4, 4], jitter: 0.2, seed: 3}}, shell: {{thickness: 0.1 mm}},\n"
                       "     place: {{translate: [0, {}, 0]}}, energies: [{{type: neo_hookean_membrane, young: 1e5}}]}}\n", name, y);
  };
  TestScene scene("objects:\n" + sheet("upper", gap) + sheet("lower", 0) + contact("between: [upper, lower], integrate: both" + sticks));
  World& world = *scene.world;
  std::vector<char> free(world.rest.size() / 3);
  for (size_t v = 0; v < free.size(); ++v) free[v] = world.rest[3 * v] > 1e-3;
  world.contact->set_free(free);
  world.contact->begin_step({world.rest});
  RandomMotions random(11);
  for (int k = 0; k < 30; ++k) {
    VecX p = 1e-9 * random.vectors(world.rest.size());
    for (size_t v = 0; v < free.size(); ++v)
      if (!free[v]) vertex(p, v).setZero();
    const auto value = [&](double s) {
      world.contact->move_to(world.rest + s * p);
      return contact_term(world).value(world.rest + s * p);
    };
    const double before = value(-1), after = value(1);
    CHECK(after == Approx(before).epsilon(1e-5));
  }
}
