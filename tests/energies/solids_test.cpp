// Every energy that can act on a body of tets, whatever energies exist.
#include <catch2/catch.hpp>
#include <map>

#include "framework/scene/energy_with_unknowns.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

// A body of tets of each kind.
const std::vector<TetBody>& boxes() {
  static const std::vector<TetBody> all = [] {
    const Vec3 size(0.1, 0.07, 0.05);
    return std::vector{TetBody(size, {2, 1, 1}), TetBody(size, {1, 1, 1}, Elements::composite), TetBody(size, {2, 1, 1}, Elements::patches)};
  }();
  return all;
}

// Returns whether an energy fills tets: it refuses a body without any, and makes a term of a body that has some.
// Energies that ask for unknowns need a builder.
bool fills_tets(const Energy& energy) {
  if (dynamic_cast<const EnergyWithUnknowns*>(&energy)) return false;
  const auto takes = [&](const Body& body, const VecX& rest) {
    try {
      energy.make_term(body, rest);
      return true;
    } catch (const InputError&) {
      return false;
    }
  };
  return takes(boxes().front().body, boxes().front().rest) && !takes(Body(), VecX());
}
// Parameters that some energies require: those of hinge_bending, and of maxwell branches with their shifts.
const std::map<std::string, std::string> bends = {{"stiffness", "1e-3"}}, relaxes = {{"modulus", "1e4"}}, shifts = {{"activation_energy", "6e4"}},
                                         relaxes_and_shifts = {{"modulus", "1e4"}, {"activation_energy", "6e4"}};

// The tested terms, made once: all energies of solids, in every variant.
struct NamedTerm {
  std::string yaml;
  const TetBody& box;
  std::unique_ptr<Term> term;
};
const std::vector<NamedTerm>& terms() {
  static const std::vector<NamedTerm> all = [] {
    std::vector<NamedTerm> made;
    for (const ComponentVariant& v : variants<Energy>({{}, {{"poisson", "0.45"}}, {{"poisson", "-0.2"}}, bends, relaxes, shifts, relaxes_and_shifts}))
      if (const auto energy = component<Energy>(v.yaml); fills_tets(*energy) && v.type != "hgo_fibres")  // slack at rest: fibres_test.cpp
        for (const TetBody& box : boxes())
          if (box.body.elements == Elements::linear || energy->takes_elements()) made.push_back({v.yaml, box, energy->make_term(box.body, box.rest)});
    return made;
  }();
  return all;
}

template <class Check>
void for_each_term(const Check& check) {
  REQUIRE(terms().size() >= 9 * boxes().size());  // three materials, three ratios of Poisson each
  for (const auto& [yaml, box, term] : terms()) {
    INFO(yaml << ", elements " << static_cast<int>(box.body.elements));
    check(*term, box);
  }
}

// Stretches to test, equal and nearly equal ones among them.
const std::vector<Vec3> stretches = {
    {1, 1, 1},          {1.3, 1.3, 1.3}, {1.5, 1.5, 0.7},       {0.6, 1.2, 0.6},
    {3, 0.6, 0.8},      {0.3, 0.4, 5},   {1.2, 1.2 + 1e-9, 0.9}, {0.8, 0.8 + 1.5e-6, 0.8 + 4e-6},
    {0.15, 0.2, 0.25},  {0.9, 1.05, 1.1}};

// check(x) on homogeneous deformations and on disturbed ones.
template <class Check>
void for_each_deformation(const TetBody& box, const Check& check) {
  RandomMotions random(3);
  for (const Vec3& s : stretches) {
    INFO("stretches " << s.transpose());
    const Mat3 f = random.rotation() * s.asDiagonal() * random.rotation().transpose();
    check(box.deformed(f));
    check(box.deformed(Mat3(s.asDiagonal())));
    const double noise = 0.003 * s.minCoeff();
    check(box.deformed(f) + noise * random.vectors(box.rest.size()));
  }
}

}  // namespace

