// Rubber membranes against closed forms of incompressible rubber, and each other. Derivatives: shell_derivatives_test.cpp.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <functional>

#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

double first(const Vec3& s) { return s.squaredNorm() - 3; }
double second(const Vec3& s) { return s.cwiseInverse().squaredNorm() - 3; }
double power_sum(const Vec3& s, double a) { return s.array().pow(a).sum() - 3; }

struct Law {
  std::string yaml;
  std::function<double(const Vec3&)> energy;
  double shear;  // Pa
};
const std::vector<Law> laws = {
    {"{type: mooney_rivlin_membrane, c10: 0.15 MPa, c01: 0.02 MPa}", [](const Vec3& s) { return 0.15e6 * first(s) + 0.02e6 * second(s); }, 0.34e6},
    {"{type: yeoh_membrane, c10: 0.2 MPa, c20: -2 kPa, c30: 80 Pa}", [](const Vec3& s) { return first(s) * (0.2e6 + first(s) * (-2e3 + first(s) * 80)); }, 0.4e6},
    {"{type: ogden_membrane, terms: [{modulus: 0.63 MPa, exponent: 1.3}, {modulus: 0.0012 MPa, exponent: 5}, {modulus: -0.01 MPa, exponent: -2}]}",
     [](const Vec3& s) { return 0.63e6 / 1.3 * power_sum(s, 1.3) + 0.0012e6 / 5 * power_sum(s, 5) + 0.01e6 / 2 * power_sum(s, -2); }, (0.63e6 * 1.3 + 0.0012e6 * 5 + 0.01e6 * 2) / 2},
    {"{type: gent_membrane, shear_modulus: 0.3 MPa, j_m: 80}", [](const Vec3& s) { return -0.3e6 * 40 * std::log(1 - first(s) / 80); }, 0.3e6}};

// A sheet that is stretched by a and b.
struct Stretched {
  explicit Stretched(const std::string& yaml) : sheet(Vec2(0.1, 0.07), {2, 2}, 1e-3), energy(component<Energy>(yaml)), term(energy->make_term(sheet.body, sheet.rest)) {}
  VecX at(double a, double b) const {
    return sheet.mapped([&](const Vec3& x) { return Vec3(a * x.x(), 0, b * x.z()); });
  }
  double density(double a, double b) const { return term->value(at(a, b)) / sheet.volume; }
  // Nominal stress along x.
  double stress(double a, double b) const {
    const VecX gradient = dense_gradient(*term, at(a, b));
    double sum = 0;
    for (int v = 0; v < sheet.body.vertex_count; ++v) sum += gradient(3 * v) * sheet.rest(3 * v);
    return sum / sheet.volume;
  }
  SheetBody sheet;
  std::unique_ptr<Energy> energy;
  std::unique_ptr<Term> term;
};

}  // namespace

TEST_CASE("rubber membranes have the energy and the stresses of incompressible rubber", "[hyperelastic][shells]") {
  for (const Law& law : laws) {
    INFO(law.yaml);
    const Stretched sheet(law.yaml);
    CHECK(sheet.energy->shear() == Approx(law.shear));
    CHECK(sheet.energy->young() == Approx(3 * law.shear));
    for (const double a : {0.6, 1.0, 1.5, 3.0})
      for (const double b : {0.7, 1.0, 1.2, 2.5}) {
        const auto energy = [&](double s) { return law.energy(Vec3(s, b, 1 / (s * b))); };
        CHECK(sheet.density(a, b) == Approx(energy(a)).epsilon(1e-11).margin(1e-9));
        CHECK(sheet.stress(a, b) == Approx(central_difference([&](double d) { return energy(a + d); }, 1e-4 * a)).epsilon(1e-7).margin(1e-4));
      }
    const double a = 2;  // uniaxial: free across
    CHECK(sheet.stress(a, 1 / std::sqrt(a)) == Approx(central_difference([&](double d) { return law.energy(Vec3(a + d, 1 / std::sqrt(a + d), 1 / std::sqrt(a + d))); }, 1e-4)).epsilon(1e-6));
  }
}

TEST_CASE("a gent membrane locks, and a flat triangle has no finite energy", "[hyperelastic][shells]") {
  const Stretched sheet("{type: gent_membrane, shear_modulus: 0.3 MPa, j_m: 20}");
  const auto left = [](double a) { return 20 - (2 * a * a + std::pow(a, -4) - 3); };
  CHECK(left(3.39) > 0);
  CHECK(std::isfinite(sheet.density(3.39, 3.39)));
  CHECK(left(3.4) < 0);
  CHECK(std::isinf(sheet.density(3.4, 3.4)));
  for (const Law& law : laws) CHECK(std::isinf(Stretched(law.yaml).density(1.2, 0)));
}

TEST_CASE("rubber membranes are the limit of solids between free faces", "[hyperelastic][shells]") {
  const Stretched sheet("{type: yeoh_membrane, c10: 0.2 MPa, c20: 1 kPa}");
  const TetBody box(Vec3(0.1, 0.07, 0.05), {1, 1, 1});
  const auto solid = component<Energy>("{type: yeoh, c10: 0.2 MPa, c20: 1 kPa, poisson: 0.4999}")->make_term(box.body, box.rest);
  double least = 1e300;  // over the stretch across
  for (double c = 0.3; c < 0.4; c += 1e-5) least = std::min(least, solid->value(box.deformed(Vec3(2, 1.5, c).asDiagonal())) / box.volume);
  CHECK(sheet.density(2, 1.5) == Approx(least).epsilon(2e-3));
}
