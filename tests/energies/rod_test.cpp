// The energy of rods: derivatives, motions without energy, and energies of simple shapes.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numbers>

#include "energies/rod/rod_term.hpp"
#include "framework/assembly/stencil_clamp.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/rod_body.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;
using std::numbers::pi;

namespace {

const RodSection flat{0, 0.03, 0.02, Vec3(0, 0, 1)};
const RodMaterial material{50, {0.7, 1.1, 0.5}};

// A loop, a joint of four edges with acute angles between some, a free end; edges of any direction.
struct Tangle {
  Tangle()
      : rod({{0, 0, 0}, {0.3, 0.1, 0.05}, {0.5, -0.1, 0.1}, {0.4, -0.4, -0.1}, {0.1, -0.3, 0.02}, {0.45, 0.3, 0.2}, {0.7, 0.35, 0.1}, {0.42, 0.18, -0.03}},
            {{0, 1}, {2, 1}, {2, 3}, {4, 3}, {4, 0}, {1, 5}, {6, 5}, {7, 1}}, flat),
        term("elastic_rod", "rod/energies/0/", material, {}, rod.body.edges, rod.frames, rod.rest) {}

  VecX disturbed(double size) {
    VecX x = rod.rest;
    for (int v = 0; v < rod.body.vertex_count; ++v) vertex(x, v) += size * random.vector();
    for (const int v : rod.frames->twists()) x(3 * v) += rod.frames->radius() * random.uniform(-10 * size, 10 * size);
    return x;
  }

  RandomMotions random{5};
  RodBody rod;
  RodTerm term;
};

void check_derivatives(const RodBody& rod, const RodTerm& term, const VecX& x) {
  const VecX slopes = gradient_by_differences([&](const VecX& y) { return term.value(y); }, x, 1e-4);
  const VecX gradient = dense_gradient(term, x);
  CHECK((slopes - gradient).norm() <= 1e-8 * slopes.norm() + 1e-7);
  const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(term, y); }, x, 1e-4);
  const MatX exact = dense_hessian(term, x, Projection::none);
  CHECK((curvatures - exact).norm() <= 1e-7 * curvatures.norm());
  // Forces are balanced.
  Vec3 force = Vec3::Zero();
  for (int v = 0; v < rod.body.vertex_count; ++v) force += vertex(gradient, v);
  CHECK(force.norm() <= 1e-12 * gradient.norm());
  for (const Projection projection : {Projection::clamp, Projection::absolute})
    for_each_stencil_hessian(term, x, projection, [&](const MatX& h, const int* v) {
      if (h.rows() < 15) return;
      const double size = h.norm();
      CHECK(smallest_eigenvalue(h) >= -1e-12 * size);
      for (int i = 0; i < 15; ++i) CHECK(std::abs(h(i, 0) + h(i, 3) + h(i, 6)) <= 1e-12 * size);
      for (const int twist : {3, 4}) CHECK(h.middleRows(3 * twist + 1, 2).isZero());
      CHECK(rod.frames->is_twist(v[4]));
    });
  MatX sum = MatX::Zero(x.size(), x.size());
  for_each_stencil_hessian(term, x, Projection::none, [&](const MatX& h, const int* v) {
    const MatX p = projected(h, Projection::clamp);
    for (int i = 0; i < h.rows() / 3; ++i)
      for (int j = 0; j < h.rows() / 3; ++j) sum.block<3, 3>(3 * v[i], 3 * v[j]) += p.block<3, 3>(3 * i, 3 * j);
  });
  CHECK((sum - dense_hessian(term, x, Projection::clamp)).norm() <= 1e-10 * sum.norm());
}

}  // namespace

TEST_CASE("rods: derivatives at rest, bent and twisted", "[rod]") {
  Tangle t;
  check_derivatives(t.rod, t.term, t.rod.rest);
  check_derivatives(t.rod, t.term, t.disturbed(0.03));
  check_derivatives(t.rod, t.term, t.disturbed(0.08));
}

