// Fibres of Holzapfel, Gasser and Ogden: closed forms at a point, derivatives, tension alone, directions, refusals.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/core/records.hpp"
#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double k1 = 2e4, k2 = 1.7;  // Pa, 1
const Vec3 one(1, 2, -1), two(0, 1, 1);

std::string fibres(double kappa, const std::string& families = "[{direction: [1, 2, -1]}, {direction: [0, 1, 1]}]") {
  return fmt::format("{{type: hgo_fibres, k1: {}, k2: {}, kappa: {}, families: {}}}", k1, k2, kappa, families);
}

// psi and its derivative by F of a family along d, in solids.
double strain(const Mat3& f, const Vec3& d, double kappa) {
  return kappa * (f.squaredNorm() - 3) + (1 - 3 * kappa) * ((f * d.normalized()).squaredNorm() - 1);
}
double density(const Mat3& f, const Vec3& d, double kappa) {
  const double e = std::max(strain(f, d, kappa), 0.0);
  return k1 / (2 * k2) * std::expm1(k2 * e * e);
}
Mat3 stress(const Mat3& f, const Vec3& d, double kappa) {  // first Piola-Kirchhoff
  const double e = std::max(strain(f, d, kappa), 0.0);
  const Vec3 n = d.normalized();
  return k1 * e * std::exp(k2 * e * e) * 2 * f * (kappa * Mat3::Identity() + (1 - 3 * kappa) * n * n.transpose());
}

const auto kinds = {Elements::linear, Elements::patches, Elements::composite};

}  // namespace

TEST_CASE("fibres have the energy and the stress of the closed form, in all elements", "[hyperelastic][fibres]") {
  RandomMotions random(2);
  for (const Elements kind : kinds)
    for (const double kappa : {0.0, 0.1, 1.0 / 3}) {
      const TetBody box(Vec3(0.1, 0.07, 0.05), {1, 1, 1}, kind);
      const auto term = component<Energy>(fibres(kappa))->make_term(box.body, box.rest);
      for (int trial = 0; trial < 10; ++trial) {
        const Vec3 s(random.uniform(0.7, 1.5), random.uniform(0.7, 1.5), random.uniform(0.7, 1.5));
        const Mat3 f = random.rotation() * s.asDiagonal() * random.rotation().transpose();
        const VecX x = box.deformed(f);
        CHECK(term->value(x) / box.volume == Approx(density(f, one, kappa) + density(f, two, kappa)).epsilon(1e-10).margin(1e-9));
        const VecX gradient = dense_gradient(*term, x);
        Mat3 sum = Mat3::Zero();
        for (int v = 0; v < box.body.vertex_count; ++v) sum += Vec3(vertex(gradient, v)) * Vec3(vertex(box.rest, v)).transpose();
        const Mat3 expected = stress(f, one, kappa) + stress(f, two, kappa);
        CHECK((sum / box.volume - expected).norm() <= 1e-10 * expected.norm() + 1e-9);
        Records records;
        records.publish(*term);
        REQUIRE(records.stresses().size() == 1);
        for (const Mat3& sigma : records.stresses().front().values(x)) CHECK((sigma - expected * f.transpose() / f.determinant()).norm() <= 1e-10 * expected.norm() + 1e-9);
      }
    }
}

TEST_CASE("fibres: derivatives agree with differences and are positive semi-definite", "[hyperelastic][fibres]") {
  RandomMotions random(4);
  const auto check = [&](const Term& term, const VecX& x) {
    const VecX gradient = dense_gradient(term, x);
    const MatX hessian = dense_hessian(term, x, Projection::none);
    CHECK((gradient - gradient_by_differences([&](const VecX& y) { return term.value(y); }, x, 1e-6)).norm() < 1e-8 * gradient.norm());
    CHECK((hessian - hessian_by_differences([&](const VecX& y) { return dense_gradient(term, y); }, x, 1e-6)).norm() < 1e-7 * hessian.norm());
    for_each_stencil_hessian(term, x, Projection::none, [&](const MatX& m, const int*) { CHECK(smallest_eigenvalue(m) >= -1e-12 * m.norm()); });
    CHECK((dense_hessian(term, x, Projection::clamp) - hessian).norm() == 0);
  };
  const Mat3 f = Vec3(1.3, 1.2, 1.1).asDiagonal();
  for (const double kappa : {0.0, 0.2}) {
    for (const Elements kind : kinds) {
      const TetBody box(Vec3(0.1, 0.07, 0.05), {2, 1, 1}, kind);
      check(*component<Energy>(fibres(kappa))->make_term(box.body, box.rest), box.deformed(random.rotation() * f) + 1e-3 * random.vectors(box.rest.size()));
    }
    const SheetBody sheet(Vec2(0.1, 0.08), {3, 2}, 1e-3, 0.1);
    const Mat3 turn = random.rotation();
    check(*component<Energy>(fibres(kappa))->make_term(sheet.body, sheet.rest), sheet.mapped([&](const Vec3& x) { return Vec3(turn * f * x); }) + 1e-3 * random.vectors(sheet.rest.size()));
  }
}

