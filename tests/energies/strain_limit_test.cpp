// Strain limit of sheets: its energy against its formula, and no state at or beyond the limit.
#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/scene/energy.hpp"
#include "geometry/errors.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

TEST_CASE("strain limit: nothing before its start, its formula up to the limit, infinity from there on", "[shells]") {
  const SheetBody sheet(Vec2(0.1, 0.07), {3, 2}, 1e-3, 0.2);
  const auto term = component<Energy>("{type: strain_limit, strain: 0.1, start: 0.8, stiffness: 1e5}")->make_term(sheet.body, sheet.rest);
  const auto at = [&](double s, double r) { return term->value(sheet.mapped([&](const Vec3& x) { return Vec3(s * x.x(), 0, r * x.z()); })) / sheet.volume; };
  CHECK(at(1, 1) == 0);
  CHECK(at(0.3, 1.0799) == 0);
  const auto barrier = [](double s) {
    const double y = (s - 1.08) / 0.02;
    return y > 0 ? -1e5 * y * y * std::log(1 - y) : 0;
  };
  for (const double s : {1.085, 1.09, 1.0999})
    for (const double r : {0.5, 1.0, 1.095}) {
      CHECK(at(s, r) == Approx(barrier(s) + barrier(r)).epsilon(1e-9));
      CHECK(at(r, s) == Approx(barrier(s) + barrier(r)).epsilon(1e-9));
    }
  for (const double s : {1.1000001, 1.2, 50.0}) CHECK(std::isinf(at(s, 1)));
}

TEST_CASE("strain limit: gradient and Hessian are those of the value, and the Hessian is semi-definite", "[shells]") {
  const SheetBody sheet(Vec2(0.1, 0.07), {3, 2}, 1e-3, 0.2);
  const auto term = component<Energy>("{type: strain_limit, strain: 0.5, start: 0.2, stiffness: 1e5}")->make_term(sheet.body, sheet.rest);
  RandomMotions random(4);
  for (int trial = 0; trial < 6; ++trial) {
    const Mat3 turn = random.rotation();
    const double shear = 0.05 * trial;
    VecX x = sheet.mapped([&](const Vec3& r) { return Vec3(turn * Vec3(1.25 * r.x() + shear * r.z(), 0, 1.2 * r.z())); });
    x += 2e-4 * random.vectors(x.size());
    REQUIRE(term->value(x) > 0);
    REQUIRE(std::isfinite(term->value(x)));
    const VecX gradient = dense_gradient(*term, x), direction = random.vectors(x.size());
    const MatX hessian = dense_hessian(*term, x, Projection::none);
    const double h = 1e-7;
    const VecX up = x + h * direction, down = x - h * direction;
    CHECK((term->value(up) - term->value(down)) / (2 * h) == Approx(gradient.dot(direction)).epsilon(1e-5));
    const VecX change = (dense_gradient(*term, up) - dense_gradient(*term, down)) / (2 * h);
    CHECK((change - hessian * direction).norm() <= 1e-5 * change.norm());
    const double largest = hessian.cwiseAbs().maxCoeff();
    CHECK(Eigen::SelfAdjointEigenSolver<MatX>(dense_hessian(*term, x, Projection::clamp)).eigenvalues().minCoeff() >= -1e-9 * largest);
    // A rigid motion changes nothing.
    VecX moved = x;
    for (int v = 0; v < sheet.body.vertex_count; ++v) vertex(moved, v) = turn * Vec3(vertex(x, v)) + Vec3(0.1, 0.2, 0.3);
    CHECK(term->value(moved) == Approx(term->value(x)).epsilon(1e-9));
  }
}

TEST_CASE("strain limit: needs a sheet", "[shells]") {
  const TetBody box(Vec3(0.1, 0.1, 0.1), {1, 1, 1}, Elements::linear);
  CHECK_THROWS_AS(component<Energy>("{type: strain_limit, strain: 0.1, stiffness: 1e5}")->make_term(box.body, box.rest), InputError);
}
