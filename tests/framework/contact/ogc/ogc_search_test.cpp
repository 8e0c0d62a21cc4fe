// Offset Geometric Contact against closed forms, and how far it is off where it does not meet them.
#include "framework/contact/ogc/ogc_search.hpp"

#include <catch2/catch.hpp>

#include "framework/contact/ogc/feasible_cones.hpp"
#include "framework/contact/surface/rest_gaps.hpp"
#include "framework/contact/stencils/stencil_energy.hpp"
#include "geometry/distance/squared_distance.hpp"
#include "tests/framework/contact/model_scene.hpp"
#include "tests/framework/contact/ogc/displacement_bounds.hpp"
#include "tests/support/dense_term.hpp"

using namespace tack;

namespace {

constexpr double range = 1e-3, side = 0.1;

struct OgcScene : ModelScene {
  explicit OgcScene(const SurfaceBuilder& builder, double of_law = range) : ModelScene(builder, of_law), rings(surface) {
    surface.rest_gaps = std::make_shared<RestGaps>(surface, pairs);
  }
  void move_to(const VecX& x) {
    const std::vector<char> every;
    find_ogc_contacts({surface, rings, pairs, every}, candidates_at(x), x, contacts);
  }
  // Calls act(kind, stencil, gap, law sample, mollifier threshold) for each stencil.
  template <class Act>
  void for_each_stencil(const VecX& x, const Act& act) {
    move_to(x);
    for_each_kind(contacts, [&](auto kind, const auto& stencils, const double* thresholds) {
      for (size_t i = 0; i < stencils.size(); ++i) {
        const double gap = std::sqrt(stencil_distance<ValueKernels>(kind, x, stencils[i]));
        act(kind, stencils[i], gap, pairs.laws()[stencils[i].law].at(gap), thresholds ? thresholds[i] : 0);
      }
    });
  }
  // Energies of stencils of points, and of edges.
  std::array<double, 2> values(const VecX& x) {
    std::array<double, 2> sums{};
    for_each_stencil(x, [&](auto kind, const auto& s, double, const LawSample& l, double eps) {
      double energy = s.weight * l.value;
      if constexpr (std::is_same_v<decltype(kind), EdgeEdgeKind>) {
        const auto [a, b, c, d] = corners(x, s.vertices);
        sums[1] += energy * edge_edge_mollifier(a, b, c, d, eps);
      } else {
        sums[0] += energy;
      }
    });
    return sums;
  }
  double value(const VecX& x) { return values(x)[0] + values(x)[1]; }
  VecX forces(const VecX& x, bool with_edges = true) {
    VecX force = VecX::Zero(x.size());
    for_each_stencil(x, [&](auto kind, const auto& s, double gap, const LawSample& l, double eps) {
      if (std::is_same_v<decltype(kind), EdgeEdgeKind> && !with_edges) return;
      const auto g = StencilEnergy<decltype(kind)>::gradient(x, s, l, gap, eps);
      for (size_t k = 0; k < s.vertices.size(); ++k) vertex(force, s.vertices[k]) -= g.template segment<3>(3 * k);
    });
    return force;
  }

  SurfaceRings rings;
  ContactSet contacts;
};

// Energies of a tip that slides at half the range over a surface along a line, relative to one contact.
struct Slide {
  double low = 1e9, high = 0, lateral = 0;  // of pairs of points; lateral: largest lateral over normal force of the tip
  double edges = 0, lateral_with_edges = 0;
};
Slide slide(const SurfaceBuilder& builder, const Vec3& from, const Vec3& to, const std::function<double(const Vec3&)>& height, int apex) {
  OgcScene scene(builder);
  const double one = 0.25 * scene.rings.vertex_area(apex) * scene.barrier.at(0.5 * range).value;
  Slide found;
  for (int i = 0; i <= 500; ++i) {
    VecX x = builder.x();
    const Vec3 at = from + i / 500.0 * (to - from);
    const Vec3 shift = Vec3(at.x(), at.y(), height(at)) - vertex(x, apex);
    for (int v = apex; v < apex + 4; ++v) vertex(x, v) += shift;
    const auto [of_points, of_edges] = scene.values(x);
    found.low = std::min(found.low, of_points / one), found.high = std::max(found.high, of_points / one);
    found.edges = std::max(found.edges, of_edges / one);
    for (const bool edges : {false, true}) {
      const Vec3 force = vertex(scene.forces(x, edges), apex);
      double& largest = edges ? found.lateral_with_edges : found.lateral;
      largest = std::max(largest, force.head<2>().norm() / force.z());
    }
  }
  return found;
}

}  // namespace

