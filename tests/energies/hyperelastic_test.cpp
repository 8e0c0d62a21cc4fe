// Hyperelastic solids at a point (a box that deforms homogeneously), against closed forms in isochoric stretches and against each other. Derivatives of
// their default settings: solids_test.cpp.
#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <functional>

#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

const std::string treloar_ogden =
    "type: ogden, terms: [{modulus: 0.63 MPa, exponent: 1.3}, {modulus: 0.0012 MPa, exponent: 5}, {modulus: -0.01 MPa, exponent: -2}]";

// A law, its energy in isochoric stretches and the shear modulus of small strains.
struct Law {
  std::string yaml;
  std::function<double(const Vec3&)> energy;
  double shear;  // Pa
};
double first(const Vec3& s) { return s.squaredNorm() - 3; }
double second(const Vec3& s) { return s.cwiseInverse().squaredNorm() - 3; }
double power_sum(const Vec3& s, double a) { return s.array().pow(a).sum() - 3; }

const std::vector<Law> laws = {
    {"type: mooney_rivlin, c10: 0.15 MPa, c01: 0.02 MPa", [](const Vec3& s) { return 0.15e6 * first(s) + 0.02e6 * second(s); }, 0.34e6},
    {"type: yeoh, c10: 0.2 MPa, c20: -2 kPa, c30: 80 Pa",
     [](const Vec3& s) { return first(s) * (0.2e6 + first(s) * (-2e3 + first(s) * 80)); }, 0.4e6},
    {treloar_ogden,
     [](const Vec3& s) {
       return 0.63e6 / 1.3 * power_sum(s, 1.3) + 0.0012e6 / 5 * power_sum(s, 5) + 0.01e6 / 2 * power_sum(s, -2);
     },
     (0.63e6 * 1.3 + 0.0012e6 * 5 + 0.01e6 * 2) / 2},
    {"type: gent, shear_modulus: 0.3 MPa, j_m: 80", [](const Vec3& s) { return -0.3e6 * 40 * std::log(1 - first(s) / 80); }, 0.3e6}};

class Point {
 public:
  explicit Point(const std::string& yaml, double poisson, Elements elements = Elements::linear)
      : box_(Vec3(0.1, 0.07, 0.05), {1, 1, 1}, elements), energy_(component<Energy>(fmt::format("{{{}, poisson: {}}}", yaml, poisson))),
        term_(energy_->make_term(box_.body, box_.rest)) {}

  const Energy& energy() const { return *energy_; }
  const Term& term() const { return *term_; }
  const TetBody& box() const { return box_; }
  double density(const Mat3& f) const { return term_->value(box_.deformed(f)) / box_.volume; }

  // First Piola-Kirchhoff stress: sum_v dE/dx_v X_v^T = V P.
  Mat3 stress(const Mat3& f) const {
    const VecX gradient = dense_gradient(*term_, box_.deformed(f));
    Mat3 sum = Mat3::Zero();
    for (int v = 0; v < box_.body.vertex_count; ++v) sum += Vec3(vertex(gradient, v)) * Vec3(vertex(box_.rest, v)).transpose();
    return sum / box_.volume;
  }
  // Nominal stress along x at stretches(a, b), where b leaves z free of stress: bisection.
  double free_stress(const std::function<Vec3(double)>& stretches, double low, double high) const {
    for (int i = 0; i < 80; ++i) {
      const double b = (low + high) / 2;
      (stress(stretches(b).asDiagonal())(2, 2) > 0 ? high : low) = b;
    }
    return stress(stretches((low + high) / 2).asDiagonal())(0, 0);
  }

 private:
  TetBody box_;
  std::unique_ptr<Energy> energy_;
  std::unique_ptr<Term> term_;
};

constexpr std::array<Elements, 3> all_elements = {Elements::linear, Elements::composite, Elements::patches};

