// Overhangs: energy, forces, the way to the boundary of the own surface, and surfaces of one size that come to rest.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/contact/area_integral/overhang_term.hpp"
#include "framework/contact/area_integral/own_boundary.hpp"
#include "tests/support/contact_terms.hpp"
#include "tests/support/published.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A soft block that adheres to a fixed one of the same width, shifted by `shift` [m].
std::string blocks(std::array<double, 2> shift, const std::string& time, const std::string& more = "", std::array<int, 2> cells = {3, 2}) {
  return fmt::format(
      "time: {{{0}}}\n"
      "objects:\n"
      "  - {{name: base, shape: {{type: box, size: [0.006, 0.002, 0.006], cells: [{5}, 1, {5}]}}, place: {{translate: [0, -0.001, 0]}}, motion: [fixed]}}\n"
      "  - name: block\n"
      "    shape: {{type: box, size: [0.006, 0.002, 0.006], cells: [{4}, 1, {4}]}}\n"
      "    place: {{translate: [{1}, 0.0013, {2}]}}\n"
      "    energies: [{{type: neo_hookean, young: 400 kPa, poisson: 0.3, density: 1000}}]\n{3}"
      "contact:\n  distance: 0.5 mm\n"
      "  pairs: [{{between: [base, block], adhesion: {{type: fang, peak_traction: 2 kPa}}}}]\n",
      time, shift[0], shift[1], more, cells[0], cells[1]);
}

const std::string damped = "    damping: {mass: 100}\n";

}  // namespace

TEST_CASE("overhang: slope and curvature are those of the energy, which is even and convex", "[contact][overlap_boundary]") {
  const Overhang o{0, 1, {}, {}, 2.0, 0.3, 0.1};
  CHECK(o.value(0.3) == 0);
  for (const double w : {-0.5, -0.08, -0.03, 0.0, 0.04, 0.09, 0.2, 0.7}) {
    const double step = 1e-6;
    CHECK(o.slope(w) == Approx((o.value(w + step) - o.value(w - step)) / (2 * step)).margin(1e-8));
    CHECK(o.curvature(w) == Approx((o.slope(w + step) - o.slope(w - step)) / (2 * step)).margin(1e-8));
    CHECK(o.value(w) == Approx(o.value(-w)).margin(1e-15));
    CHECK(o.curvature(w) >= 0);
  }
  CHECK(o.slope(0.1) == 2);
}

TEST_CASE("overhang: the way to the boundary of a surface crosses its triangles", "[contact][overlap_boundary]") {
  TestScene scene("objects:\n  - {name: a, shape: {type: box, size: [3, 1, 3], cells: [3, 1, 3]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
                  "  - {name: b, shape: {type: box, size: [3, 1, 3]}, place: {translate: [0, 1.05, 0]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
                  "contact: {distance: 0.1}\n");
  const World& world = *scene.world;
  const ContactSurface& surface = world.contact->surface();
  LaggedSurface lagged(surface);
  lagged.update(world.rest);
  const Vec3 down(0, -1, 0);  // normal of the surface opposite to the top of a
  int checked = 0;
  for (size_t t = 0; t < surface.mesh.triangles.size(); ++t) {
    const Triangle& triangle = surface.mesh.triangles[t];
    if (surface.mesh.vertex_object[triangle[0]] != 0 || lagged.cosine(static_cast<int>(t), down) < 0.9) continue;
    const Vec3 inside(0.3, 0.25, 0.45);
    const auto at = corners(world.rest, triangle);
    const Vec3 p = inside[0] * at[0] + inside[1] * at[1] + inside[2] * at[2];
    for (const double angle : {0.0, 0.2, 0.7, 1.4, 2.9, 4.6}) {
      const Vec3 direction(std::cos(angle), 0, std::sin(angle));
      double expected = 1e9;
      int bounding = 0;
      for (const int axis : {0, 2})
        if (const double to_line = ((direction[axis] > 0 ? 1.5 : -1.5) - p[axis]) / direction[axis]; direction[axis] != 0 && to_line < expected) expected = to_line, bounding = axis;
      if (std::abs(direction[2 - bounding]) > 0.2588) expected = INFINITY;  // the boundary is not aligned
      INFO("triangle " << t << ", angle " << angle);
      const double way = way_to_boundary(surface.mesh, lagged, {static_cast<int>(t), inside}, direction, down, 10);
      if (std::isinf(expected)) CHECK(std::isinf(way));
      else CHECK(way == Approx(expected).epsilon(1e-9));
      CHECK((way_to_boundary(surface.mesh, lagged, {static_cast<int>(t), inside}, direction, down, 0.4) > 0.4) == (expected > 0.4));
      ++checked;
    }
  }
  CHECK(checked == 108);
}

