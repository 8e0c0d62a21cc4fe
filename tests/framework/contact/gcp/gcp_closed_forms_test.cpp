// The Geometric Contact Potential against closed forms, and how far it is off where it does not meet
// them.
#include <catch2/catch.hpp>

#include "tests/framework/contact/gcp/gcp_scene.hpp"

using namespace tack;

namespace {

constexpr double range = 1e-3, side = 0.1;

// A plate of n x n cells over one twice as large with cells of the same size, shifted and turned.
SurfaceBuilder plates(int n, double turn, double gap) {
  SurfaceBuilder builder;
  builder.add_rectangle({2 * n, 2 * n}, 0, Vec3(-side, -side, 0), 2 * side, 2 * side);
  builder.add_grid({n, n}, 1, [=](double u, double v) {
    const double a = side * (v - 0.5) + 1.3e-3, b = side * (u - 0.5) + 2.1e-3;
    return Vec3(std::cos(turn) * a - std::sin(turn) * b, std::sin(turn) * a + std::cos(turn) * b, gap);
  });
  return builder;
}

struct PlateForce {
  double of_exact;          // normal force over area times pressure
  double lateral_per_normal;  // sum of magnitudes of lateral forces on vertices over the normal force
};
PlateForce plate_force(int n, double turn, double gap) {
  const SurfaceBuilder builder = plates(n, turn, gap);
  GcpScene scene(builder, range);
  const VecX force = scene.forces(builder.x());
  const Vec3 sum = force_on(scene.surface, force, 1);
  double lateral = 0;
  for (const int v : scene.surface.mesh.vertices)
    if (scene.surface.mesh.vertex_object[v] == 1) lateral += vertex(force, v).head<2>().norm();
  return {sum.z() / (-side * side * scene.barrier.at(gap).slope), lateral / sum.z()};
}

}  // namespace

TEST_CASE("gcp: plates press with the law times the area, up to the count of crossing edges", "[gcp]") {
  // Aligned: vertices count half the area. Edges: 2.35 times the area over 4 on grids with
  // alternating diagonals, more at the boundary.
  for (const double gap : {0.25e-3, 0.5e-3}) {
    CHECK(plate_force(8, 0, gap).of_exact == Approx(1.1006).epsilon(1e-3));
    CHECK(plate_force(16, 0, gap).of_exact == Approx(1.0920).epsilon(1e-3));
  }
  CHECK(plate_force(8, 0, 0.25e-3).lateral_per_normal < 1e-10);
  // Turned: edges cross in all directions, and vertices over edges count twice.
  CHECK(plate_force(8, 0.3, 0.5e-3).of_exact == Approx(1.1735).epsilon(1e-3));
  CHECK(plate_force(16, 0.3, 0.5e-3).of_exact == Approx(1.1611).epsilon(1e-3));
}

TEST_CASE("gcp: flat plates have lateral forces where vertices lie over edges", "[gcp]") {
  // Vertices and edges change their kinds within a tenth of the gap: lateral forces are 11 and 18%
  // of the normal force.
  CHECK(plate_force(8, 0.3, 0.5e-3).lateral_per_normal == Approx(0.110).epsilon(0.01));
  CHECK(plate_force(16, 0.3, 0.5e-3).lateral_per_normal == Approx(0.184).epsilon(0.01));
}

TEST_CASE("gcp: the energy of a tip that slides over a flat mesh nearly doubles at edges", "[gcp]") {
  SurfaceBuilder builder;
  builder.add_rectangle({10, 10}, 0, Vec3(-0.05, -0.05, 0), 0.1, 0.1);
  const int apex = add_tip(builder, {0, 0, 0.5 * range}, 0.01, 1);
  GcpScene scene(builder, range);
  double low = 1e9, high = 0, lateral = 0;
  for (int i = 0; i <= 400; ++i) {
    VecX x = builder.x();
    for (int v = apex; v < apex + 4; ++v) vertex(x, v) += Vec3(3e-4 + 5e-5 * i, 1.7e-3 + 1.5e-5 * i, 0);
    const VecX force = scene.forces(x);
    const double energy = scene.term.value(x);
    low = std::min(low, energy), high = std::max(high, energy);
    lateral = std::max(lateral, vertex(force, apex).head<2>().norm() / vertex(force, apex).z());
  }
  CHECK(low == Approx(0.25 * scene.contacts.rings().vertex_area(apex) * scene.barrier.at(0.5 * range).value));
  CHECK(high / low == Approx(1.95).epsilon(0.02));
  CHECK(lateral > 1);
}