std::string error_of(const std::string& yaml) {
  try {
    component<Energy>("{" + yaml + "}");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Nominal stress of an incompressible material: d/da of W(stretches(a)), divided by the number of directions that are pulled.
double incompressible_stress(const Law& law, const std::function<Vec3(double)>& stretches, int directions, double a) {
  const double h = 1e-4 * a;
  return central_difference([&](double d) { return law.energy(stretches(a + d)); }, h) / directions;
}

}  // namespace

TEST_CASE("hyperelastic solids have the energy of the formula, in all elements", "[hyperelastic]") {
  RandomMotions random(8);
  for (const Law& law : laws)
    for (const Elements elements : all_elements) {
      INFO(law.yaml << ", elements " << static_cast<int>(elements));
      for (const double nu : {-0.3, 0.3, 0.4999}) {
        const Point point(law.yaml, nu, elements);
        const double bulk = 2 * law.shear * (1 + nu) / (3 * (1 - 2 * nu));
        for (int trial = 0; trial < 20; ++trial) {
          const Vec3 s(random.uniform(0.4, 2.5), random.uniform(0.4, 2.5), random.uniform(0.4, 2.5));
          const double log_j = std::log(s.prod());
          const Mat3 f = random.rotation() * s.asDiagonal() * random.rotation().transpose();
          CHECK(point.density(f) == Approx(law.energy(s / std::cbrt(s.prod())) + bulk / 2 * log_j * log_j).epsilon(1e-11));
        }
      }
    }
}

// The shear strain energy of tiny strains is mu |dev e|^2 to first order; rounding of F alone leaves about 1e-16 / strain.
TEST_CASE("tiny strains have an accurate energy", "[hyperelastic]") {
  for (const Law& law : laws)
    for (const Elements elements : all_elements) {
      INFO(law.yaml << ", elements " << static_cast<int>(elements));
      const Point point(law.yaml, 0.3, elements);
      for (const double strain : {1e-3, 1e-5, 1e-7}) {
        Mat3 f = Mat3::Identity();
        f(0, 0) += strain, f(1, 1) -= strain;
        const double bulk_part = law.shear * 1.3 / (3 * 0.4) * strain * strain * strain * strain;  // ln J = -strain^2
        CHECK(point.density(f) == Approx(2 * law.shear * strain * strain + bulk_part).epsilon(3 * strain * strain * 20 + 4e-15 / strain));
      }
    }
}

TEST_CASE("hyperelastic solids have the small-strain moduli that scale contact", "[hyperelastic]") {
  for (const Law& law : laws)
    for (const double nu : {0.2, 0.49}) {
      INFO(law.yaml << ", nu = " << nu);
      const Point point(law.yaml, nu);
      CHECK(point.energy().young() == Approx(2 * law.shear * (1 + nu)));
      CHECK(point.energy().poisson() == Approx(nu));
      constexpr double e = 1e-5;
      const Mat3 identity = Mat3::Identity();
      Mat3 shear = Mat3::Zero();
      shear(0, 1) = e;
      CHECK(((point.stress(identity + shear) - point.stress(identity - shear)) / (2 * e))(0, 1) == Approx(law.shear).epsilon(1e-7));
      const Mat3 swollen = (point.stress((1 + e) * identity) - point.stress((1 - e) * identity)) / (2 * e);
      CHECK(swollen.trace() / 9 == Approx(2 * law.shear * (1 + nu) / (3 * (1 - 2 * nu))).epsilon(1e-7));
    }
}

TEST_CASE("derivatives of hyperelastic solids are those of the value, also at tiny strains and near the limit", "[hyperelastic]") {
  RandomMotions random(5);
  for (const Law& law : laws)
    for (const Elements elements : all_elements) {
      INFO(law.yaml << ", elements " << static_cast<int>(elements));
      const Point point(law.yaml, 0.45, elements);
      for (const Vec3& s : {Vec3(1 + 1e-8, 1, 1 - 1e-8), Vec3(1.01, 1, 0.99), Vec3(5, 0.45, 0.45), Vec3(3, 3, 0.11), Vec3(0.2, 2.2, 2.2)}) {
        INFO("stretches " << s.transpose());
        const Mat3 f = random.rotation() * s.asDiagonal() * random.rotation().transpose();
        const VecX x = point.box().deformed(f) + 1e-4 * s.minCoeff() * random.vectors(point.box().rest.size());
        const VecX gradient = dense_gradient(point.term(), x);
        const MatX hessian = dense_hessian(point.term(), x, Projection::none);
        const double stiffness = hessian.cwiseAbs().maxCoeff(), step = 2e-6;
        const VecX slopes = gradient_by_differences([&](const VecX& y) { return point.term().value(y); }, x, step);
        const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(point.term(), y); }, x, step);
        CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-5 * stiffness * step + 1e-14 * std::abs(point.term().value(x)) / step);
        CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-6 * stiffness);
        for (const Projection projection : {Projection::clamp, Projection::absolute})
          for_each_stencil_hessian(point.term(), x, projection, [&](const MatX& h, const int*) {
            CHECK(smallest_eigenvalue(h) >= -1e-12 * h.cwiseAbs().maxCoeff());
          });
      }
    }
}

