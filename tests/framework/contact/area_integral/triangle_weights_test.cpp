// Weights of rods and particles towards single triangles (codimensional_weights.hpp): one above a
// surface of any mesh, none behind it, and continuous in between.
#include "framework/contact/area_integral/codimensional_weights.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "tests/framework/contact/surface_builder.hpp"

using namespace tack;

namespace {

constexpr double radius = 0.05, range = 0.3;  // m

// A particle as vertex 0 of object 0, and the triangles of object 1.
struct Particle {
  SurfaceBuilder builder;
  explicit Particle(const Vec3& at) { builder.add_particle(at, 0, radius); }
  std::vector<TriangleWeight> weights(const Mat3& rotation = Mat3::Identity(), const Vec3& offset = Vec3::Zero(), bool reversed = false) const {
    const SurfaceAt s(builder, moved(builder.x(), rotation, offset));
    std::vector<int> list(builder.two_sided.size());
    std::iota(list.begin(), list.end(), 0);
    if (reversed) std::reverse(list.begin(), list.end());
    auto all = CodimensionalWeights(s.surface.mesh, s.lagged).find(0, list, range);
    if (reversed) std::reverse(all.begin(), all.end());
    return all;
  }
};

double smooth(double t) { return t * t * (3 - 2 * t); }

TriangleWeight triangle(const Vec3& a, const Vec3& b, const Vec3& c, bool two_sided = false) {
  return {1, (b - a).cross(c - a).normalized(), (a + b + c) / 3, two_sided, 0.1};
}

}  // namespace

TEST_CASE("a particle above a surface has the weight one on its triangles within range, whatever the mesh", "[contact][codimensional]") {
  RandomPoints random(1);
  for (const int cells : {1, 3, 12})
    for (const double height : {1e-3, 0.1, 0.25}) {
      Particle p({0.03, -0.02, height});
      p.builder.add_grid({cells, cells}, 1, [&](double u, double v) {
        const bool inside = u > 0 && u < 1 && v > 0 && v < 1;
        return Vec3(2 * u - 1 + (inside ? random.uniform(-0.2, 0.2) / cells : 0), 2 * v - 1 + (inside ? random.uniform(-0.2, 0.2) / cells : 0), 0);
      });
      // Weights fade towards the end of the range, where the law is nearly zero.
      for (const TriangleWeight& w : p.weights())
        if (w.distance < 0.9 * range) CHECK(w.weight == Approx(1));
    }
}

TEST_CASE("a particle behind a solid has no weight, one behind a sheet has all of it", "[contact][codimensional]") {
  for (const bool sheet : {false, true}) {
    Particle p({0.03, -0.02, -0.1});
    p.builder.add_rectangle({3, 3}, 1, {-1, -1, 0}, 2, 2, true, sheet);
    for (const TriangleWeight& w : p.weights()) CHECK(w.weight == Approx(sheet ? 1 : 0));
  }
}

TEST_CASE("the weight falls smoothly from one over a boundary to zero at half a width past it", "[contact][codimensional]") {
  for (const double past : {0.0, 0.25, 0.5, 0.9, 1.0, 1.5})
    for (const int cells : {1, 5}) {
      Particle p({1 + past * radius, 0.13, 0.2});  // well in front: height over distance is above 1/2
      p.builder.add_rectangle({cells, cells}, 1, {-1, -1, 0}, 2, 2);
      double largest = 0;
      for (const TriangleWeight& w : p.weights()) largest = std::max(largest, w.weight);
      INFO(past << " " << cells);
      CHECK(largest == Approx(1 - smooth(std::min(past, 1.0))).margin(1e-9));
    }
}

TEST_CASE("pins the height over distance, one half, from which a surface is wholly in front of a point", "[contact][codimensional]") {
  // Past a boundary by a small part of the radius, so that the weight is that of the height alone.
  for (const double ratio : {0.1, 0.25, 0.45, 0.55}) {
    const double past = 1e-3 * radius, height = past * ratio / std::sqrt(1 - ratio * ratio);
    Particle p({1 + past, 0.13, height});
    p.builder.add_rectangle({1, 1}, 1, {-1, -1, 0}, 2, 2);
    double largest = 0;
    for (const TriangleWeight& w : p.weights()) largest = std::max(largest, w.weight);
    CHECK(largest == Approx(smooth(std::min(1.0, ratio / 0.5))).margin(1e-4));
  }
}

