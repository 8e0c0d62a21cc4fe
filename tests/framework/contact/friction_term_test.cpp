#include "framework/contact/terms/friction_term.hpp"

#include <catch2/catch.hpp>

#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/three_boxes.hpp"

using namespace tack;

namespace {

// Three small boxes around each other, askew, with every law on.
const std::string cluster = [] {
  const std::string laws = "adhesion: {type: fang, young: 1e3, critical_strain: 0.5},\n"
                           "     friction: {mu: 0.4, eps_v: 2e-3}, tangential_adhesion: {mu: 0.8, eps_a: 1e-3}}";
  return three_boxes() +
         "contact:\n  distance: 0.025\n  safety_barrier: 1\n  friction: {mu: 0.7}\n"
         "  barrier: {type: clamped_log, stiffness: 1e3}\n"
         "  pairs:\n   - {between: [a, b], " + laws + "\n   - {between: [b, c], integrate: both, " + laws + "\n";
}();

// A step of size h in which every vertex moves by about `slip`.
struct Cluster {
  Cluster(double h, double slip) : scene(cluster) {
    RandomMotions random(5);
    start = scene.world->rest + 1e-3 * random.vectors(scene.world->rest.size());
    x = start + slip * random.vectors(start.size());
    system().begin_step({start});
    system().move_to(start);
    term().begin_step({start, 0, h});
    term().lag(start);
  }
  ContactSystem& system() { return *scene.world->contact; }
  FrictionTerm& term() { return *scene.world->friction; }

  TestScene scene;
  VecX start, x;
};

// Slips from far below eps h = 1e-3 m to far above 2 eps h, in the step's size 0.5 s.
const std::vector<double> slips = {1e-6, 2e-4, 7e-4, 1.5e-3, 1e-2};

}  // namespace

TEST_CASE("friction term: gradient and Hessian are those of the value", "[friction]") {
  for (const double slip : slips) {
    INFO("slip " << slip);
    Cluster c(0.5, slip);
    CHECK(c.term().points().of<2>().size() > 0);
    CHECK(c.term().points().of<3>().size() > 0);
    CHECK(c.term().points().of<4>().size() > 20);
    const VecX gradient = dense_gradient(c.term(), c.x);
    const MatX hessian = dense_hessian(c.term(), c.x, Projection::none);
    const VecX slopes = gradient_by_differences([&](const VecX& y) { return c.term().value(y); }, c.x, 1e-8);
    const MatX curvatures =
        hessian_by_differences([&](const VecX& y) { return dense_gradient(c.term(), y); }, c.x, 1e-9);
    CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-6 * gradient.lpNorm<Eigen::Infinity>());
    CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-5 * hessian.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("friction term: the closed-form projection is equal to the numerical one", "[friction]") {
  for (const double slip : slips) {
    Cluster c(0.5, slip);
    for (const Projection projection : {Projection::clamp, Projection::absolute}) {
      std::vector<MatX> expected;
      bool concave = false;
      for_each_stencil_hessian(c.term(), c.x, Projection::none, [&](const MatX& h, const int*) {
        concave = concave || smallest_eigenvalue(h) < -1e-6 * h.norm();
        expected.push_back(projected(h, projection));
      });
      size_t i = 0;
      for_each_stencil_hessian(c.term(), c.x, projection, [&](const MatX& h, const int*) {
        CHECK((h - expected[i]).cwiseAbs().maxCoeff() <= 1e-9 * (1e-300 + expected[i].cwiseAbs().maxCoeff()));
        ++i;
      });
      if (slip == 1.5e-3) CHECK(concave);  // beyond its peak, tangential adhesion is
    }
  }
}

TEST_CASE("friction term: a common translation, start included, changes nothing", "[friction]") {
  Cluster c(0.5, 7e-4);
  const double value = c.term().value(c.x);
  const VecX gradient = dense_gradient(c.term(), c.x);
  CHECK(value > 0);
  VecX shift(c.x.size());
  for (int v = 0; v < shift.size() / 3; ++v) vertex(shift, v) = Vec3(0.3, -0.2, 0.1);
  CHECK(c.term().value(c.x + shift) == Approx(value).epsilon(1e-9));
  CHECK((dense_gradient(c.term(), c.x + shift) - gradient).norm() <= 1e-9 * gradient.norm());
}

TEST_CASE("friction term: forces add up to zero, and terms and pairs to the total", "[friction]") {
  Cluster c(0.5, 7e-4);
  const VecX all = c.term().forces(c.x, TangentialTerm::all);
  CHECK(all.norm() > 0);
  CHECK(total(all).norm() <= 1e-12 * all.norm());
  CHECK((all + dense_gradient(c.term(), c.x)).norm() <= 1e-12 * all.norm());
  const VecX parts = c.term().forces(c.x, TangentialTerm::friction) + c.term().forces(c.x, TangentialTerm::adhesion);
  CHECK((all - parts).norm() <= 1e-12 * all.norm());
  VecX pairs = VecX::Zero(all.size());
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) pairs += c.term().forces(c.x, TangentialTerm::all, ObjectPair{a, b});
  CHECK((all - pairs).norm() <= 1e-12 * all.norm());
  const Vec3 action = c.term().force_between(c.x, TangentialTerm::all, {0, 1});
  CHECK((action + c.term().force_between(c.x, TangentialTerm::all, {1, 0})).norm() <= 1e-12 * all.norm());
}