TEST_CASE("rods: derivatives far from the frames that were committed, and after several turns", "[rod]") {
  Tangle t;
  VecX x = t.disturbed(0.05);
  const Mat3 r = Eigen::AngleAxisd(2.2, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  check_derivatives(t.rod, t.term, t.rod.moved(x, r, Vec3(1, 0, 2)));
  // Ten turns between the ends of the free arm, committed now and then.
  for (int i = 1; i <= 40; ++i) {
    x(3 * t.rod.frames->twists()[6]) += t.rod.frames->radius() * pi / 2;
    if (i % 3 == 0) t.rod.commit(x, t.term);
  }
  check_derivatives(t.rod, t.term, x);
  check_derivatives(t.rod, t.term, t.rod.moved(x, r, Vec3::Zero()));
  const VecX gradient = dense_gradient(t.term, x);
  const double moment = gradient(3 * t.rod.frames->twists()[6]) * t.rod.frames->radius();
  CHECK(std::abs(moment) > 18 * pi * material.bending.z() / 0.4);
}

TEST_CASE("rods: rigid motions cost nothing, with or without commits in between", "[rod]") {
  Tangle t;
  CHECK(t.term.value(t.rod.rest) < 1e-26);
  const VecX bent = t.disturbed(0.05);
  const double energy = t.term.value(bent);
  VecX x = t.rod.rest, y = bent;
  for (int i = 0; i < 12; ++i) {
    const Mat3 r = Eigen::AngleAxisd(1.1, t.random.vector().normalized()).toRotationMatrix();
    x = t.rod.moved(x, r, t.random.vector());
    y = bent;
    CHECK(t.term.value(x) < 1e-24 * (1 + i));
    t.rod.commit(x, t.term);
    CHECK(t.term.value(x) < 1e-24 * (1 + i));
  }
  t.rod.frames->load_history({});
  t.term.load_history({});
  for (int i = 0; i < 12; ++i) {
    y = t.rod.moved(y, Eigen::AngleAxisd(1.1, t.random.vector().normalized()).toRotationMatrix(), t.random.vector());
    CHECK(t.term.value(y) == Approx(energy).epsilon(1e-11));
    t.rod.commit(y, t.term);
    CHECK(t.term.value(y) == Approx(energy).epsilon(1e-11));
  }
  // Moments of forces and twists add up to zero too.
  const VecX gradient = dense_gradient(t.term, y);
  Vec3 moment = Vec3::Zero();
  for (int v = 0; v < t.rod.body.vertex_count; ++v) moment += Vec3(vertex(y, v)).cross(Vec3(vertex(gradient, v)));
  for (int e = 0; e < t.rod.frames->count(); ++e)
    moment += t.rod.frames->radius() * gradient(3 * t.rod.frames->twists()[e]) * t.rod.frames->tangent(e, y);
  CHECK(moment.norm() < 1e-11 * gradient.norm() * y.norm());
}

TEST_CASE("rods: stencils are clamped in their slots as the term projects them", "[rod]") {
  Tangle t;
  const VecX x = t.disturbed(0.08);
  const StencilBatch batch = t.term.batches()[1];
  const std::vector<char> movable(x.size() / 3, 1);
  const DofMap dofs(movable);
  const size_t gradients = 6 * t.rod.body.edges.size() + 15 * batch.count, springs = 27 * t.rod.body.edges.size();
  std::vector<double> gradient(gradients), exact(springs + 135 * batch.count), clamped(exact.size());
  t.term.derivatives(x, Projection::none, gradient.data(), exact.data());
  t.term.derivatives(x, Projection::clamp, gradient.data(), clamped.data());
  CHECK(exact != clamped);
  clamp_stencils(batch, 0, batch.count, std::vector<char>(x.size() / 3, 1), dofs, exact.data() + springs);
  double off = 0, largest = 0;
  for (size_t i = springs; i < exact.size(); ++i) {
    off = std::max(off, std::abs(exact[i] - clamped[i]));
    largest = std::max(largest, std::abs(clamped[i]));
  }
  CHECK(off <= 1e-12 * largest);
}

TEST_CASE("rods as least squares", "[rod]") {
  Tangle t;
  const VecX x = t.disturbed(0.06);
  const auto batches = t.term.residual_batches();
  REQUIRE(batches.size() == 2);
  const int edges = batches[0].count, pairs = batches[1].count;
  std::vector<double> r(edges + 3 * pairs), jacobian(6 * edges + 45 * pairs);
  REQUIRE(t.term.residuals(x, r.data(), jacobian.data()));
  VecX gradient = VecX::Zero(x.size());
  double sum = 0;
  const double *residual = r.data(), *row = jacobian.data();
  for (const ResidualBatch& b : batches)
    for (int s = 0; s < b.count; ++s)
      for (int i = 0; i < b.residuals; ++i, ++residual, row += 3 * b.arity) {
        sum += *residual * *residual / 2;
        for (int k = 0; k < b.arity; ++k) vertex(gradient, b.vertices[b.arity * s + k]) += *residual * Eigen::Map<const Vec3>(row + 3 * k);
      }
  CHECK(sum == Approx(t.term.value(x)).epsilon(1e-12));
  CHECK((gradient - dense_gradient(t.term, x)).norm() <= 1e-12 * gradient.norm());
}

TEST_CASE("rods: an edge that turns by half a turn or more has an infinite energy", "[rod]") {
  Tangle t;
  VecX x = t.rod.rest;
  vertex(x, 6) = 2 * vertex(x, 5) - vertex(x, 6);
  CHECK(t.term.value(x) == std::numeric_limits<double>::infinity());
}

TEST_CASE("rods: energies of bending, twisting and stretching", "[rod]") {
  // A straight rod on uneven edges, bent to 2 tan(phi / 2) at each vertex in both directions.
  const std::vector<Vec3> line = {{0, 0, 0}, {0.1, 0, 0}, {0.3, 0, 0}, {0.45, 0, 0}};
  RodBody rod(line, {{0, 1}, {2, 1}, {2, 3}}, {0, 0.03, 0.02, Vec3(0, 1, 0)});
  RodTerm term("elastic_rod", "m", material, {}, rod.body.edges, rod.frames, rod.rest);
  const double phi = 0.4, kappa = 2 * std::tan(phi / 2);
  for (const auto& [axis, stiffness] : {std::pair{Vec3(0, 0, 1), 0.7}, {Vec3(0, 1, 0), 1.1}}) {
    VecX x = rod.rest;
    for (int v = 2; v < 4; ++v) vertex(x, v) = line[1] + Eigen::AngleAxisd(phi, axis) * (line[v] - line[1]);
    CHECK(term.value(x) == Approx(stiffness * kappa * kappa / (2 * 0.15)).epsilon(1e-12));
  }
  VecX x = rod.rest;
  x(3 * rod.frames->twists()[2]) = rod.frames->radius() * 0.9;
  CHECK(term.value(x) == Approx(0.5 * 0.81 / (2 * 0.175)).epsilon(1e-12));
  x(3 * rod.frames->twists()[1]) = -rod.frames->radius() * 0.2;  // of an edge that is stored backwards
  CHECK(term.value(x) == Approx(0.5 * (0.49 / (2 * 0.175) + 0.04 / (2 * 0.15))).epsilon(1e-12));
  x = rod.rest;
  x(9) += 0.003;
  CHECK(term.value(x) == Approx(50 * 9e-6 / (2 * 0.15)).epsilon(1e-9));

  // A curvature and a twist at rest.
  RodTerm curved("elastic_rod", "m", material, {false, {0.5, 0}, 0}, rod.body.edges, rod.frames, rod.rest);
  CHECK(curved.value(rod.rest) == Approx(0.7 * 0.25 * (0.15 + 0.175) / 2).epsilon(0.01));
  RodTerm twisted("elastic_rod", "m", material, {false, Vec2::Zero(), 2}, rod.body.edges, rod.frames, rod.rest);
  CHECK(twisted.value(rod.rest) == Approx(0.5 * 4 * (0.15 + 0.175) / 2));
}

TEST_CASE("rods: a bent mesh that is straight at rest", "[rod]") {
  RodBody rod({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1}, {1, 2}}, {0, 0.03, 0.02, Vec3(0, 0, 1)});
  CHECK(RodTerm("r", "m", material, {}, rod.body.edges, rod.frames, rod.rest).value(rod.rest) < 1e-28);
  CHECK(RodTerm("r", "m", material, {true}, rod.body.edges, rod.frames, rod.rest).value(rod.rest) == Approx(1.1 * 4 / 2));
}