TEST_CASE("ogc: plates press with the law times the area, up to the count of crossing edges", "[ogc]") {
  for (const double gap : {0.25e-3, 0.5e-3}) {
    for (const auto& [n, of_exact] : {std::pair{8, 1.1006}, {16, 1.0920}}) {
      SurfaceBuilder builder;
      builder.add_rectangle({2 * n, 2 * n}, 0, Vec3(-side, -side, 0), 2 * side, 2 * side);
      builder.add_grid({n, n}, 1, [=](double u, double v) { return Vec3(side * (v - 0.5) + 1.3e-3, side * (u - 0.5) + 2.1e-3, gap); });
      OgcScene scene(builder);
      const VecX force = scene.forces(builder.x());
      const Vec3 sum = force_on(scene.surface, force, 1);
      CHECK(sum.z() / (-side * side * scene.barrier.at(gap).slope) == Approx(of_exact).epsilon(1e-3));
      double lateral = 0;
      for (int v = 0; v < force.size() / 3; ++v) lateral += vertex(force, v).head<2>().norm();
      CHECK(lateral < 1e-12 * sum.z());
    }
  }
}

TEST_CASE("ogc: a tip that slides over a flat mesh keeps its energy, without lateral force", "[ogc]") {
  SurfaceBuilder builder;
  builder.add_rectangle({10, 10}, 0, Vec3(-0.05, -0.05, 0), 0.1, 0.1);
  const int apex = add_tip(builder, {0, 0, 0.5 * range}, 0.01, 1);
  const Slide found = slide(builder, {-0.02, 0.003, 0}, {0.02, 0.0065, 0}, [](const Vec3&) { return 0.5 * range; }, apex);
  CHECK(found.low == Approx(1));
  CHECK(found.high == Approx(1));
  CHECK(found.lateral < 1e-12);
  // Its steep edges press on the edges of the mesh that it passes.
  CHECK(found.edges == Approx(0.0753).epsilon(0.01));
  CHECK(found.lateral_with_edges == Approx(0.0797).epsilon(0.01));
}

TEST_CASE("ogc: a vertex has one contact with a flat mesh, also where cells are smaller than the range", "[ogc]") {
  SurfaceBuilder builder;
  builder.add_rectangle({12, 12}, 0, Vec3(-2.4e-3, -2.4e-3, 0), 4.8e-3, 4.8e-3);
  const int apex = add_tip(builder, {0, 0, 0.5 * range}, 0.01, 1);
  OgcScene scene(builder);
  RandomPoints random(3);
  for (int trial = 0; trial < 100; ++trial) {
    VecX x = builder.x();
    Vec3 at(random.uniform(-1e-3, 1e-3), random.uniform(-1e-3, 1e-3), 0);
    if (trial % 4 == 0) at.x() = 0.4e-3 * random.index(3);  // over edges
    for (int v = apex; v < apex + 4; ++v) vertex(x, v) += at;
    scene.move_to(x);
    int count = 0;
    for_each_kind(scene.contacts, [&](auto kind, const auto& stencils, const double*) {
      if constexpr (decltype(kind)::first_vertices == 1)
        for (const auto& s : stencils) count += s.vertices[0] == apex;
    });
    CHECK(count == 1);
    CHECK(scene.contacts.point_point.empty());  // no vertex of the plate has the tip straight above it
  }
}

TEST_CASE("ogc: a tip around a ridge keeps its energy; in a valley the energy jumps by one contact", "[ogc]") {
  constexpr double slope = 0.2, gap = 0.5 * range;
  const double cosine = 1 / std::sqrt(1 + slope * slope);
  for (const double sign : {-1.0, 1.0}) {
    SurfaceBuilder builder;
    add_fold(builder, sign * slope, 0);
    const int apex = add_tip(builder, {0, 0, gap}, 0.01, 1);
    // At a constant distance from the ridge: over the faces, and on an arc over their edge.
    const double arc = gap * slope * cosine;
    const auto height = [&](const Vec3& at) {
      const double x = std::abs(at.x());
      if (sign > 0) return slope * x + gap / cosine;
      return x < arc ? std::sqrt(gap * gap - x * x) : -slope * x + gap / cosine;
    };
    const Slide found = slide(builder, {-0.003, 0.004, 0}, {0.003, 0.005, 0}, height, apex);
    CHECK(found.low == Approx(1).epsilon(1e-6));
    // In the valley, the prisms of both faces overlap where |x| < gap sin: two contacts, the second at
    // most as near as the first. There the least distance of the two is kept, so the sum reaches 2.
    CHECK(found.high == Approx(sign < 0 ? 1 : 2).epsilon(1e-2));
  }
}

