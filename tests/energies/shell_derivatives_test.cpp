// Every energy of a sheet: derivatives, projections, symmetries.
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/scene/energy.hpp"
#include "geometry/errors.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/sheet_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double thickness = 1e-3;  // m

const SheetBody& sheet() {
  static const SheetBody s(Vec2(0.1, 0.07), {3, 2}, thickness, 0.2, Diagonals::alternating);
  return s;
}

const std::vector<std::string> energies = {
    "{type: stvk_membrane, young: 1e6}",
    "{type: stvk_membrane, young: 1e6, poisson: 0}",
    "{type: stvk_membrane, young: 1e6, fibre: {direction: [1, 3, 2], young: 2e6}}",
    "{type: neo_hookean_membrane, young: 1e6}",
    "{type: neo_hookean_membrane, young: 1e6, poisson: 0.49, fibre: {direction: [0, 0, 1], young: 5e5}}",
    "{type: von_mises_membrane, young: 1e6, yield_stress: 1e4}",
    "{type: von_mises_membrane, young: 1e6, poisson: 0.4, yield_stress: 5e4, hardening: 3e5}",
    "{type: mooney_rivlin_membrane, c10: 1e5, c01: 1e4}",
    "{type: yeoh_membrane, c10: 1e5, c20: 1e3}",
    "{type: gent_membrane, shear_modulus: 2e5, j_m: 2000}",
    "{type: ogden_membrane, terms: [{modulus: 1e5, exponent: 1.3}, {modulus: -1e4, exponent: -2}]}",
    "{type: expression_membrane, energy: 1e5 * (I1 - 3) + 1e4 * (I2 - 3)}",
    "{type: hinge_bending, young: 1e9}",
    "{type: hinge_bending, young: 1e9, poisson: 0}",
    "{type: hinge_bending, stiffness: 0.1, poisson: 0.45}",
    "{type: hinge_bending, stiffness: 0.1, rest: mesh}",
    "{type: hinge_bending, stiffness: 0.1, yield_moment: 1}",
    "{type: hinge_bending, stiffness: 0.1, poisson: 0, yield_moment: 4, hardening: 0.03}"};

template <class Check>
void for_each_term(const Check& check) {
  static const auto terms = [] {
    std::vector<std::pair<std::string, std::unique_ptr<Term>>> all;
    for (const std::string& yaml : energies) all.emplace_back(yaml, component<Energy>(yaml)->make_term(sheet().body, sheet().rest));
    return all;
  }();
  for (const auto& [yaml, term] : terms) {
    INFO(yaml);
    check(*term);
  }
}

Vec3 rolled(const Vec3& x, double radius) {
  return {radius * std::sin(x.x() / radius), radius * (1 - std::cos(x.x() / radius)), x.z()};
}

// A sheet bent by that angle at the line of vertices in the middle.
Vec3 folded(const Vec3& x, double angle) {
  const double across = std::max(x.z(), 0.0);
  return {x.x(), across * std::sin(angle), x.z() - across + across * std::cos(angle)};
}

// Calls check(x) for deformations of a sheet.
template <class Check>
void for_each_deformation(const Check& check) {
  RandomMotions random(3);
  const auto& s = sheet();
  std::vector<std::pair<std::string, VecX>> all;
  all.emplace_back("stretched", s.mapped([](const Vec3& x) { return Vec3(1.3 * x.x(), 0, 0.8 * x.z()); }));
  all.emplace_back("stretched alike", s.mapped([](const Vec3& x) { return Vec3(1.2 * x); }));
  all.emplace_back("pressed", s.mapped([](const Vec3& x) { return Vec3(0.7 * x.x(), 0, 0.6 * x.z()); }));
  all.emplace_back("nearly a line", s.mapped([](const Vec3& x) { return Vec3(1.1 * x.x(), 0, 0.05 * x.z()); }));
  all.emplace_back("sheared", s.mapped([](const Vec3& x) { return Vec3(x.x() + 0.8 * x.z(), 0.1 * x.z(), x.z()); }));
  all.emplace_back("rolled", s.mapped([](const Vec3& x) { return rolled(x, 0.02); }));
  all.emplace_back("rolled up", s.mapped([](const Vec3& x) { return rolled(x, 0.01); }));
  all.emplace_back("folded", s.mapped([](const Vec3& x) { return folded(x, 2.6); }));
  for (const auto& [name, x] : all) {
    INFO(name);
    const Mat3 turn = random.rotation();
    VecX moved(x.size());
    for (int v = 0; v < s.body.vertex_count; ++v) vertex(moved, v) = turn * vertex(x, v) + Vec3(0.1, 0.2, -0.3);
    check(moved);
    check(moved + (name == "nearly a line" ? 2e-5 : 1e-3) * random.vectors(x.size()));
  }
}

}  // namespace