TEST_CASE("overhang: forces are minus the gradient of the energy, without net force and moment", "[contact][overlap_boundary]") {
  TestScene scene(blocks({0.00004, 0.00011}, "step: 1 ms"));
  World& world = *scene.world;
  const VecX x = world.rest;
  world.participants.begin_step({x, 0, 1e-3});
  world.participants.move_to(x);
  const OverhangTerm& term = *find_contact_term<OverhangTerm>(world);
  REQUIRE(term.batches().front().count > 0);
  VecX d = VecX::Zero(x.size());
  for (Eigen::Index i = 0; i < d.size(); ++i) d[i] = std::sin(1.0 + 3.0 * static_cast<double>(i));
  // Within and beyond the softened part, on both sides.
  for (const double moved : {0.0, 0.00006, -0.00008, 0.0004}) {
    VecX at = x;
    for (int v = 0; v < static_cast<int>(x.size()) / 3; ++v)
      if (world.contact->surface().mesh.vertex_object[v] == 1) at(3 * v) += moved;
    const VecX f = Published(term).forces(at);
    REQUIRE(f.norm() > 0);
    const double step = 1e-9;
    CHECK(-f.dot(d) == Approx((term.value(at + step * d) - term.value(at - step * d)) / (2 * step)).epsilon(1e-5));
    Vec3 sum = Vec3::Zero();
    for (int v = 0; v < f.size() / 3; ++v) sum += vertex(f, v);
    CHECK(sum.norm() < 1e-12 * f.norm());
  }
}

TEST_CASE("overhang: nearly aligned blocks come to rest", "[contact][overlap_boundary]") {
  // With a constant force of each step they are shaken for ever: 0.06 m/s.
  for (const std::array<double, 2> shift : {std::array{1e-6, 2e-6}, std::array{1.5e-4, 1e-4}}) {
    TestRun run(blocks(shift, "step: 1 ms, duration: 0.15 s", damped));
    for (int step = 0; step < 150; ++step) run.step();
    INFO("shifts " << shift[0] << " and " << shift[1]);
    CHECK(run.state().v.lpNorm<Eigen::Infinity>() < 1e-4);
  }
}

TEST_CASE("overhang: nearly aligned blocks settle without inertia", "[contact][overlap_boundary]") {
  // Nothing but adhesion keeps the block from sliding. With a constant force of each step, all four fail within 12 steps.
  struct Case {
    std::array<double, 2> shift;
    std::array<int, 2> cells;
  };
  for (const auto& [shift, cells] : {Case{{1e-6, 2e-6}, {3, 2}}, Case{{1.5e-4, 1e-4}, {3, 2}}, Case{{1.5e-3, 7e-4}, {3, 2}}, Case{{1.5e-4, 1e-4}, {2, 2}}}) {
    INFO("shifts " << shift[0] << " and " << shift[1] << ", cells " << cells[0] << " on " << cells[1]);
    TestRun run(blocks(shift, "step: 50 ms, duration: 2 s, integrator: quasi_static", "", cells));
    for (int step = 0; step < 20; ++step) run.step();
    const VecX before = run.state().x;
    run.step();
    CHECK((run.state().x - before).lpNorm<Eigen::Infinity>() < 1e-6);
  }
}
