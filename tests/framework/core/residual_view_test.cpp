// Terms with a least-squares view: the squares are the energy, and the Jacobian is that of the
// residuals.
#include "framework/contact/terms/friction_term.hpp"
#include "framework/core/residual_view.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <limits>

#include "framework/scene/energy.hpp"
#include "framework/scene/energy_with_unknowns.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/polynomial_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/three_boxes.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

struct Squares {
  VecX r;
  MatX jacobian;  // by all coordinates
  double value() const { return 0.5 * r.squaredNorm(); }
  VecX gradient() const { return jacobian.transpose() * r; }
};

Squares squares_of(const Term& term, const VecX& x) {
  const ResidualView& view = *term.residual_view();
  const auto batches = view.residual_batches();
  size_t rows = 0, entries = 0;
  for (const ResidualBatch& b : batches) {
    rows += static_cast<size_t>(b.residuals) * b.count;
    entries += static_cast<size_t>(b.residuals) * 3 * b.arity * b.count;
  }
  std::vector<double> jacobian(entries);
  Squares s{VecX(rows), MatX::Zero(rows, x.size())};
  REQUIRE(view.residuals(x, s.r.data(), jacobian.data()));
  const double* entry = jacobian.data();
  size_t row = 0;
  for (const ResidualBatch& b : batches)
    for (int stencil = 0; stencil < b.count; ++stencil)
      for (int k = 0; k < b.residuals; ++k, ++row)
        for (int i = 0; i < b.arity; ++i, entry += 3)
          s.jacobian.block<1, 3>(row, 3 * b.vertices[b.arity * stencil + i]) =
              Eigen::Map<const Eigen::RowVector3d>(entry);
  return s;
}