TEST_CASE("shells: gradient and Hessian are those of the value", "[shells]") {
  for_each_term([](const Term& term) {
    for_each_deformation([&](const VecX& x) {
      const VecX gradient = dense_gradient(term, x);
      const MatX hessian = dense_hessian(term, x, Projection::none);
      const double stiffness = hessian.cwiseAbs().maxCoeff(), step = 2e-7;
      const VecX slopes = gradient_by_differences([&](const VecX& y) { return term.value(y); }, x, step);
      const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(term, y); }, x, step);
      const double rounding = 1e-14 * std::abs(term.value(x)) / step;
      REQUIRE((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-4 * stiffness * step + rounding);
      REQUIRE((curvatures - hessian).cwiseAbs().maxCoeff() <= 2e-6 * stiffness);
    });
  });
}

TEST_CASE("shells: derivatives at rest", "[shells]") {
  for_each_term([](const Term& term) {
    const VecX& x = sheet().rest;
    const MatX hessian = dense_hessian(term, x, Projection::none);
    const double stiffness = hessian.cwiseAbs().maxCoeff();
    CHECK(dense_gradient(term, x).lpNorm<Eigen::Infinity>() <= 1e-14 * stiffness);
    CHECK(std::abs(term.value(x)) <= 1e-15 * stiffness);
    const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(term, y); }, x, 1e-7);
    CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-5 * stiffness);
    CHECK((dense_hessian(term, x, Projection::clamp) - hessian).norm() <= 1e-12 * hessian.norm());
  });
}

TEST_CASE("shells: projected Hessians are positive semi-definite", "[shells]") {
  for_each_term([](const Term& term) {
    bool projected_something = false;
    for_each_deformation([&](const VecX& x) {
      const MatX exact = dense_hessian(term, x, Projection::none);
      const MatX clamped = dense_hessian(term, x, Projection::clamp);
      const MatX absolute = dense_hessian(term, x, Projection::absolute);
      const double tiny = 1e-12 * exact.cwiseAbs().maxCoeff();
      for (const Projection projection : {Projection::clamp, Projection::absolute})
        for_each_stencil_hessian(term, x, projection, [&](const MatX& h, const int*) {
          REQUIRE(smallest_eigenvalue(h) >= -1e-12 * h.cwiseAbs().maxCoeff());
        });
      REQUIRE(smallest_eigenvalue(clamped - exact) >= -10 * tiny);  // only negative parts are lifted
      REQUIRE(smallest_eigenvalue(absolute - clamped) >= -10 * tiny);
      projected_something = projected_something || (clamped - exact).norm() > 1e6 * tiny;
    });
    CHECK(projected_something);
  });
}

TEST_CASE("shells: rigid motions cost nothing, and forces and moments add up to zero", "[shells]") {
  RandomMotions random(4);
  for_each_term([&](const Term& term) {
    const double stiffness = dense_hessian(term, sheet().rest, Projection::none).cwiseAbs().maxCoeff();
    for_each_deformation([&](const VecX& x) {
      VecX moved(x.size());
      const Mat3 rotation = random.rotation();
      const Vec3 offset = random.vector();
      for (int v = 0; v < sheet().body.vertex_count; ++v) vertex(moved, v) = rotation * vertex(x, v) + offset;
      CHECK(std::abs(term.value(moved) - term.value(x)) <= 1e-11 * (std::abs(term.value(x)) + 1e-4 * stiffness));
      const VecX force = -dense_gradient(term, x);
      const double scale = force.cwiseAbs().sum() + 1e-9 * stiffness;
      CHECK(total(force).norm() <= 1e-12 * scale);
      CHECK(total_moment(x, force).norm() <= 1e-12 * scale);
      CHECK(term.value(x) >= 0);
    });
  });
}

TEST_CASE("shells: in millimetres and kilograms they cost as much", "[shells]") {
  const SheetBody big(1e3 * Vec2(0.1, 0.07), {3, 2}, 1e3 * thickness, 0.2, Diagonals::alternating);
  for (const auto& [metres, millimetres] : {std::pair<std::string, std::string>
           {"{type: stvk_membrane, young: 1e6, fibre: {direction: [1, 3, 2], young: 2e6}}",
            "{type: stvk_membrane, young: 1e3, fibre: {direction: [1, 3, 2], young: 2e3}}"},
           {"{type: neo_hookean_membrane, young: 1e6}", "{type: neo_hookean_membrane, young: 1e3}"},
           {"{type: von_mises_membrane, young: 1e6, yield_stress: 1e4, hardening: 1e5}",
            "{type: von_mises_membrane, young: 1e3, yield_stress: 10, hardening: 100}"},
           {"{type: hinge_bending, young: 1e9}", "{type: hinge_bending, young: 1e6}"}}) {
    INFO(metres);
    const auto one = component<Energy>(metres)->make_term(sheet().body, sheet().rest);
    const auto other = component<Energy>(millimetres)->make_term(big.body, big.rest);
    for_each_deformation([&](const VecX& x) { CHECK(other->value(1e3 * x) == Approx(1e6 * one->value(x)).epsilon(1e-6).margin(1e-15)); });
  }
}

