// Friction that differs across the grain of a surface, and coefficients of surfaces: derivatives, a
// grain that turns with its body, the direction of sliding, blends, refusals.
#include "framework/contact/points/grain.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/contact/terms/friction_term.hpp"
#include "framework/scene/friction_config.hpp"
#include "geometry/errors.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/three_boxes.hpp"

using namespace tack;

namespace {

// Three boxes of which the second one has a grain, lagged at x.
struct Grained {
  explicit Grained(const std::string& friction = "mu: 0.2, mu_across: 0.6, eps_v: 2e-3")
      : scene(with_grain(three_boxes()) + "contact:\n  distance: 0.025\n  safety_barrier: 1\n  barrier: {type: clamped_log, stiffness: 1e3}\n"
                                          "  pairs:\n   - {between: [a, b], friction: {" + friction + "}}\n") {
    RandomMotions random(5);
    start = scene.world->rest + 1e-3 * random.vectors(scene.world->rest.size());
    x = start + 7e-4 * random.vectors(start.size());
    begin(start);
  }
  static std::string with_grain(std::string objects) {
    const std::string b = "{name: b, ";
    return objects.insert(objects.find(b) + b.size(), "grain: [1, 0.2, 0], ");
  }
  void begin(const VecX& at) {
    scene.world->contact->begin_step({at});
    scene.world->contact->move_to(at);
    scene.world->friction->begin_step({at, 0, 0.5});
    scene.world->friction->lag(at);
  }
  FrictionTerm& term() { return *scene.world->friction; }

  TestScene scene;
  VecX start, x;
};

}  // namespace

TEST_CASE("friction across a grain: gradient and Hessian are those of the value", "[friction][grain]") {
  for (const std::string friction : {"mu: 0.2, mu_across: 0.6, eps_v: 2e-3", "mu: 0.6, mu_across: 0.2, mu_static: 0.9, model: stick, elastic_slip: 1e-3"}) {
    Grained c(friction);
    const VecX gradient = dense_gradient(c.term(), c.x);
    CHECK(gradient.norm() > 0);
    const MatX hessian = dense_hessian(c.term(), c.x, Projection::none);
    const VecX slopes = gradient_by_differences([&](const VecX& y) { return c.term().value(y); }, c.x, 1e-8);
    const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(c.term(), y); }, c.x, 1e-9);
    CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-6 * gradient.lpNorm<Eigen::Infinity>());
    CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-5 * hessian.cwiseAbs().maxCoeff());
    for_each_stencil_hessian(c.term(), c.x, Projection::clamp, [&](const MatX& h, const int*) { CHECK(smallest_eigenvalue(h) >= -1e-9 * h.norm()); });
  }
}

TEST_CASE("a grain turns with its body", "[friction][grain]") {
  Grained c;
  std::vector<Vec3> before;
  for_each_record(c.term().points(), [&](const auto& p) {
    before.push_back(p.tangents.col(0));
    CHECK(p.tangents.col(1).norm() == Approx(3));
    CHECK(std::abs(p.tangents.col(0).dot(p.tangents.col(1))) <= 1e-12);
  });
  REQUIRE(!before.empty());
  const Mat3 turn = Eigen::AngleAxisd(1.2, Vec3(0.3, 1, -0.4).normalized()).toRotationMatrix();
  VecX turned = c.start;
  for (int v = 0; v < turned.size() / 3; ++v) vertex(turned, v) = turn * vertex(c.start, v);
  c.begin(turned);
  size_t i = 0;
  for_each_record(c.term().points(), [&](const auto& p) {
    REQUIRE(i < before.size());
    CHECK((p.tangents.col(0) - turn * before[i]).norm() <= 1e-9);
    ++i;
  });
  CHECK(i == before.size());
}

TEST_CASE("friction of two surfaces blends their coefficients, unless their pair names its own", "[friction][grain]") {
  CHECK(blended(FrictionBlend::geometric, 0.2, 0.8) == Approx(0.4));
  CHECK(blended(FrictionBlend::arithmetic, 0.2, 0.8) == Approx(0.5));
  CHECK(blended(FrictionBlend::harmonic, 0.2, 0.8) == Approx(0.32));
  CHECK(blended(FrictionBlend::harmonic, 0, 0) == 0);
  CHECK(blended(FrictionBlend::minimum, 0.2, 0.8) == 0.2);
  CHECK(blended(FrictionBlend::maximum, 0.2, 0.8) == 0.8);
  CHECK(blended(FrictionBlend::product, 0.2, 0.8) == Approx(0.16));
  std::string objects = three_boxes();
  for (const auto& [name, mu] : {std::pair{"a", 0.2}, {"b", 0.8}}) {
    const std::string at = fmt::format("{{name: {}, ", name);
    objects.insert(objects.find(at) + at.size(), fmt::format("friction: {}, ", mu));
  }
  const auto mu_of = [](const TestScene& scene, int a, int b) {
    const PairTable& pairs = scene.world->contact->pairs();
    return pairs.tangential(pairs.point(a, b).law).mu;
  };
  const TestScene blend(objects + "contact: {distance: 0.025, blend: maximum, friction: {mu: 0.3}}\n");
  CHECK(mu_of(blend, 0, 1) == 0.8);
  CHECK(mu_of(blend, 0, 2) == 0.3);  // c has no coefficient of its own
  const TestScene own(objects + "contact: {distance: 0.025, pairs: [{between: [a, b], friction: {mu: 0.1}}]}\n");
  CHECK(mu_of(own, 0, 1) == 0.1);
  CHECK(error_of<TestScene>(objects + "contact: {distance: 0.025, friction: {mu: 0.3, mu_static: 0.4}}\n").find("mu_static or mu_across") != std::string::npos);
  CHECK(error_of<TestScene>(objects).find("no contact") != std::string::npos);
}

TEST_CASE("friction across a grain refuses what it does not support", "[friction][grain]") {
  const std::string grained = Grained::with_grain(three_boxes());
  CHECK(error_of<TestScene>(three_boxes() + "contact: {pairs: [{between: [a, b], friction: {mu: 0.2, mu_across: 0.6}}]}\n").find("grain: [1, 0, 0]") != std::string::npos);
  CHECK(error_of<TestScene>(grained + "contact: {friction: {mu: 0.2}}\n").find("give friction mu_across") != std::string::npos);
  CHECK(error_of<TestScene>(grained + "contact: {friction: {mu: 0, mu_across: 0.6}}\n").find("needs a mu above 0") != std::string::npos);
  std::string both = grained;
  both.insert(both.find("{name: a, ") + 10, "grain: [0, 0, 1], ");
  CHECK(error_of<TestScene>(both + "contact: {friction: {mu: 0.2, mu_across: 0.6}}\n").find("both have a grain") != std::string::npos);
  CHECK(error_of<TestScene>(grained + "contact: {pairs: [{between: [a, b], friction: {mu: 0.2, mu_across: 0.6}, adhesion: {type: fang, peak_traction: 1 kPa}, tangential_adhesion: {mu: 1}}]}\n")
            .find("the same in all directions") != std::string::npos);
}