TEST_CASE("gcp: an edge on a face presses at its ends and where it crosses edges", "[gcp]") {
  SurfaceBuilder builder;
  builder.add_rectangle({1, 1}, 0, Vec3(-0.1, -0.1, 0), 0.2, 0.2);
  const double gap = 0.4 * range;
  // A roof upside down: its ridge from a to b, parallel to the floor, across the diagonal.
  const int a = builder.add_vertex({-0.03, 0.031, gap}, 1), b = builder.add_vertex({0.041, -0.03, gap}, 1),
            c = builder.add_vertex({0.05, 0.05, 0.05}, 1), d = builder.add_vertex({-0.05, -0.05, 0.05}, 1);
  builder.add_triangle({a, c, b});
  builder.add_triangle({a, b, d});
  builder.add_triangle({b, c, d});
  builder.add_triangle({a, d, c});
  GcpScene scene(builder, range);
  const double value = scene.value(builder.x());
  REQUIRE(scene.count(GcpKind::vertex_face) == 2);
  REQUIRE(scene.count(GcpKind::edge_edge) == 1);
  double weight = 0;
  for (const GcpStencil& s : scene.contacts.stencils().stencils) weight += s.weight;
  CHECK(value == Approx(weight * scene.barrier.at(gap).value));
}

TEST_CASE("gcp: nothing presses through a thin plate", "[gcp]") {
  for (const bool sheet : {false, true}) {
    SurfaceBuilder builder;
    builder.add_rectangle({2, 2}, 0, Vec3(-0.1, -0.1, 0), 0.2, 0.2, false, sheet);  // normal downwards
    add_tip(builder, {0.01, 0.02, 0.5 * range}, 0.01, 1);
    GcpScene scene(builder, range);
    CHECK((scene.value(builder.x()) > 0) == sheet);
  }
}

TEST_CASE("gcp: an object alone is free of forces at rest, and presses when it is folded further", "[gcp]") {
  for (const double wide : {2e-3, 0.01, 0.05}) {
    SurfaceBuilder box;
    add_fine_box(box, {0, 0, 0}, 0.1, 6, 0, Mat3::Identity());
    GcpScene of_box(box, wide);
    CHECK(of_box.value(box.x()) == 0);
    CHECK(of_box.contacts.stencils().stencils.empty());
    SurfaceBuilder fold;
    fold.scene = scenes::folded_sheet(12, 0.02);
    fold.two_sided.assign(fold.scene.mesh.triangles.size(), 1);
    fold.rod_width = fold.particle_radius = {0};
    GcpScene of_fold(fold, wide);
    CHECK(of_fold.value(fold.x()) == 0);
    // Layers 20 mm apart at rest press below half of that, or below the range.
    const double from = std::min(wide, 0.01);
    for (const double gap : {1.01 * from, 0.9 * from}) {
      VecX x = fold.x();
      for (int v = 0; v < x.size() / 3; ++v) vertex(x, v).z() *= gap / 0.02;
      CHECK((of_fold.value(x) > 0) == (gap < from));
    }
  }
}

TEST_CASE("gcp: a vertex, an edge and a face that approach each other have a barrier", "[gcp]") {
  SurfaceBuilder builder;
  builder.add_rectangle({4, 4}, 0, Vec3(-0.05, -0.05, 0), 0.1, 0.1);
  const int apex = add_tip(builder, {0, 0, range}, 0.01, 1);
  GcpScene scene(builder, range);
  // Over a face, an edge and a vertex.
  for (const Vec3& at : {Vec3(0.011, 0.003, 0), Vec3(0.0125, 0, 0), Vec3(0, 0, 0)}) {
    double last = 0;
    for (const double gap : {0.5, 0.1, 1e-3, 1e-6, 1e-9}) {
      VecX x = builder.x();
      for (int v = apex; v < apex + 4; ++v) vertex(x, v) += at + Vec3(0, 0, (gap - 1) * range);
      const double energy = scene.value(x);
      CHECK(energy > last);
      CHECK(energy >= 0.24 * scene.contacts.rings().vertex_area(apex) * scene.barrier.at(gap * range).value);
      last = energy;
    }
  }
}