TEST_CASE("solids: gradient and Hessian are those of the value", "[solids]") {
  for_each_term([](const Term& term, const TetBody& box) {
    for_each_deformation(box, [&](const VecX& x) {
      const VecX gradient = dense_gradient(term, x);
      const MatX hessian = dense_hessian(term, x, Projection::none);
      const double stiffness = hessian.cwiseAbs().maxCoeff(), step = 2e-5 * 0.1;
      const VecX slopes = gradient_by_differences([&](const VecX& y) { return term.value(y); }, x, step);
      const MatX curvatures =
          hessian_by_differences([&](const VecX& y) { return dense_gradient(term, y); }, x, step);
      const double rounding = 1e-14 * std::abs(term.value(x)) / step;
      REQUIRE((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-5 * stiffness * step + rounding);
      REQUIRE((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-6 * stiffness);
    });
  });
}

TEST_CASE("solids: projected Hessians are positive semi-definite", "[solids]") {
  for_each_term([](const Term& term, const TetBody& box) {
    bool projected_something = false;
    for_each_deformation(box, [&](const VecX& x) {
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
    CHECK(projected_something);  // or the deformations above are too tame
    const MatX rest = dense_hessian(term, box.rest, Projection::none);
    CHECK((dense_hessian(term, box.rest, Projection::clamp) - rest).norm() <= 1e-12 * rest.norm());
  });
}

TEST_CASE("solids: rigid motions cost nothing", "[solids]") {
  RandomMotions random(4);
  for_each_term([&](const Term& term, const TetBody& box) {
    for_each_deformation(box, [&](const VecX& x) {
      VecX moved(x.size());
      const Mat3 rotation = random.rotation();
      const Vec3 offset = random.vector();
      for (int v = 0; v < box.body.vertex_count; ++v) vertex(moved, v) = rotation * vertex(x, v) + offset;
      const double scale = std::abs(term.value(x)) + 35;  // J: Young's modulus times volume
      CHECK(std::abs(term.value(moved) - term.value(x)) <= 1e-12 * scale);
    });
  });
}

TEST_CASE("solids: at rest there is no energy and no force", "[solids]") {
  for_each_term([](const Term& term, const TetBody& box) {
    const double stiffness = dense_hessian(term, box.rest, Projection::none).cwiseAbs().maxCoeff();
    CHECK(dense_gradient(term, box.rest).lpNorm<Eigen::Infinity>() <= 1e-14 * stiffness);
    CHECK(std::abs(term.value(box.rest)) <= 1e-15 * stiffness);
    for_each_deformation(box, [&](const VecX& x) { CHECK(term.value(x) >= -1e-15 * stiffness); });
  });
}

TEST_CASE("solids: internal forces and their moments add up to zero", "[solids]") {
  for_each_term([](const Term& term, const TetBody& box) {
    for_each_deformation(box, [&](const VecX& x) {
      const VecX force = -dense_gradient(term, x);
      const double scale = force.cwiseAbs().sum() + 1e-6;
      CHECK(total(force).norm() <= 1e-13 * scale);
      CHECK(total_moment(x, force).norm() <= 1e-13 * scale);
    });
  });
}

TEST_CASE("solids: lumped masses add up to density times volume", "[solids]") {
  for (const ComponentVariant& v : variants<Energy>({{}, bends, relaxes, shifts, relaxes_and_shifts})) {
    const auto energy = component<Energy>(v.yaml);
    if (!fills_tets(*energy)) continue;
    const Fields fields = Registry<Energy>::kind().prototype(v.type);
    const Field* density = fields.find("density");
    if (!density) continue;  // an energy without mass
    INFO(v.yaml);
    for (const TetBody& box : boxes()) {
      VecX mass = VecX::Zero(box.body.vertex_count);
      energy->add_mass(box.body, box.rest, mass);
      CHECK(mass.minCoeff() > 0);
      CHECK(mass.sum() == Approx(std::stod(density->write().text) * box.volume));
    }
  }
}

TEST_CASE("solids refuse bodies without tets and with inverted ones", "[solids]") {
  Body empty;
  empty.name = "sheet";
  TetBody flipped = boxes().front();
  std::swap(flipped.body.tets[3][0], flipped.body.tets[3][1]);
  for (const std::string name : {"neo_hookean", "fixed_corotated", "stvk_hencky"}) {
    const auto energy = component<Energy>("{type: " + name + ", young: 1e5}");
    CHECK_THROWS_WITH(energy->make_term(empty, VecX()), Catch::Contains("sheet"));
    CHECK_THROWS_WITH(energy->make_term(flipped.body, flipped.rest), Catch::Contains("tet 3"));
  }
}