// The compressible solution differs from the incompressible one by stress over bulk modulus, so that the error falls with 1 - 2 nu.
TEST_CASE("uniaxial, equibiaxial and pure shear stresses are the closed forms of incompressible rubber", "[hyperelastic]") {
  struct Test {
    const char* name;
    int directions;
    std::function<Vec3(double)> incompressible;
    std::function<Vec3(double, double)> with_free;  // stretches by the free one
  };
  const std::vector<Test> tests = {
      {"uniaxial", 1, [](double a) { return Vec3(a, 1 / std::sqrt(a), 1 / std::sqrt(a)); }, [](double a, double b) { return Vec3(a, b, b); }},
      {"equibiaxial", 2, [](double a) { return Vec3(a, a, 1 / (a * a)); }, [](double a, double b) { return Vec3(a, a, b); }},
      {"pure shear", 1, [](double a) { return Vec3(a, 1, 1 / a); }, [](double a, double b) { return Vec3(a, 1, b); }}};
  for (const Law& law : laws)
    for (const Test& test : tests)
      for (const double a : {0.7, 1.5, 3.0}) {
        INFO(law.yaml << ", " << test.name << ", stretch " << a);
        const double expected = incompressible_stress(law, test.incompressible, test.directions, a);
        const auto error = [&](double nu) {
          const double b = test.incompressible(a)(2);
          const double found = Point(law.yaml, nu).free_stress([&](double s) { return test.with_free(a, s); }, 0.7 * b, 1.3 * b);
          return std::abs(found / expected - 1);
        };
        const double near = error(0.4999), farther = error(0.499);
        CHECK(near <= 4e-3);
        CHECK(near == Approx(farther / 10).epsilon(0.1).margin(1e-6));
      }
}

TEST_CASE("laws that include each other are equal", "[hyperelastic]") {
  RandomMotions random(9);
  const Point mooney("type: mooney_rivlin, c10: 0.2 MPa", 0.45), yeoh("type: yeoh, c10: 0.2 MPa", 0.45),
      ogden("type: ogden, terms: [{modulus: 0.4 MPa, exponent: 2}]", 0.45), gent("type: gent, shear_modulus: 0.4 MPa, j_m: 1e9", 0.45);
  const Point two("type: mooney_rivlin, c10: 0.2 MPa, c01: 0.05 MPa", 0.45),
      two_terms("type: ogden, terms: [{modulus: 0.4 MPa, exponent: 2}, {modulus: -0.1 MPa, exponent: -2}]", 0.45);
  for (int trial = 0; trial < 20; ++trial) {
    const Mat3 f = random.rotation() * Vec3(random.uniform(0.4, 3), random.uniform(0.4, 3), random.uniform(0.4, 3)).asDiagonal();
    const Mat3 expected = mooney.stress(f);
    CHECK((yeoh.stress(f) - expected).norm() <= 1e-12 * expected.norm());
    CHECK((ogden.stress(f) - expected).norm() <= 1e-12 * expected.norm());
    CHECK((gent.stress(f) - expected).norm() <= 1e-6 * expected.norm());
    CHECK((two_terms.stress(f) - two.stress(f)).norm() <= 1e-12 * two.stress(f).norm());
  }
}