TEST_CASE("shells: a sheet that is folded flat, and beyond, has finite forces", "[shells]") {
  const SheetBody two(Vec2(0.1, 0.1), {1, 1}, thickness);
  const auto term = component<Energy>("{type: hinge_bending, stiffness: 0.1}")->make_term(two.body, two.rest);
  // About the diagonal from vertex 0 to 3: vertex 1 and 2 are across it.
  const auto bent = [&](double angle) {
    VecX x = two.rest;
    const Vec3 a = vertex(x, 0), axis = (Vec3(vertex(x, 3)) - a).normalized();
    vertex(x, 1) = a + Eigen::AngleAxisd(angle, axis) * (Vec3(vertex(x, 1)) - a);
    return x;
  };
  constexpr double pi = 3.14159265358979323846;
  const double unit = term->value(bent(1));
  for (const double angle : {0.5, 2.0, 3.1, pi, -pi}) {
    INFO(angle);
    CHECK(term->value(bent(angle)) == Approx(angle * angle * unit).epsilon(1e-9));
    CHECK(dense_gradient(*term, bent(angle)).allFinite());
    CHECK(dense_hessian(*term, bent(angle), Projection::clamp).allFinite());
  }
  // Steps carry the angle past pi, in that step and in later steps; stored turns take it back.
  History history, before;
  VecX x = two.rest;
  for (const double angle : {1.5, 3.0, 3.5, 5.0}) {
    before = history;
    term->load_history(history);
    term->begin_step({x, 0, 1, nullptr});
    x = bent(angle);
    CHECK(term->value(x) == Approx(angle * angle * unit).epsilon(1e-9));
    term->commit(x, history);
  }
  CHECK(before.size() == 1);
  term->load_history({});
  term->begin_step({bent(0.1), 0, 1, nullptr});
  CHECK(term->value(bent(1)) == Approx(unit));
  CHECK(history.size() == 1);
  term->load_history(history);
  term->begin_step({x, 0, 1, nullptr});
  term->commit(bent(3), history);
  CHECK(history.empty());
}

TEST_CASE("shells: derivatives of fans of every shape", "[shells]") {
  // About a vertex with 14 triangles, which has fans that do not close; a closed one with three; two triangles back to back.
  for (const int around : {14, 8, 3, 2}) {
    INFO(around);
    SheetBody s(Vec2(0.1, 0.1), {1, 1}, thickness);
    const int n = std::max(around, 3);
    s.body.vertex_count = n + 1;
    s.rest.resize(3 * (n + 1));
    s.body.sheet.clear();
    vertex(s.rest, n) = Vec3(0, 0.01, 0);
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979323846 * i / n, radius = 0.05 * (1 + 0.2 * (i % 2));
      vertex(s.rest, i) = Vec3(radius * std::cos(angle), 0, radius * std::sin(angle));
      if (around > 2) s.body.sheet.push_back({n, (i + 1) % n, i});
    }
    if (around == 2) s.body.sheet = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    s.body.triangles = s.body.sheet;
    const auto term = component<Energy>("{type: hinge_bending, stiffness: 0.1, poisson: 0.4}")->make_term(s.body, s.rest);
    RandomMotions random(5);
    const VecX x = s.rest + 2e-3 * random.vectors(s.rest.size());
    const MatX hessian = dense_hessian(*term, x, Projection::none), clamped = dense_hessian(*term, x, Projection::clamp);
    const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(*term, y); }, x, 1e-7);
    const VecX slopes = gradient_by_differences([&](const VecX& y) { return term->value(y); }, x, 1e-7);
    CHECK((slopes - dense_gradient(*term, x)).norm() <= 1e-6 * slopes.norm());
    CHECK((curvatures - hessian).norm() <= 1e-5 * hessian.norm());
    CHECK(smallest_eigenvalue(clamped) >= -1e-12 * clamped.norm());
    for (const StencilBatch& batch : term->batches()) CHECK(batch.arity <= largest_arity);
  }
}