// A weld of three equal edges: one arm under a moment, the others clamped at their far ends. The node, with half an edge to each
// side, has 1/k = L / 2B for the arm and half of that for the two others together.
TEST_CASE("rods: a joint is as stiff as a weld of the halves of its edges", "[rod]") {
  const double h = 0.1;
  RodBody rod({{0, 0, 0}, {h, 0, 0}, {-h / 2, h * std::sqrt(0.75), 0}, {-h / 2, -h * std::sqrt(0.75), 0}}, {{0, 1}, {0, 2}, {3, 0}},
              {0.01}, {Vec3::UnitZ(), Vec3::UnitZ(), Vec3::UnitZ()});
  const double b = 0.3;
  RodTerm term("r", "m", {100, {b, b, b}}, {}, rod.body.edges, rod.frames, rod.rest);
  // Turn the arm out of the plane, about an axis at right angles to it.
  const double angle = 1e-4;
  VecX x = rod.rest;
  vertex(x, 1) = Eigen::AngleAxisd(angle, Vec3::UnitY()) * Vec3(vertex(x, 1));
  const double moment_per_angle = 2 * term.value(x) / (angle * angle);
  CHECK(moment_per_angle == Approx(b / (h / 2 + h / 4)).epsilon(1e-5));
  CHECK(term.value(rod.rest) < 1e-28);
}