// In tension J_m = 80 is used up at a^2 + 2/a = 83, a = 9.098.
TEST_CASE("a gent solid locks", "[hyperelastic]") {
  for (const Elements elements : all_elements) {
    const Point point("type: gent, shear_modulus: 0.3 MPa, j_m: 80", 0.3, elements);
    const auto bar = [](double a) -> Mat3 { return Vec3(a, 1 / std::sqrt(a), 1 / std::sqrt(a)).asDiagonal(); };
    double before = 0;
    for (const double a : {5.0, 8.0, 9.0, 9.09, 9.0979}) {
      const double stress = point.stress(bar(a))(0, 0);
      CHECK(stress > 1.5 * before);
      before = stress;
    }
    CHECK(before > 100 * 0.3e6);
    CHECK(std::isfinite(point.density(bar(9.0979))));
    CHECK(std::isinf(point.density(bar(9.0986))));
    CHECK(std::isinf(point.density(bar(20))));
  }
}

TEST_CASE("hyperelastic solids cannot be inverted or flattened", "[hyperelastic]") {
  for (const Law& law : laws)
    for (const Elements elements : all_elements) {
      const Point point(law.yaml, 0.3, elements);
      CHECK(std::isinf(point.density(Vec3(1, 1, -1).asDiagonal())));
      CHECK(std::isinf(point.density(Mat3(Vec3(1, 1, 0).asDiagonal()))));
      CHECK(point.density(Vec3(1, 1, 1e-2).asDiagonal()) > point.density(Vec3(1, 1, 0.1).asDiagonal()));
    }
}

TEST_CASE("hyperelastic parameters whose energy would fall without bound are refused", "[hyperelastic]") {
  CHECK(error_of("type: mooney_rivlin, c10: 0, c01: 1 kPa").empty());
  CHECK_THAT(error_of("type: mooney_rivlin, c10: 0"), Catch::Contains("shear modulus"));
  CHECK_THAT(error_of("type: mooney_rivlin, c10: 1 kPa, c01: -1 Pa"), Catch::Contains("c01"));
  CHECK_THAT(error_of("type: yeoh, c10: 1 kPa, c20: -1 Pa"), Catch::Contains("c30"));
  CHECK_THAT(error_of("type: gent, shear_modulus: 1 kPa, j_m: 0"), Catch::Contains("j_m"));
  CHECK_THAT(error_of("type: ogden, terms: []"), Catch::Contains("terms"));
  CHECK_THAT(error_of("type: ogden, terms: [{modulus: 1 kPa, exponent: 0}]"), Catch::Contains("exponent"));
  CHECK_THAT(error_of("type: ogden, terms: [{modulus: 1 kPa, exponent: -2}]"), Catch::Contains("shear modulus"));
  CHECK(error_of(treloar_ogden).empty());
  CHECK(error_of("type: ogden, terms: [{modulus: 1 kPa, exponent: 6}, {modulus: -10 Pa, exponent: 3}]").empty());  // 6 governs
  CHECK_THAT(error_of("type: ogden, terms: [{modulus: 1 kPa, exponent: 2}, {modulus: -10 Pa, exponent: 6}]"), Catch::Contains("without bound"));
  CHECK_THAT(error_of("type: ogden, terms: [{modulus: 1 kPa, exponent: 2}, {modulus: 10 Pa, exponent: -2}]"), Catch::Contains("without bound"));
}

// A cube whose vertices but the middle one are in pure shear: J_m = 20 is used up at the stretch 4.688.
TEST_CASE("a gent solid that is led beyond its limit is a clear error", "[hyperelastic][run]") {
  const auto run_to = [](double stretch) {
    TestRun run(fmt::format(R"(
time: {{step: 50 ms, duration: 1 s, integrator: quasi_static}}
objects:
  - name: cube
    shape: {{type: box, size: [2 cm, 2 cm, 2 cm], cells: [2, 2, 2]}}
    energies: [{{type: gent, shear_modulus: 0.3 MPa, j_m: 20}}]
    motion:
      - {{type: formula, x: {0} * t * X, y: -Y * {0} * t / (1 + {0} * t), select: {{type: formula, where: abs(x) + abs(y) + abs(z) > 1e-4}}}}
)", stretch - 1));
    while (run.state().time < 1 - 1e-9) run.step();
    return run.at(0).x() / run.rest(0).x();
  };
  CHECK(run_to(4.68) == Approx(4.68));
  CHECK_THROWS_WITH(run_to(4.70), Catch::Contains("prescribed motion deforms 'cube' too far"));
}