TEST_CASE("weights do not depend on rotation, translation, or the order of triangles", "[contact][codimensional]") {
  RandomPoints random(2);
  for (int trial = 0; trial < 20; ++trial) {
    Particle p(Vec3(Vec3(0, 0, 0.15) + random.point(0.1)));
    p.builder.add_grid({4, 4}, 1, [&](double u, double v) { return Vec3(0.8 * u - 0.4, 0.8 * v - 0.4, 0.3 * (u - 0.5) * (v - 0.3) + random.uniform(-0.02, 0.02)); });
    const auto weights = p.weights(), turned = p.weights(random.rotation(), random.point(2)), reversed = p.weights(Mat3::Identity(), Vec3::Zero(), true);
    for (size_t i = 0; i < weights.size(); ++i) {
      CHECK(turned[i].weight == Approx(weights[i].weight).margin(1e-6));
      CHECK(reversed[i].weight == Approx(weights[i].weight).margin(1e-9));
      CHECK(weights[i].weight >= 0);
      CHECK(weights[i].weight <= 1 + 1e-12);
    }
  }
}

TEST_CASE("a particle in a hollow has the whole weight on each face that is equally near", "[contact][codimensional]") {
  Particle p({0.1, 0.2, 0.1});
  p.builder.add_rectangle({2, 2}, 1, {0, -1, 0}, 1, 2);
  const int wall = p.builder.add_grid({2, 2}, 1, [](double u, double v) { return Vec3(0, 2 * u - 1, v); });
  CHECK(p.builder.two_sided.size() == 16);
  const auto weights = p.weights();
  // The floor, and the wall at the same distance.
  CHECK(weights[2].weight == Approx(1));
  CHECK(std::max_element(weights.begin() + wall, weights.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; })->weight == Approx(1));
}

TEST_CASE("adjacent triangles are one patch on flat surfaces and over ridges, two in a hollow", "[contact][codimensional]") {
  // The second triangle is folded about the y axis by an angle: down over a ridge, up in a hollow.
  const auto patch = [](double degrees, bool sheet = false) {
    const double angle = degrees / 180 * M_PI;
    const TriangleWeight a = triangle({0, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}, sheet), b = triangle({0, 1, 0}, {0, 0, 0}, {std::cos(angle), 0.5, std::sin(angle)}, sheet);
    CHECK(patch_affinity(a, b) == Approx(patch_affinity(b, a)));
    return patch_affinity(a, b);
  };
  CHECK(patch(0) == Approx(1));
  for (const double ridge : {-10.0, -45.0, -90.0}) CHECK(patch(ridge) == Approx(1));
  for (const double hollow : {75.0, 90.0}) CHECK(patch(hollow) == Approx(0).margin(1e-12));
  // A sheet is as hollow on its other side.
  CHECK(patch(-90, true) == Approx(patch(90, true)).margin(1e-12));
  // The more a hollow closes, the less it is one patch.
  for (double degrees = 5; degrees < 90; degrees += 5) CHECK(patch(degrees) <= patch(degrees - 5) + 1e-12);
}

TEST_CASE("pins the angles of a hollow, 30 and 70 degrees, between which one patch becomes two", "[contact][codimensional]") {
  const auto hollow = [](double degrees) {
    const double angle = degrees / 180 * M_PI;
    return patch_affinity(triangle({0, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}), triangle({0, 1, 0}, {0, 0, 0}, {std::cos(angle), 0.5, std::sin(angle)}));
  };
  CHECK(hollow(29.9) == Approx(1).epsilon(1e-12));
  CHECK(hollow(31) < 1);
  CHECK(hollow(69) > 0);
  CHECK(hollow(70.1) == Approx(0).margin(1e-12));
}
