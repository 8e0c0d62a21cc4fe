// Relaxation of the weights of rods and particles: oscillations decay, steady changes do not lag,
// and soft bodies come to rest on rods.
#include "framework/contact/area_integral/weight_relaxation.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "framework/contact/contact_system.hpp"
#include "framework/world/world.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

constexpr int point = 7, triangle = 3;

// Returns the relaxed weight of a step whose new weight is `weight`, and updates the lagged weights.
double relaxed(double weight, LaggedWeights& lagged, double distance = 0.5, const Vec3& normal = Vec3::UnitY()) {
  std::vector<TriangleWeight> weights{{weight, normal, Vec3::Zero(), false, distance}};
  LaggedWeights now;
  relax_weights(point, std::array{triangle}, 1, lagged, weights, now);
  lagged = now;
  return weights[0].weight;
}

// Soft blocks under rods that they adhere to, beside which their edges lie.
std::string under_rods(int rods, double spacing, const std::string& block) {
  std::string objects, pairs;
  for (int i = 0; i < rods; ++i) {
    objects += fmt::format("  - {{name: rod{}, shape: {{type: segment, length: 40 mm, edges: 8}}, place: {{translate: [0, 0, {} mm]}}, rod: {{radius: 1 mm}}, "
                           "contact_offset: 1 mm, motion: [fixed]}}\n", i, (i - (rods - 1) / 2.0) * spacing);
    pairs += fmt::format("{}{{between: [rod{}, block], adhesion: {{type: fang, peak_traction: 30 kPa}}, tangential_adhesion: {{mu: 0.5}}}}", i > 0 ? ", " : "", i);
  }
  return fmt::format("time: {{step: 5 ms, duration: 0.4 s}}\ngravity: [0, -9.81, 0]\nobjects:\n{}  - {{name: block, {}, velocity: [0, 0.2, 0], damping: {{mass: 30}}}}\n"
                     "contact:\n  distance: 1.5 mm\n  friction: {{mu: 0.3, eps_v: 5 mm/s}}\n  pairs: [{}]\n", objects, block, pairs);
}

std::string block(const std::string& shape, const std::string& place, double young) {
  return fmt::format("shape: {{type: box, {}}}, place: {{{}}}, energies: [{{type: neo_hookean, young: {}, poisson: 0.4, density: 1000}}]", shape, place, young);
}

}  // namespace

TEST_CASE("a weight that overshoots in every step converges", "[contact][codimensional]") {
  for (const double slope : {0.5, 1.5, 4.0, 9.0, 40.0}) {
    LaggedWeights lagged;
    double weight = relaxed(0.52, lagged);
    for (int step = 0; step < 12; ++step) weight = relaxed(0.5 - slope * (weight - 0.5) / (1 + 4 * std::abs(weight - 0.5)), lagged);
    INFO(slope);
    CHECK(weight == Approx(0.5).margin(1e-6));
  }
}

TEST_CASE("relaxation finds the fixed point of a linear map in the third step, and stays there", "[contact][codimensional]") {
  for (const double slope : {-0.2, -0.7, -1.0, -3.0, -20.0})
    for (const double fixed_point : {0.3, 0.6}) {
      const auto map = [&](double weight) { return fixed_point + slope * (weight - fixed_point); };
      LaggedWeights lagged;
      double weight = relaxed(fixed_point + 0.01, lagged);
      for (int step = 1; step < 3; ++step) weight = relaxed(map(weight), lagged);
      INFO(slope);
      CHECK(weight == Approx(fixed_point).epsilon(1e-9));
      weight = relaxed(map(weight), lagged);
      CHECK(weight == Approx(fixed_point).epsilon(1e-9));
    }
}

TEST_CASE("weights of several triangles are relaxed by one factor, so that their ratio is kept", "[contact][codimensional]") {
  LaggedWeights lagged, now;
  std::array<double, 2> found{};
  double swing = 0.1;
  for (int step = 0; step < 4; ++step, swing = -swing) {
    std::vector<TriangleWeight> weights{{0.5 + swing, Vec3::UnitY(), Vec3::Zero(), false, 0.5}, {0.4 + 0.5 * swing, Vec3::UnitY(), Vec3::Zero(), false, 0.5}};
    now.clear();
    relax_weights(point, std::array{3, 8}, 1, lagged, weights, now);
    lagged = now;
    found = {weights[0].weight, weights[1].weight};
  }
  CHECK(found[0] != 0.6);
  CHECK(found[0] - 0.5 == Approx(2 * (found[1] - 0.4)).margin(1e-12));
}

