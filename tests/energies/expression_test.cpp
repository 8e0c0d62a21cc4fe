// Materials as formulas of a scene: equal to the built-in materials of the same formula, derivatives, refusals.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "energies/hyperelastic/pack_jet.hpp"
#include "framework/config/formula.hpp"
#include "framework/config/formula_program.hpp"
#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

const auto kinds = {Elements::linear, Elements::patches, Elements::composite};

// A formula and the built-in material of that energy.
struct Same {
  std::string formula, built_in;
  bool split;  // elements with a mean volume split both alike
};
// K = 2 mu (1 + nu) / (3 (1 - 2 nu)); nu = 0.45: 29/3 mu
const std::vector<Same> solids = {
    {"{type: expression, energy: mu / 2 * (I1 - 3) - mu * ln(J), volume: la / 2 * ln(J)^2, parameters: {mu: 0.2 MPa, la: 1.8 MPa}}", "{type: neo_hookean, young: 0.58 MPa, poisson: 0.45}", false},
    {"{type: expression, energy: c1 * (I1_bar - 3) + c2 * (I2_bar - 3), volume: K / 2 * ln(J)^2, parameters: {c1: 80 kPa, c2: 20 kPa, K: 1933.333333333333 kPa}}",
     "{type: mooney_rivlin, c10: 80 kPa, c01: 20 kPa, poisson: 0.45}", true},
    {"{type: expression, energy: -mu * jm / 2 * ln(1 - (I1_bar - 3) / jm), volume: K / 2 * ln(J)^2, parameters: {mu: 0.2 MPa, jm: 90, K: 1933.333333333333 kPa}}",
     "{type: gent, shear_modulus: 0.2 MPa, j_m: 90, poisson: 0.45}", true},
    {"{type: expression, energy: mu / a * ((s1^a + s2^a + s3^a) * J^(-a / 3) - 3), volume: K / 2 * ln(J)^2, parameters: {mu: 0.2 MPa, a: 2.6, K: 2513.333333333333 kPa}}",
     "{type: ogden, terms: [{modulus: 0.2 MPa, exponent: 2.6}], poisson: 0.45}", true}};
const std::vector<Same> sheets = {
    {"{type: expression_membrane, energy: c1 * (I1 - 3) + c2 * (I2 - 3), parameters: {c1: 80 kPa, c2: 20 kPa}}", "{type: mooney_rivlin_membrane, c10: 80 kPa, c01: 20 kPa}", true},
    {"{type: expression_membrane, energy: mu / a * (s1^a + s2^a + s3^a - 3), parameters: {mu: 0.2 MPa, a: 2.6}}", "{type: ogden_membrane, terms: [{modulus: 0.2 MPa, exponent: 2.6}]}", true}};

void check_same(const Term& formula, const Term& built_in, const VecX& x) {
  CHECK(formula.value(x) == Approx(built_in.value(x)).epsilon(1e-10));
  const VecX g = dense_gradient(built_in, x);
  CHECK((dense_gradient(formula, x) - g).norm() <= 1e-10 * g.norm());
  const MatX h = dense_hessian(built_in, x, Projection::none);
  CHECK((dense_hessian(formula, x, Projection::none) - h).norm() <= 1e-9 * h.norm());
}