TEST_CASE("shells: results do not depend on the orientation of triangles", "[shells]") {
  for (const double jitter : {0.0, 0.2}) {
    SheetBody s(Vec2(0.1, 0.07), {5, 4}, thickness, jitter, Diagonals::alternating);
    const auto energy = component<Energy>("{type: hinge_bending, stiffness: 0.1, poisson: 0.4}");
    const VecX x = s.mapped([](const Vec3& v) { return Vec3(v.x(), 3 * v.x() * v.z() + v.z() * v.z(), v.z()); });
    const double one = energy->make_term(s.body, s.rest)->value(x);
    for (size_t t = 0; t < s.body.sheet.size(); t += 3) std::swap(s.body.sheet[t][0], s.body.sheet[t][1]);
    CHECK(energy->make_term(s.body, s.rest)->value(x) == Approx(one).epsilon(1e-3));
  }
}

TEST_CASE("shells: at a vertex of three triangles two flaps of a triangle are one vertex", "[shells]") {
  SheetBody s(Vec2(0.1, 0.1), {1, 1}, thickness);
  s.body.vertex_count = 4;
  s.rest.resize(12);
  s.rest << 0, 0, 0, 0.1, 0, 0, 0.03, 0.1, 0, 0.05, 0.03, 0.01;
  s.body.sheet = s.body.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const auto term = component<Energy>("{type: hinge_bending, stiffness: 0.1, poisson: 0.2}")->make_term(s.body, s.rest);
  const MatX hessian = dense_hessian(*term, s.rest, Projection::none);
  const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(*term, y); }, s.rest, 1e-7);
  const VecX slopes = gradient_by_differences([&](const VecX& y) { return term->value(y); }, s.rest, 1e-7);
  CHECK((slopes - dense_gradient(*term, s.rest)).norm() <= 1e-6 * slopes.norm());
  CHECK((curvatures - hessian).norm() <= 1e-6 * hessian.norm());
  // No vertex stands twice in a stencil.
  for_each_stencil_hessian(*term, s.rest, Projection::none, [](const MatX& h, const int* v) {
    for (int b = 1; b < h.rows() / 3; ++b) CHECK(std::find(v, v + b, v[b]) == v + b);
  });
}

TEST_CASE("shells: masses add up to density times area times thickness", "[shells]") {
  for (const std::string type : {"stvk_membrane", "neo_hookean_membrane", "von_mises_membrane"}) {
    VecX mass = VecX::Zero(sheet().body.vertex_count);
    component<Energy>("{type: " + type + ", young: 1e5, density: 700" + (type == "von_mises_membrane" ? ", yield_stress: 1e3}" : "}"))
        ->add_mass(sheet().body, sheet().rest, mass);
    CHECK(mass.minCoeff() > 0);
    CHECK(mass.sum() == Approx(700 * sheet().volume));
  }
}

TEST_CASE("shells refuse bodies without a sheet", "[shells]") {
  const TetBody box(Vec3(0.1, 0.1, 0.1), {1, 1, 1});
  SheetBody thin = sheet(), flat = sheet(), three = sheet();
  thin.body.thickness = 0;
  vertex(flat.rest, flat.body.sheet[4][0]) = vertex(flat.rest, flat.body.sheet[4][1]);
  three.body.sheet.push_back(three.body.sheet[0]);
  three.body.sheet.back()[0] = three.body.vertex_count - 1;
  for (const std::string& yaml : energies) {
    const auto energy = component<Energy>(yaml);
    CHECK_THROWS_WITH(energy->make_term(box.body, box.rest), Catch::Contains("'box'") && Catch::Contains("triangles"));
    CHECK_THROWS_WITH(energy->make_term(thin.body, thin.rest), Catch::Contains("shell: {thickness"));
    CHECK_THROWS_WITH(energy->make_term(flat.body, flat.rest), Catch::Contains("no area"));
  }
  const auto bending = component<Energy>("{type: hinge_bending, stiffness: 1}");
  CHECK_THROWS_WITH(bending->make_term(three.body, three.rest), Catch::Contains("share an edge"));
  SheetBody alone = sheet();
  alone.body.sheet.resize(1);
  CHECK_THROWS_WITH(bending->make_term(alone.body, alone.rest), Catch::Contains("no two triangles"));
  CHECK_THROWS_WITH(component<Energy>("{type: hinge_bending, stiffness: 1, young: 1}"), Catch::Contains("one of the two"));
  CHECK_THROWS_WITH(component<Energy>("{type: hinge_bending}"), Catch::Contains("one of the two"));
  const auto across = component<Energy>("{type: stvk_membrane, young: 1, fibre: {direction: [0, 1, 0], young: 1}}");
  CHECK_THROWS_WITH(across->make_term(sheet().body, sheet().rest), Catch::Contains("across its triangle"));
}