TEST_CASE("rods: small bending of a corner costs as much as that of a straight rod", "[rod]") {
  // Turned at rest by 70 degrees; then by a little more about each axis.
  const double turn = 1.2, angle = 1e-5, b = 0.4;
  RodBody rod({{-1, 0, 0}, {0, 0, 0}, {std::cos(turn), std::sin(turn), 0}}, {{0, 1}, {1, 2}}, {0.01}, {Vec3::UnitZ(), Vec3::UnitZ()});
  RodTerm term("r", "m", {100, {b, b, b}}, {}, rod.body.edges, rod.frames, rod.rest);
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(0.6, 0, 0.8)}) {
    VecX x = rod.rest;
    const Mat3 r = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    vertex(x, 2) = r * vertex(x, 2);
    const int twist = rod.frames->twists()[1];
    x(3 * twist) = rod.frames->radius() * rod.frames->angle_to(1, x, r * rod.frames->director(1, rod.rest));
    CHECK(term.value(x) == Approx(b * angle * angle / 2).epsilon(1e-4));
  }
}

TEST_CASE("sections of rods", "[rod]") {
  const RodSection circle{0.2};
  CHECK(circle.area() == Approx(pi * 0.04));
  CHECK(circle.torsion_constant() == Approx(circle.moment_across() + circle.moment_along()));
  CHECK(circle.radius_of_gyration() == Approx(0.2 / std::sqrt(2.0)));
  // Timoshenko and Goodier, table of section 109: J = k a b^3 for sides a >= b.
  const auto torsion = [](double ratio) { return RodSection{0, ratio, 1, Vec3::UnitY()}.torsion_constant() / ratio; };
  CHECK(torsion(1) == Approx(0.1406).epsilon(5e-4));
  CHECK(torsion(2) == Approx(0.229).epsilon(2e-3));
  CHECK(torsion(10) == Approx(0.312).epsilon(2e-3));
  const RodSection upright{0, 1, 3, Vec3::UnitY()}, lying{0, 3, 1, Vec3::UnitY()};
  CHECK(upright.torsion_constant() == lying.torsion_constant());
  CHECK(upright.moment_across() == Approx(2.25));
  CHECK(upright.moment_across() == lying.moment_along());
}

TEST_CASE("rods: stiffness and length of pairs", "[rod]") {
  RodBody rod({{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {1, 0, 4}}, {{0, 1}, {1, 2}}, flat);
  const std::vector<RodPair> two = rod_pairs({{0, 1}, {1, 2}}, rod.rest);
  REQUIRE(two.size() == 1);
  CHECK(two[0].length == Approx(1.5));
  CHECK_FALSE(two[0].joint);
  const std::vector<RodPair> three = rod_pairs({{0, 1}, {1, 2}, {3, 1}}, rod.rest);
  REQUIRE(three.size() == 3);
  for (const RodPair& pair : three) CHECK(pair.joint);
  // Springs of 2 / L to a node, without the node: k_i k_j / sum.
  CHECK(1 / three[0].length == Approx(2.0 * 1.0 / 3.5));
  CHECK(1 / three[1].length == Approx(2.0 * 0.5 / 3.5));
  CHECK(1 / three[2].length == Approx(1.0 * 0.5 / 3.5));
}
