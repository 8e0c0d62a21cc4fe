// Maxwell branches of rods, strings and the bending of sheets: relaxation, dashpots, dissipation, derivatives, refusals.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/bond/environment.hpp"
#include "framework/scene/energy.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/published.hpp"
#include "tests/support/rod_body.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double fraction = 0.7, relaxation_time = 0.3;  // 1, s

// An energy of rods or sheets, and a branch beside it.
struct Beside {
  std::string name;
  std::vector<std::unique_ptr<Energy>> energies;
  std::unique_ptr<Term> elastic, branch;
  VecX rest;
  std::function<VecX(double)> deformed;  // by a size
};

// Calls check for a rod, a string and a sheet that bends.
template <class Check>
void for_each_branch(const Check& check) {
  static const RodBody rod({{0, 0, 0}, {0.03, 0.01, 0}, {0.06, 0, 0.01}, {0.08, 0.02, 0.01}}, {{0, 1}, {1, 2}, {2, 3}}, {0, 3e-3, 2e-3, Vec3(0, 0, 1)});
  static const SheetBody sheet(Vec2(0.1, 0.08), {3, 2}, 1e-3, 0.1);
  const auto of = [&](const std::string& name, Body body, const VecX& rest, const std::string& elastic, const std::string& branch, const std::function<VecX(double)>& deformed) {
    INFO(name);
    Beside b{name, {}, {}, {}, rest, deformed};
    b.energies.push_back(component<Energy>(elastic));
    body.energies = b.energies;
    body.energy = 1;
    b.elastic = b.energies.front()->make_term(body, rest);
    b.branch = component<Energy>(fmt::format("{{type: {}, fraction: {}, time: {}}}", branch, fraction, relaxation_time))->make_term(body, rest);
    for (Term* term : {b.elastic.get(), b.branch.get()}) term->load_history({});
    check(b);
  };
  const auto of_rod = [](double size) {
    RandomMotions random(3);
    VecX x = rod.rest + 6e-3 * size * random.vectors(rod.rest.size());
    for (const int t : rod.frames->twists()) x(3 * t + 1) = x(3 * t + 2) = 0;
    return x;
  };
  of("rod", rod.body, rod.rest, "{type: elastic_rod, young: 1e7, poisson: 0.3, curvature: [3, 1], twist: 2}", "maxwell_rod", of_rod);
  of("string", rod.body, rod.rest, "{type: string, young: 1e7}", "maxwell_rod", of_rod);
  for (const char* rest : {"flat", "mesh"})
    of(rest, sheet.body, sheet.rest, fmt::format("{{type: hinge_bending, young: 1e7, rest: {}}}", rest), "maxwell_bending", [](double size) {
      RandomMotions random(3);
      return VecX(sheet.rest + 6e-3 * size * random.vectors(sheet.rest.size()));
    });
}

}  // namespace

TEST_CASE("branches of strains: a shape that is held relaxes exponentially, by any step", "[maxwell][rod][shells]") {
  for_each_branch([](Beside& b) {
    const VecX x = b.deformed(1);
    b.elastic->begin_step({x, 0, 0});
    const VecX elastic = dense_gradient(*b.elastic, x);
    const double stored = b.elastic->value(x);
    History history;
    double t = 0;
    VecX before = b.rest;
    for (const double h : {1e-9, 0.01, 0.2, 0.05, 1.0}) {
      b.branch->begin_step({before, t, h});
      const VecX in_step = dense_gradient(*b.branch, x);
      const double lost = Published(*b.branch).flow("dissipated_viscous", x);
      b.branch->commit(x, history);
      b.branch->load_history(history);
      if (before == x) CHECK(lost == Approx(fraction * stored * (std::exp(-2 * t / relaxation_time) - std::exp(-2 * (t + h) / relaxation_time))).epsilon(1e-6));
      if (before == x) t += h;
      // Rods that are at rest in another shape (curvature, twist) than the mesh have relaxed a little from that in the first step.
      CHECK((in_step - fraction * std::exp(-t / relaxation_time) * elastic).norm() <= 1e-7 * elastic.norm());
      b.branch->begin_step({x, t, 0});
      CHECK((dense_gradient(*b.branch, x) - in_step).norm() <= 1e-9 * elastic.norm());
      CHECK(b.branch->value(x) == Approx(fraction * std::exp(-2 * t / relaxation_time) * stored).epsilon(1e-6));
      before = x;
    }
  });
}