TEST_CASE("friction term: the slip of a step is measured in eps h", "[friction]") {
  Cluster whole(0.5, 7e-4), half(0.25, 7e-4);
  const VecX shorter = half.start + (half.x - half.start) / 2;
  const VecX force = whole.term().forces(whole.x, TangentialTerm::all);
  CHECK((force - half.term().forces(shorter, TangentialTerm::all)).norm() <= 1e-12 * force.norm());
}

TEST_CASE("friction term: the residual is the change of forces by another lag", "[friction]") {
  Cluster c(0.5, 7e-4);
  CHECK(c.term().residual(c.start) == 0);  // no slip, no force
  c.system().move_to(c.x);
  const VecX before = c.term().forces(c.x, TangentialTerm::all);
  const double residual = c.term().residual(c.x);
  c.term().lag(c.x);
  const VecX after = c.term().forces(c.x, TangentialTerm::all);
  double largest = 0, difference = 0;
  for (int v = 0; v < c.x.size() / 3; ++v) {
    largest = std::max({largest, vertex(before, v).norm(), vertex(after, v).norm()});
    difference = std::max(difference, vertex(VecX(before - after), v).norm());
  }
  CHECK(difference > 0);
  CHECK(residual == Approx(difference / largest));
  CHECK(c.term().residual(c.x) == 0);
}

TEST_CASE("friction term: contact points and normal forces of two objects are replaced, and those of others are kept", "[friction]") {
  Cluster c(0.5, 7e-4);
  const auto between = [&](int a, int b, TangentialTerm part = TangentialTerm::all) { return c.term().forces(c.x, part, ObjectPair{a, b}); };
  const auto differ = [](const VecX& f, const VecX& g) { return (f - g).norm() / f.norm(); };
  const VecX before01 = between(0, 1), before12 = between(1, 2);
  c.system().move_to(c.x);
  const ContactPoints now = c.term().lagged_at(c.x);
  c.term().replace_points(now, {{0, 1}});
  const VecX anew01 = between(0, 1);
  CHECK(differ(anew01, before01) > 1e-3);
  CHECK(differ(before12, between(1, 2)) <= 1e-14);

  const FrictionTerm::PairForces held = c.term().normal_forces(), own = c.term().normal_forces(now);
  CHECK(held.at({0, 1}) == Approx(own.at({0, 1})));
  CHECK(std::abs(held.at({1, 2}) - own.at({1, 2})) > 1e-3 * own.at({1, 2}));
  c.term().lag(c.x);
  CHECK(differ(anew01, between(0, 1)) <= 1e-14);
  CHECK(differ(before12, between(1, 2)) > 1e-3);

  const VecX friction = between(0, 1, TangentialTerm::friction), adhesion = between(0, 1, TangentialTerm::adhesion), other = between(1, 2);
  c.term().scale_normal_forces({{{0, 1}, 0.25}});
  CHECK(differ(0.25 * friction, between(0, 1, TangentialTerm::friction)) <= 1e-14);
  CHECK(differ(adhesion, between(0, 1, TangentialTerm::adhesion)) <= 1e-14);
  CHECK(differ(other, between(1, 2)) <= 1e-14);
  CHECK(c.term().normal_forces().at({0, 1}) == Approx(0.25 * own.at({0, 1})));
}