void check_jacobian(const Term& term, const VecX& x, double step, double within) {
  const Squares s = squares_of(term, x);
  const auto residuals = [&](const VecX& y) {
    VecX r(s.r.size());
    REQUIRE(term.residual_view()->residuals(y, r.data(), nullptr));
    return r;
  };
  CHECK(residuals(x) == s.r);
  MatX differences(s.jacobian.rows(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    differences.col(i) =
        central_difference([&](double h) { return residuals(x + h * VecX::Unit(x.size(), i)); }, step);
  CHECK((differences - s.jacobian).cwiseAbs().maxCoeff() <= within * s.jacobian.cwiseAbs().maxCoeff());
}

// 1/2 |r|^2 - energy is the same number at x and at y, and J^T r the gradient.
void check_squares(const Term& term, const VecX& x, const VecX& y) {
  const Squares at_x = squares_of(term, x), at_y = squares_of(term, y);
  const double scale = std::abs(term.value(x)) + std::abs(term.value(y)) + at_x.value() + at_y.value();
  CHECK(std::abs((at_x.value() - term.value(x)) - (at_y.value() - term.value(y))) <= 1e-11 * scale);
  for (const auto& [squares, point] : {std::pair(&at_x, &x), std::pair(&at_y, &y)}) {
    const VecX gradient = dense_gradient(term, *point);
    // At rest both are round-off: the gradients of positions that are off in the last digits, through the same products |J|^T |J| |x|.
    // Four roundings: three products and the singular values; 0.84 is the most with either compiler.
    const MatX slopes = squares->jacobian.cwiseAbs();
    const VecX round_off = 4 * std::numeric_limits<double>::epsilon() * (slopes.transpose() * (slopes * point->cwiseAbs()));
    const VecX bound = round_off.array() + 1e-9 * gradient.lpNorm<Eigen::Infinity>();
    CHECK(((squares->gradient() - gradient).cwiseAbs().array() <= bound.array()).all());
  }
}

// Three small boxes around each other, askew; between two of them all edges are nearly parallel.
std::string cluster(const std::string& weights, int cells) {
  const std::string sliding = ", friction: {mu: 0.4, eps_v: 2e-3}, tangential_adhesion: {mu: 0.8, eps_a: 1e-3}}";
  return three_boxes(cells) +
         "contact:\n  distance: 0.025\n  safety_barrier: 1\n  weights: " + weights + "\n" +
         "  barrier: {type: clamped_log, stiffness: 1e3}\n"
         "  pairs:\n"
         "   - {between: [a, b], adhesion: {type: fang, young: 1e3, critical_strain: 0.5}" + sliding + "\n" +
         "   - {between: [b, c], adhesion: {type: fang, form: squared, young: 1e3, critical_strain: 0.5}" + sliding + "\n";
}

struct Cluster : TestScene {
  explicit Cluster(const std::string& weights, int cells = 1, double rough = 1e-3)
      : TestScene(cluster(weights, cells)) {
    x = world->rest + rough * random.vectors(world->rest.size());
    world->contact->begin_step({x});
    world->contact->move_to(x);
    world->friction->begin_step({x, 0, 0.5});
    world->friction->lag(x);
  }
  VecX moved(double by) { return x + by * random.vectors(x.size()); }

  RandomMotions random{11};
  VecX x;
};

}  // namespace

TEST_CASE("residual view of solids", "[residual_view]") {
  for (const Elements elements : {Elements::linear, Elements::composite, Elements::patches}) {
    const TetBody box(Vec3(0.1, 0.07, 0.05), {1, 1, 1}, elements);
    RandomMotions random(3);
    int views = 0;
    for (const ComponentVariant& v : variants<Energy>({{}, {{"poisson", "0"}}, {{"poisson", "0.45"}}, {{"stiffness", "1"}}, {{"modulus", "1e4"}}, {{"activation_energy", "6e4"}}, {{"modulus", "1e4"}, {"activation_energy", "6e4"}}})) {
      INFO(v.yaml << ", elements " << static_cast<int>(elements));
      const auto energy = component<Energy>(v.yaml);
      if (dynamic_cast<const EnergyWithUnknowns*>(energy.get())) continue;
      std::unique_ptr<Term> term;
      try {
        term = energy->make_term(box.body, box.rest);
      } catch (const InputError&) {
        continue;  // not for tets
      }
      if (!term->residual_view()) continue;
      ++views;
      for (const Vec3& s : {Vec3(1, 1, 1), Vec3(1.3, 1.3, 1.3), Vec3(0.3, 0.4, 5), Vec3(1.2, 1.2 + 1e-9, 0.9),
                            Vec3(0.96, 1.04, 1.051), Vec3(0.15, 0.2, 0.25)}) {
        INFO("stretches " << s.transpose());
        const Mat3 f = random.rotation() * s.asDiagonal() * random.rotation().transpose();
        const VecX x = box.deformed(f), y = x + 0.003 * s.minCoeff() * random.vectors(x.size());
        check_squares(*term, x, y);
        check_jacobian(*term, y, 1e-5 * s.minCoeff(), 1e-6);
      }
      VecX inverted = box.deformed(Vec3(1, 1, -1).asDiagonal());
      size_t rows = 0;
      for (const ResidualBatch& b : term->residual_view()->residual_batches()) rows += static_cast<size_t>(b.residuals) * b.count;
      std::vector<double> r(rows);
      CHECK_FALSE(term->residual_view()->residuals(inverted, r.data(), nullptr));
    }
    CHECK(views >= 9);
  }
}

TEST_CASE("residual view of contact", "[residual_view][contact]") {
  Cluster c("pair");  // no stencil of negative weight
  const Term& term = contact_term(*c.world);
  REQUIRE(c.world->contact->contacts().edge_edge.size() > 0);
  REQUIRE(c.world->contact->contacts().point_triangle.size() > 0);
  check_squares(term, c.x, c.moved(1e-3));
  check_squares(term, c.x, c.moved(3e-3));
  check_jacobian(term, c.x, 1e-7, 1e-5);
}

TEST_CASE("residual view of contact: energies without a lower bound are in the rest", "[residual_view][contact]") {
  Cluster c("area", 3, 4e-3);  // rough enough for hollows
  const ContactSet& set = c.world->contact->contacts();
  const auto negative = [](const auto& stencils) {
    return std::count_if(stencils.begin(), stencils.end(), [](const auto& s) { return s.weight < 0; });
  };
  REQUIRE(negative(set.point_point) + negative(set.point_edge) > 0);
  check_jacobian(contact_term(*c.world), c.x, 1e-7, 1e-5);
}

TEST_CASE("residual view of friction and tangential adhesion", "[residual_view][friction]") {
  // Slips from 0 to far above 2 eps h = 1e-3 m.
  for (const double slip : {0.0, 1e-6, 2e-4, 7e-4, 1e-2}) {
    INFO("slip " << slip);
    Cluster c("area");
    const VecX x = c.moved(slip);
    check_squares(*c.world->friction, x, c.moved(2e-4));
    if (slip > 0) check_jacobian(*c.world->friction, x, std::min(1e-8, 1e-3 * slip), 1e-5);
  }
}

TEST_CASE("terms without a least-squares view are refused by name", "[residual_view]") {
  const PolynomialTerm polynomial(2, {0, 1});
  const LinearTerm linear("gravity");
  CHECK(residual_views({&linear}, "test").size() == 1);
  CHECK_THROWS_WITH(residual_views({&linear, &polynomial}, "test"), Catch::Contains("'polynomial'"));
  const auto scene = [](const std::string& poisson, const std::string& solver) {
    TestScene("solver: {type: " + solver + "}\nobjects: [{name: box, shape: {type: box, size: [1, 1, 1]},\n"
              "  energies: [{type: neo_hookean, young: 1e5, poisson: " + poisson + "}]}]\n");
  };
  CHECK_NOTHROW(scene("0.3", "ceres_trust_region"));
  CHECK_NOTHROW(scene("-0.2", "projected_newton"));
  CHECK_THROWS_WITH(scene("-0.2", "ceres_trust_region"),
                    Catch::Contains("test.yaml:2") && Catch::Contains("'neo_hookean'"));
}