TEST_CASE("branches of strains: a constant rate has the force of a dashpot, and its loss", "[maxwell][rod]") {
  // A string of one edge: its strain is its length.
  const RodBody rod({{0, 0, 0}, {0.1, 0, 0}}, {{0, 1}}, {0, 3e-3, 2e-3, Vec3(0, 0, 1)});
  std::vector<std::unique_ptr<Energy>> beside;
  beside.push_back(component<Energy>("{type: string, young: 1e7}"));
  Body body = rod.body;
  body.energies = beside;
  const auto term = component<Energy>(fmt::format("{{type: maxwell_rod, fraction: {}, time: {}}}", fraction, relaxation_time))->make_term(body, rod.rest);
  const double stiffness = fraction * 1e7 * 6e-6 / 0.1, rate = 1e-3;
  const auto at = [&](double t) {
    VecX x = rod.rest;
    x(3) += rate * t;
    return x;
  };
  History history;
  double t = 0, lost = 0;
  for (const double h : {0.01, 3.0, 0.2, 0.05, 40.0}) {
    term->begin_step({at(t), t, h});
    t += h;
    CHECK(dense_gradient(*term, at(t))(3) == Approx(stiffness * rate * relaxation_time * -std::expm1(-t / relaxation_time)).epsilon(1e-8));
    lost += Published(*term).flow("dissipated_viscous", at(t));
    const double x = t / relaxation_time;
    CHECK(lost == Approx(stiffness * rate * rate * relaxation_time * relaxation_time * (x + 2 * std::expm1(-x) - std::expm1(-2 * x) / 2)).epsilon(1e-6));
    term->commit(at(t), history);
    term->load_history(history);
  }
}

TEST_CASE("branches of strains: derivatives agree with differences, and a step that is tried again is the same", "[maxwell][rod][shells]") {
  for_each_branch([](Beside& b) {
    History history;
    VecX before = b.rest;
    for (int i = 1; i <= 3; ++i) {
      b.branch->begin_step({before, 0, 0.1});
      before = b.deformed(0.3 * i);
      b.branch->commit(before, history);
      b.branch->load_history(history);
    }
    const VecX x = b.deformed(1.2);
    for (const double h : {0.0, 0.2}) {
      b.branch->begin_step({before, 0, h});
      const double value = b.branch->value(x);
      const VecX gradient = dense_gradient(*b.branch, x);
      CHECK((gradient - gradient_by_differences([&](const VecX& y) { return b.branch->value(y); }, x, 1e-6)).norm() < 1e-7 * gradient.norm());
      const MatX hessian = dense_hessian(*b.branch, x, Projection::none);
      CHECK((hessian - hessian_by_differences([&](const VecX& y) { return dense_gradient(*b.branch, y); }, x, 1e-6)).norm() < 1e-6 * hessian.norm());
      for_each_stencil_hessian(*b.branch, x, Projection::clamp, [&](const MatX& m, const int*) { CHECK(smallest_eigenvalue(m) >= -1e-9 * m.norm()); });
      b.branch->begin_step({b.rest, 0, 0.05});  // rejected
      b.branch->begin_step({before, 0, h});
      CHECK(b.branch->value(x) == value);
    }
  });
}

TEST_CASE("branches of strains have the time of the temperature, which is one for all", "[maxwell][rod]") {
  const RodBody rod({{0, 0, 0}, {0.1, 0, 0}}, {{0, 1}}, {0, 3e-3, 2e-3, Vec3(0, 0, 1)});
  std::vector<std::unique_ptr<Energy>> beside;
  beside.push_back(component<Energy>("{type: string, young: 1e7}"));
  Environment warm, uneven;
  bind(parse_string("{temperature: 310}", "test.yaml"), warm, "environment");
  bind(parse_string("{temperature: 310, profile: 10 * x}", "test.yaml"), uneven, "environment");
  Body body = rod.body;
  body.energies = beside;
  body.environment = &warm;
  const auto branch = component<Energy>("{type: maxwell_rod, fraction: 1, time: 2, shift: arrhenius, activation_energy: 60 kJ/mol, reference_temperature: 300}");
  CHECK(branch->depends_on_temperature());
  const auto term = branch->make_term(body, rod.rest);
  VecX x = rod.rest;
  x(3) += 1e-3;
  History history;
  term->begin_step({rod.rest, 0, 1e-12});
  term->commit(x, history);
  term->load_history(history);
  term->begin_step({x, 0, 0.5});
  const double time = 2 * std::exp(60e3 / 8.31446261815324 * (1 / 310.0 - 1 / 300.0));
  CHECK(dense_gradient(*term, x)(3) == Approx(1e7 * 6e-6 / 0.1 * 1e-3 * std::exp(-0.5 / time)).epsilon(1e-8));
  body.environment = &uneven;
  CHECK_THROWS_WITH(branch->make_term(body, rod.rest), Catch::Contains("has one temperature") && Catch::Contains("`profile`"));
}

TEST_CASE("branches of strains need one energy beside them", "[maxwell][rod][shells]") {
  const RodBody rod({{0, 0, 0}, {0.1, 0, 0}}, {{0, 1}}, {0, 3e-3, 2e-3, Vec3(0, 0, 1)});
  Body body = rod.body;
  const auto branch = component<Energy>("{type: maxwell_rod, fraction: 1, time: 1}");
  CHECK_THROWS_WITH(branch->make_term(body, rod.rest), Catch::Contains("`elastic_rod` or `string`, and the object has none of these"));
  std::vector<std::unique_ptr<Energy>> beside;
  for (int i = 0; i < 2; ++i) beside.push_back(component<Energy>("{type: string, young: 1e7}"));
  body.energies = beside;
  CHECK_THROWS_WITH(branch->make_term(body, rod.rest), Catch::Contains("has 2 of these"));
  CHECK_THROWS_WITH(component<Energy>("{type: maxwell_bending, fraction: 1, time: 1}")->make_term(body, rod.rest), Catch::Contains("`hinge_bending`"));
}
