// Properties of composite tets beyond those of all solids (solids_test.cpp).
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "energies/solid/composite_samples.hpp"
#include "framework/scene/energy.hpp"
#include "geometry/tet_edges.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/published.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

const std::vector<std::string> materials = {"neo_hookean, young: 1e5, poisson: 0.3", "neo_hookean, young: 1e5, poisson: 0.4999",
                                            "stvk_hencky, young: 1e5, poisson: 0.45", "fixed_corotated, young: 1e5, poisson: 0.45",
                                            "fixed_corotated, young: 1e5, poisson: -0.2", "von_mises, young: 1e5, poisson: 0.45, yield_stress: 1e9"};

std::unique_ptr<Term> term_of(const std::string& material, const TetBody& box) {
  return component<Energy>("{type: " + material + "}")->make_term(box.body, box.rest);
}

Mat3 some_deformation(RandomMotions& random) {
  Mat3 f = Mat3::Identity();
  for (int i = 0; i < 9; ++i) f(i) += 0.2 * random.uniform(-1, 1);
  return f;
}

}  // namespace

TEST_CASE("composite tets: weights of samples reproduce linear functions", "[composite]") {
  const CompositeTable& table = composite_table();
  // The nodes of the reference tet: the deformation of each sample of x = A X + b is A, that of a quadratic map its mean over the parts.
  std::array<Vec3, composite_nodes> nodes{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  for (size_t e = 0; e < composite_edges.size(); ++e) nodes[4 + e] = (nodes[composite_edges[e][0]] + nodes[composite_edges[e][1]]) / 2;
  RandomMotions random(1);
  const Mat3 a = some_deformation(random);
  const auto map = [&](const Vec3& x, double bent) -> Vec3 { return a * x + bent * Vec3(x.y() * x.y(), x.z() * x.x(), x.y() * x.z()) + Vec3(1, 2, 3); };
  for (const double bent : {0.0, 0.3}) {
    Mat3 of_points = Mat3::Zero(), of_parts = Mat3::Zero();
    for (int k = 0; k < composite_samples; ++k) {
      Mat3 f = Mat3::Zero();
      if (k < composite_points)
        for (int n = 0; n < composite_nodes; ++n) f += map(nodes[n], bent) * Eigen::Map<const Vec3>(table.point[k][n].data()).transpose();
      else
        for (int i = 0; i < 4; ++i)
          f += map(nodes[composite_tets[k - composite_points][i]], bent) * Eigen::Map<const Vec3>(table.part[k - composite_points][i].data()).transpose();
      if (bent == 0) CHECK((f - a).norm() <= 1e-14);
      (k < composite_points ? of_points : of_parts) += f / (k < composite_points ? composite_points : composite_parts);
    }
    CHECK((of_points - of_parts).norm() <= 1e-14);
  }
}

TEST_CASE("composite tets: homogeneous deformations have the energy of linear tets and balanced inner nodes", "[composite]") {
  const Vec3 size(0.1, 0.07, 0.05);
  const TetBody composite(size, {2, 2, 2}, Elements::composite), linear(size, {2, 2, 2});
  RandomMotions random(2);
  for (const std::string& material : materials) {
    INFO(material);
    const auto term = term_of(material, composite), plain = term_of(material, linear);
    for (int trial = 0; trial < 5; ++trial) {
      const Mat3 f = some_deformation(random);
      const VecX x = composite.deformed(f), gradient = dense_gradient(*term, x);
      // The parts of fixed_corotated are neo-Hookean.
      if (material.find("fixed_corotated") != 0) CHECK(term->value(x) == Approx(plain->value(linear.deformed(f))).epsilon(1e-11));
      const double largest = gradient.lpNorm<Eigen::Infinity>();
      for (int v = 0; v < composite.body.vertex_count; ++v) {
        const Vec3 at = vertex(composite.rest, v);
        if ((at.cwiseAbs() - size / 2).maxCoeff() > -1e-9) continue;
        CHECK(vertex(gradient, v).norm() <= 1e-12 * largest);
      }
      const auto stress = [](const Term& t, const VecX& y) {
        Records records;
        records.publish(t);
        return records.stresses()[0].values(y);
      };
      const std::vector<Mat3> of_parts = stress(*term, x), of_tets = stress(*plain, linear.deformed(f));
      REQUIRE(of_parts.size() == composite.body.tets.size());
      for (const Mat3& s : of_parts) CHECK((s - of_tets[0]).norm() <= 1e-9 * of_tets[0].norm());
    }
  }
}

TEST_CASE("composite tets: six modes cost nothing, all others do", "[composite]") {
  for (const std::array<int, 3>& cells : {std::array{1, 1, 1}, std::array{2, 1, 1}}) {
    const TetBody box(Vec3(cells[0], cells[1], cells[2]), cells, Elements::composite);
    for (const std::string& material : materials) {
      INFO(material);
      const MatX k = dense_hessian(*term_of(material, box), box.rest, Projection::none);
      const VecX values = Eigen::SelfAdjointEigenSolver<MatX>(k, Eigen::EigenvaluesOnly).eigenvalues();
      CHECK(std::abs(values(5)) <= 1e-10 * values(values.size() - 1));
      CHECK(values(6) >= 0.01 * 1e5 / 3);  // m: stiffness of a soft mode of a cell of 1 m, over mu
    }
  }
}

TEST_CASE("composite tets: a flattened part has unbounded energy, for any material", "[composite]") {
  const TetBody box(Vec3(1, 1, 1), {1, 1, 1}, Elements::composite);
  for (const std::string& material : materials) {
    INFO(material);
    const auto term = term_of(material, box);
    // The first corner of a tet is moved towards the middles of its edges.
    const Tet part = box.body.tets[0];
    const Vec3 corner = vertex(box.rest, part[0]), opposite = (vertex(box.rest, part[1]) + vertex(box.rest, part[2]) + vertex(box.rest, part[3])) / 3;
    const auto at = [&](double way) {
      VecX x = box.rest;
      vertex(x, part[0]) = corner + way * (opposite - corner);
      return x;
    };
    CHECK(std::isinf(term->value(at(1.001))));
    CHECK(std::isinf(term->value(at(1))));
    // The slope grows as the height vanishes.
    const auto force = [&](double left) { return vertex(dense_gradient(*term, at(1 - left)), part[0]).norm(); };
    CHECK(force(1e-6) > 50 * force(1e-3));
  }
}

TEST_CASE("composite tets: plastic flow is homogeneous where the deformation is", "[composite][von_mises]") {
  const Vec3 size(0.1, 0.07, 0.05);
  const TetBody composite(size, {1, 1, 1}, Elements::composite), linear(size, {1, 1, 1});
  const std::string material = "von_mises, young: 1e6, poisson: 0.3, yield_stress: 2e3, hardening: 1e5";
  const auto term = term_of(material, composite), plain = term_of(material, linear);
  RandomMotions random(6);
  History of_term, of_plain;
  for (int step = 0; step < 4; ++step) {
    const Mat3 f = some_deformation(random);
    const VecX x = composite.deformed(f), y = linear.deformed(f);
    CHECK(term->value(x) == Approx(plain->value(y)).epsilon(1e-10));
    const double work = Published(*plain).flow("dissipated_plastic", y);
    CHECK(work > 0);
    CHECK(Published(*term).flow("dissipated_plastic", x) == Approx(work).epsilon(1e-10));
    const double before = term->value(x);
    term->commit(x, of_term);
    plain->commit(y, of_plain);
    term->load_history(of_term);
    plain->load_history(of_plain);
    CHECK(before - term->value(x) == Approx(work).epsilon(1e-9));
    const VecX strain = Published(*term).field("plastic_strain");
    REQUIRE(strain.size() == static_cast<Eigen::Index>(composite.body.tets.size()));
    CHECK((strain.array() - Published(*plain).field("plastic_strain")(0)).abs().maxCoeff() <= 1e-12);
  }
  // Derivatives after plastic flow, on both sides of the yield surface of parts and points.
  const double step_size = 1e-7;
  const VecX x = composite.deformed(some_deformation(random)) + 1e-3 * random.vectors(composite.rest.size());
  const MatX hessian = dense_hessian(*term, x, Projection::none);
  const double stiffness = hessian.cwiseAbs().maxCoeff();
  const VecX gradient = dense_gradient(*term, x), slopes = gradient_by_differences([&](const VecX& y) { return term->value(y); }, x, step_size);
  CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-5 * stiffness * step_size + 1e-13 * term->value(x) / step_size);
  CHECK((hessian_by_differences([&](const VecX& y) { return dense_gradient(*term, y); }, x, step_size) - hessian).cwiseAbs().maxCoeff() <= 1e-6 * stiffness);
}