TEST_CASE("pins the bounds of relaxation: one hundredth at least, and a fifth more from step to step", "[contact][codimensional]") {
  LaggedWeights lagged;
  double weight = 0;
  for (const double target : {0.5, 0.6, -60.0}) weight = relaxed(target, lagged);  // a swing of 600 times its cause
  CHECK(weight == Approx(0.6 - 0.01 * 60.6));
  // From there it creeps on in one direction: the factor grows by a fifth at most.
  double factor = 0.01;
  for (int step = 0; step < 5; ++step) {
    const double target = weight - 1;
    const double next = relaxed(target, lagged);
    factor *= 1.2;
    CHECK(weight - next <= factor * (1 + 1e-9));
    weight = next;
  }
}

TEST_CASE("weights that change in one direction are not relaxed, nor are weights of new triangles", "[contact][codimensional]") {
  LaggedWeights lagged;
  for (int step = 0; step < 10; ++step) CHECK(relaxed(0.1 + 0.07 * step + 0.001 * step * step, lagged) == 0.1 + 0.07 * step + 0.001 * step * step);
  CHECK(relaxed(0.2, lagged) > 0.4);  // turns back
  CHECK(lagged.size() == 1);
  CHECK(relaxed(0.3, lagged, 1.5) == 0.3);
  CHECK(lagged.empty());
  CHECK(relaxed(0.9, lagged) == 0.9);
}

TEST_CASE("normals are relaxed with the weights", "[contact][codimensional]") {
  const auto at = [](double angle) { return Vec3(std::sin(angle), std::cos(angle), 0); };
  std::vector<TriangleWeight> weights;
  LaggedWeights lagged, now;
  for (const double angle : {0.0, 0.2, -0.2}) {
    weights = {{1, at(angle), Vec3::Zero(), false, 0.5}};
    now.clear();
    relax_weights(point, std::array{triangle}, 1, lagged, weights, now);
    lagged = now;
  }
  CHECK(weights[0].normal.norm() == Approx(1));
  CHECK(weights[0].normal.x() > -0.1);
  CHECK(weights[0].normal.x() < 0.15);
  CHECK(weights[0].weight == 1);
}

TEST_CASE("lagged weights are stored by the indices of triangles in their object", "[contact][codimensional]") {
  const TestScene scene(under_rods(1, 4, block("size: [8 mm, 8 mm, 8 mm], cells: [1, 1, 1]", "translate: [0, -8 mm, 0]", 1e4)));
  const CollisionMesh& mesh = scene.world->contact->surface().mesh;
  const LaggedWeights lagged{{1, 2, {0.5, 0, 1, 0}, {0.1, 0, 0.2, 0}, 0.3}, {1, 5, {0.6, 1, 0, 0}, {}, 1}, {4, 2, {0.7, 0, 0, 1}, {}, 1}};
  History history;
  store_weights(lagged, mesh, history);
  const LaggedWeights again = weights_of(history, mesh);
  REQUIRE(again.size() == 3);
  for (size_t i = 0; i < 3; ++i) {
    CHECK(again[i].point == lagged[i].point);
    CHECK(again[i].triangle == lagged[i].triangle);
    CHECK(again[i].values == lagged[i].values);
    CHECK(again[i].change == lagged[i].change);
    CHECK(again[i].factor == lagged[i].factor);
  }
  history.begin()->second.values[0] = 1e6;
  CHECK_THROWS(weights_of(history, mesh));
  store_weights({}, mesh, history);
  CHECK(history.empty());
}

TEST_CASE("soft blocks come to rest on rods beside which their edges lie", "[contact][codimensional]") {
  for (const std::string& yaml :
       {under_rods(2, 10, block("size: [16 mm, 8 mm, 8 mm], cells: [2, 1, 1]", "translate: [-0.52 mm, -8.5 mm, 3.13 mm], axis: [-0.15, 1.246, 0.012], angle: 0.249", 8000)),
        under_rods(3, 4, block("size: [6 mm, 16 mm, 6 mm], cells: [1, 2, 1]", "translate: [1.52 mm, -12.5 mm, -2.19 mm], axis: [-1.86, 0.187, -0.611], angle: 0.161", 3000)),
        under_rods(2, 4, block("size: [16 mm, 10 mm, 10 mm], cells: [2, 1, 1]", "translate: [-1.98 mm, -9.5 mm, -0.47 mm], axis: [-2.401, 1.358, -0.787], angle: 0.139", 3000))}) {
    TestRun run(yaml);
    double areas = 0, adhesion = 0;
    for (int step = 0; step < 80; ++step) {
      const StepReport report = run.step();
      if (step >= 60) areas += std::abs(report.flows.areas);
      adhesion = contact_term(*run.world).value(run.state().x);
    }
    INFO(yaml);
    CHECK(adhesion < -1e-4);
    CHECK(areas < 0.02 * std::abs(adhesion));  // half to all of it if rounding chooses the nearer one of two triangles
  }
}