std::string error_of(const std::string& yaml) {
  try {
    component<Energy>("{" + yaml + "}");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("expressions are the built-in materials of the same formula", "[hyperelastic][expression]") {
  RandomMotions random(7);
  for (const Same& same : solids)
    for (const Elements kind : kinds) {
      INFO(same.formula << ", elements " << static_cast<int>(kind));
      const TetBody box(Vec3(0.1, 0.07, 0.05), {1, 1, 1}, kind);
      const auto formula = component<Energy>(same.formula), built_in = component<Energy>(same.built_in);
      CHECK(formula->young() == Approx(*built_in->young()));
      CHECK(formula->poisson() == Approx(*built_in->poisson()));
      CHECK(formula->shear() == Approx(*built_in->shear()));
      const auto a = formula->make_term(box.body, box.rest), b = built_in->make_term(box.body, box.rest);
      const auto inverted = box.deformed(Vec3(1, 1, -1).asDiagonal());
      CHECK(std::isinf(a->value(inverted)));
      CHECK(std::isinf(a->value(box.deformed(Vec3(1, 1, 0).asDiagonal()))));
      for (int trial = 0; trial < 5; ++trial) {
        const Mat3 f = random.rotation() * Vec3(random.uniform(0.6, 2), random.uniform(0.6, 2), random.uniform(0.6, 2)).asDiagonal() * random.rotation();
        check_same(*a, *b, box.deformed(f) + (kind == Elements::linear || same.split ? 0.002 : 0.0) * random.vectors(box.rest.size()));
      }
      // At small strains all are equal.
      const VecX x = box.deformed(Mat3::Identity()) + 1e-7 * random.vectors(box.rest.size());
      const VecX g = dense_gradient(*b, x);
      CHECK((dense_gradient(*a, x) - g).norm() <= (kind == Elements::linear || same.split ? 1e-4 : 1e-2) * g.norm());
    }
  const SheetBody sheet(Vec2(0.1, 0.08), {3, 2}, 1e-3, 0.1);
  for (const Same& same : sheets) {
    INFO(same.formula);
    const auto formula = component<Energy>(same.formula), built_in = component<Energy>(same.built_in);
    CHECK(formula->young() == Approx(*built_in->young()));
    for (int trial = 0; trial < 5; ++trial) {
      const Mat3 f = random.rotation() * Vec3(random.uniform(0.6, 2), 1, random.uniform(0.6, 2)).asDiagonal() * random.rotation();
      check_same(*formula->make_term(sheet.body, sheet.rest), *built_in->make_term(sheet.body, sheet.rest),
                 sheet.mapped([&](const Vec3& x) { return Vec3(f * x); }) + 0.002 * random.vectors(sheet.rest.size()));
    }
  }
}

TEST_CASE("expressions of a nearly incompressible solid do not lock in composite tets", "[hyperelastic][expression]") {
  // Volumes that differ between points and have the rest volume as their mean cost little.
  RandomMotions random(3);
  const TetBody box(Vec3(0.1, 0.07, 0.05), {1, 1, 1}, Elements::composite);
  const auto make = [&](const std::string& volume) {
    return component<Energy>(fmt::format("{{type: expression, energy: 5e4 * (I1 - 3) - 1e5 * ln(J){}}}", volume))->make_term(box.body, box.rest);
  };
  const VecX x = box.rest + 2e-3 * random.vectors(box.rest.size());
  const double averaged = make(", volume: 5e7 * ln(J)^2")->value(x), at_points = make(" + 5e7 * ln(J)^2")->value(x);
  CHECK(at_points > 1.5 * averaged);
}

TEST_CASE("programs of formulas have the values of formulas and exact derivatives", "[hyperelastic][expression]") {
  const std::vector<std::string> names = {"x", "y"};
  const std::map<std::string, double> constants = {{"a", 1.5}, {"b", -0.25}};
  for (const std::string text : {"x^2 * y - 3 / x", "-x^2", "2^-x", "x^y", "exp(-a * x) * ln(y) + log(x)", "sqrt(x * y) + abs(b * x)", "min(x, y) * max(x, y^2)", "sin(x) * cos(y) - tanh(x * y)",
                                 "x^(a - 1) / y^-2 - (x + y)^3", "-(x - y) * -2.5e-1 + pi", "x - y - 1", "x / y / 2", "2 ^ 2 ^ 0.5 * x"}) {
    INFO(text);
    const FormulaProgram program(text, names, constants);
    const Formula formula(text, {"x", "y", "a", "b"});
    const auto value = [&](double x, double y) { return formula(std::vector<double>{x, y, 1.5, -0.25}); };
    for (const auto& [x, y] : {std::pair(0.7, 1.3), {2.0, 0.4}, {1.5, 1.6}}) {
      using Jet = PackJet<double, 2>;
      const Jet at[2] = {Jet::variable(x, 0), Jet::variable(y, 1)}, f = program(at);
      CHECK(f.v == Approx(value(x, y)).epsilon(1e-13));
      constexpr double h = 1e-3;
      const auto by_x = [&](double u, double v) { return central_difference([&](double d) { return value(u + d, v); }, h); };
      const auto by_y = [&](double u, double v) { return central_difference([&](double d) { return value(u, v + d); }, h); };
      CHECK(f.d[0] == Approx(by_x(x, y)).epsilon(1e-8).margin(1e-8));
      CHECK(f.d[1] == Approx(by_y(x, y)).epsilon(1e-8).margin(1e-8));
      CHECK(f.h[0] == Approx(central_difference([&](double d) { return by_x(x + d, y); }, h)).epsilon(1e-6).margin(1e-6));
      CHECK(f.h[1] == Approx(central_difference([&](double d) { return by_y(x + d, y); }, h)).epsilon(1e-6).margin(1e-6));
      CHECK(f.h[2] == Approx(central_difference([&](double d) { return by_y(x, y + d); }, h)).epsilon(1e-6).margin(1e-6));
    }
  }
  for (const std::string text : {"x > 1 ? x : y", "x && y", "rint(x)", "atan(x)", "x +", "z", "x = 1"}) {
    INFO(text);
    CHECK_THROWS_AS(FormulaProgram(text, names, constants), InputError);
  }
}

TEST_CASE("expressions that are no isotropic material at rest are refused", "[hyperelastic][expression]") {
  CHECK_THAT(error_of("type: expression, energy: 1e5 * (I1 - 3)"), Catch::Contains("has a stress of 200000 Pa at rest") && Catch::Contains("-200000 * ln(J)"));
  CHECK_THAT(error_of("type: expression, energy: 1e5 * (I1_bar - 3)"), Catch::Contains("bulk modulus") && Catch::Contains("volume"));
  CHECK_THAT(error_of("type: expression, energy: 1e5 * ln(J)^2"), Catch::Contains("shear modulus"));
  CHECK_THAT(error_of("type: expression, energy: s1^2 + 2 * s2^2 + s3^2"), Catch::Contains("change places"));
  CHECK_THAT(error_of("type: expression, energy: mu * (I1 - 3)"), Catch::Contains("mu"));
  CHECK_THAT(error_of("type: expression, energy: 1e5 * ln(I1 - 3)"), Catch::Contains("at rest"));
  CHECK_THAT(error_of("type: expression, energy: 1e5 * (I1_bar - 3), volume: 1e5 * (I1 - 3)"), Catch::Contains("formula of J"));
  CHECK_THAT(error_of("type: expression, energy: 1e5 * (I1_bar - 3), volume: 1e5 * (J - 1)"), Catch::Contains("has a stress of 100000 Pa at rest"));
  CHECK_THAT(error_of("type: expression, energy: 1e5 * (I1_bar - 3), volume: 1e5 * ln(J)^2, parameters: {J: 1}"), Catch::Contains("something else"));
  CHECK_THAT(error_of("type: expression, energy: k * (I1_bar - 3), volume: 1e5 * ln(J)^2, parameters: {k: 1 kPa, z: 1}"), Catch::Contains("'z' does not occur"));
  CHECK_THAT(error_of("type: expression_membrane, energy: k * (I1 - 3), parameters: {k: 1 kPa, z: 1}"), Catch::Contains("'z' does not occur"));
  CHECK_THAT(error_of("type: expression_membrane, energy: -1e5 * (I1 - 3)"), Catch::Contains("shear modulus"));
  CHECK(error_of("type: expression_membrane, energy: 1e5 * (I1 - 3)").empty());
}