TEST_CASE("ogc: each block counts once, from outside", "[ogc]") {
  SurfaceBuilder builder;
  builder.add_box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0}, 0);
  const int apex = add_tip(builder, {0, 0, 0}, 0.05, 1);  // 45 degrees steep
  OgcScene scene(builder);
  const auto count = [&](const Vec3& at) {
    VecX x = builder.x();
    for (int v = apex; v < apex + 4; ++v) vertex(x, v) += at;
    scene.move_to(x);
    return std::array{scene.contacts.point_point.size(), scene.contacts.point_edge.size(), scene.contacts.point_triangle.size()};
  };
  const double d = 0.5 * range, o = 0.3 * range;
  CHECK(count({0.03, 0.01, d}) == std::array<size_t, 3>{0, 0, 1});           // over the face
  CHECK(count({0.03, 0.03, d}) == std::array<size_t, 3>{0, 1, 0});           // over its diagonal
  CHECK(count({0.1 + o, 0.03, o}) == std::array<size_t, 3>{0, 1, 0});        // beside an edge
  CHECK(count({0.1, 0.1, d}) == std::array<size_t, 3>{2, 0, 0});             // over a corner: each from the other
  CHECK(count({0.03, 0.01, -d}) == std::array<size_t, 3>{0, 0, 0});          // inside
}

TEST_CASE("ogc: derivatives within a block, momentum and rest", "[ogc]") {
  SurfaceBuilder builder;
  add_fine_box(builder, {0, 0, 0}, 0.1, 2, 0, Mat3::Identity());
  add_fine_box(builder, {0.02, 0.01, 0.115}, 0.1, 2, 1, Eigen::AngleAxisd(0.5, Vec3(0.1, 0.05, 1).normalized()).toRotationMatrix());
  OgcScene scene(builder, 0.03);
  const VecX x = builder.x(), force = scene.forces(x);
  const double scale = force.cwiseAbs().sum();
  CHECK(scale > 0);
  CHECK(total(force).norm() <= 1e-12 * scale);
  CHECK(total_moment(x, force).norm() <= 1e-12 * scale);
  const VecX slopes = gradient_by_differences([&](const VecX& y) { return scene.value(y); }, x, 1e-8);
  CHECK((slopes + force).lpNorm<Eigen::Infinity>() <= 1e-6 * force.lpNorm<Eigen::Infinity>());
  SurfaceBuilder alone;
  add_fine_box(alone, {0, 0, 0}, 0.1, 4, 0, Mat3::Identity());
  OgcScene of_box(alone, 0.05);
  CHECK(of_box.value(alone.x()) == 0);
}

TEST_CASE("ogc: no motion within the displacement bounds lets surfaces touch", "[ogc]") {
  SurfaceBuilder builder;
  add_fine_box(builder, {0, 0, 0}, 0.1, 3, 0, Mat3::Identity());
  add_fine_box(builder, {0.02, 0.01, 0.104}, 0.1, 3, 1, Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix());
  builder.add_grid({4, 4}, 2, [](double u, double v) { return Vec3(0.12 * u - 0.1, 0.12 * v - 0.05, -0.056 - 0.004 * std::cos(6 * u)); }, true);
  ModelScene scene(builder, 0.02);
  const VecX x = builder.x();
  const CollisionMesh& mesh = scene.surface.mesh;
  const Candidates candidates = scene.candidates_at(x);
  constexpr double gamma = 0.45;
  const std::vector<double> bounds = displacement_bounds(mesh, candidates, x, 0.02, gamma);
  for (const int v : mesh.vertices) {
    CHECK(bounds[v] > 0);
    CHECK(bounds[v] <= gamma * 0.02);
  }
  // Distances of pairs, each less the part that both sides may use up.
  const auto least = [&](const VecX& from, const VecX& to) {
    double ratio = 1e9;
    for (const auto& [p, t] : candidates.point_triangle)
      ratio = std::min(ratio, squared_distance(corners(to, std::array{p}), corners(to, mesh.triangles[t])) /
                                  squared_distance(corners(from, std::array{p}), corners(from, mesh.triangles[t])));
    for (const auto& [e, f] : candidates.edge_edge)
      ratio = std::min(ratio, squared_distance(corners(to, mesh.edges[e]), corners(to, mesh.edges[f])) /
                                  squared_distance(corners(from, mesh.edges[e]), corners(from, mesh.edges[f])));
    return std::sqrt(ratio);
  };
  RandomPoints random(5);
  double smallest = 1;
  for (int trial = 0; trial < 200; ++trial) {
    VecX y = x;
    for (const int v : mesh.vertices) {
      // Mostly straight at each other: boxes along z.
      const Vec3 d = trial % 2 ? random.direction() : Vec3(0, 0, mesh.vertex_object[v] == 1 ? -1 : 1);
      vertex(y, v) += bounds[v] * d;
    }
    smallest = std::min(smallest, least(x, y));
  }
  CHECK(smallest >= 1 - 2 * gamma - 1e-9);
  CHECK(smallest < 0.2);  // the bound is used up: 0.1 of the distance is left
}