TEST_CASE("fibres of sheets are dispersed in their plane", "[hyperelastic][fibres][shells]") {
  const SheetBody sheet(Vec2(0.1, 0.08), {3, 2}, 1e-3, 0.1);  // in y = 0
  for (const double kappa : {0.0, 0.3, 0.5}) {
    const auto term = component<Energy>(fibres(kappa, "[{direction: [3, 7, 4]}]"))->make_term(sheet.body, sheet.rest);
    const double a = 1.3, b = 1.1, i4 = a * a * 9 / 25 + b * b * 16 / 25, e = kappa * (a * a + b * b - 2) + (1 - 2 * kappa) * (i4 - 1);
    const VecX x = sheet.mapped([&](const Vec3& p) { return Vec3(a * p.x(), 0, b * p.z()); });
    CHECK(term->value(x) / sheet.volume == Approx(k1 / (2 * k2) * std::expm1(k2 * e * e)).epsilon(1e-10));
  }
}

TEST_CASE("fibres do not resist compression, and wind about an axis", "[hyperelastic][fibres]") {
  const TetBody box(Vec3(0.1, 0.07, 0.05), {1, 1, 1});
  const auto along = component<Energy>(fibres(0, "[{direction: [1, 0, 0]}]"))->make_term(box.body, box.rest);
  CHECK(along->value(box.deformed(Vec3(0.8, 1.2, 1.1).asDiagonal())) == 0);
  CHECK(dense_hessian(*along, box.deformed(Vec3(0.8, 1.2, 1.1).asDiagonal()), Projection::none).norm() == 0);
  CHECK(along->value(box.deformed(Vec3(1.2, 0.8, 0.8).asDiagonal())) > 0);
  // Far from an axis along z, through (-100, 0, 0), "around" is y.
  for (const double angle : {0.0, 0.5, -0.5}) {
    const auto helix = component<Energy>(fibres(0, fmt::format("[{{axis: [0, 0, 2], through: [-100, 0, 0], angle: {}}}]", angle)))->make_term(box.body, box.rest);
    const Mat3 f = Mat3(Vec3(0.9, 1.2, 1.3).asDiagonal()) + 0.2 * Vec3::UnitY() * Vec3::UnitZ().transpose();
    CHECK(helix->value(box.deformed(f)) / box.volume == Approx(density(f, Vec3(0, std::cos(angle), std::sin(angle)), 0)).epsilon(3e-3));
  }
}

TEST_CASE("fibres that have no direction are refused", "[hyperelastic][fibres]") {
  const SheetBody sheet(Vec2(0.1, 0.08), {3, 2}, 1e-3);
  const TetBody box(Vec3(0.1, 0.07, 0.05), {1, 1, 1});
  CHECK_THROWS_WITH(component<Energy>(fibres(0, "[{direction: [0, 1, 0]}]"))->make_term(sheet.body, sheet.rest), Catch::Contains("have no direction in triangle 0"));
  CHECK_THROWS_WITH(component<Energy>(fibres(0.4))->make_term(box.body, box.rest), Catch::Contains("1/3 is isotropic"));
  CHECK_THROWS_WITH(component<Energy>(fibres(0, "[{}]")), Catch::Contains("give one of the two"));
  CHECK_THROWS_WITH(component<Energy>(fibres(0, "[{direction: [0, 0, 0]}]")), Catch::Contains("must not be zero"));
  CHECK_THROWS_WITH(component<Energy>(fibres(0, "[]")), Catch::Contains("families"));
  CHECK_THROWS_WITH(component<Energy>(fibres(0))->make_term(Body(), VecX()), Catch::Contains("hgo_fibres"));
}
