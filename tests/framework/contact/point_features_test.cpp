#include "framework/contact/stencils/point_features.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"

using namespace tack;

namespace {

constexpr double range = 0.3;

double phi(double d) { return d < range ? std::pow(1 - d / range, 3) : 0.0; }

struct Sheet {
  VecX x;  // the point that looks at the sheet is vertex 0
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<int> vertices;

  int add(const Vec3& p) {
    x.conservativeResize(x.size() + 3);
    x.tail<3>() = p;
    return static_cast<int>(x.size()) / 3 - 1;
  }
  int count() const { return static_cast<int>(x.size()) / 3; }
};

class Random {
 public:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  bool coin() { return uniform(0, 1) < 0.5; }

 private:
  std::mt19937 generator_{5};
};

// The unit square in the plane y = 0 with n x n cells: nodes moved within the plane, diagonals and
// the order of vertices by chance. `lift` maps the flat sheet to its positions.
template <class Lift>
Sheet random_sheet(int n, Random& random, const Lift& lift) {
  Sheet s;
  s.add(Vec3::Zero());
  std::vector<int> node;
  for (int k = 0; k <= n; ++k) {
    for (int i = 0; i <= n; ++i) {
      Vec3 p(i / double(n), 0, k / double(n));
      if (i > 0 && i < n && i != n / 2) p.x() += random.uniform(-0.3, 0.3) / n;
      if (k > 0 && k < n) p.z() += random.uniform(-0.3, 0.3) / n;
      node.push_back(s.add(lift(p)));
    }
  }
  const auto at = [&](int i, int k) { return node[i + (n + 1) * k]; };
  for (int k = 0; k < n; ++k) {
    for (int i = 0; i < n; ++i) {
      const int a = at(i, k), b = at(i + 1, k), c = at(i + 1, k + 1), d = at(i, k + 1);
      if (random.coin()) {
        s.triangles.push_back({a, b, c});
        s.triangles.push_back({c, d, a});
      } else {
        s.triangles.push_back({b, c, d});
        s.triangles.push_back({d, a, b});
      }
    }
  }
  return s;
}
Sheet flat_sheet(int n, Random& random) {
  return random_sheet(n, random, [](const Vec3& p) { return p; });
}

double feature_distance(const VecX& x, const PointFeature& f) {
  const Vec3 p = vertex(x, 0);
  const auto at = [&](int i) { return Vec3(vertex(x, f.vertices[i])); };
  if (f.count() == 1) return (p - at(0)).norm();
  if (f.count() == 2) return std::sqrt(point_edge_closest(p, at(0), at(1)).s);
  return std::sqrt(point_triangle_distance(p, at(0), at(1), at(2)));
}

double sum(Sheet& sheet, const Vec3& p, bool plain = false) {
  static PointFeatures features;
  vertex(sheet.x, 0) = p;
  double total = 0;
  for (const PointFeature& f :
       features.reduce(sheet.x, vertex(sheet.x, 0), sheet.triangles, sheet.edges, sheet.vertices, range, plain ? FeatureCount::each : FeatureCount::inclusion_exclusion))
    total += f.multiplicity * phi(feature_distance(sheet.x, f));
  return total;
}

double distance_to_unit_square(const Vec3& p) {
  const Vec3 closest(std::clamp(p.x(), 0.0, 1.0), 0, std::clamp(p.z(), 0.0, 1.0));
  return (p - closest).norm();
}

}  // namespace

TEST_CASE("a point over a flat sheet counts it once", "[contact]") {
  Random random;
  for (const int n : {1, 2, 3, 8, 20}) {
    Sheet sheet = flat_sheet(n, random);
    for (int trial = 0; trial < 500; ++trial) {
      const Vec3 p(random.uniform(-0.2, 1.2), random.uniform(-0.3, 0.3), random.uniform(-0.2, 1.2));
      REQUIRE(sum(sheet, p) == Approx(phi(distance_to_unit_square(p))).margin(1e-12));
    }
  }
}

TEST_CASE("a point over a vertex or an edge of a flat sheet counts it once, by one feature", "[contact]") {
  Random random;
  Sheet sheet = flat_sheet(6, random);
  PointFeatures features;
  const auto check = [&](const Vec3& below) {
    for (const double height : {1e-9, 1e-3, 0.1, 0.299}) {
      const Vec3 p = below + Vec3(0, height, 0);
      REQUIRE(sum(sheet, p) == Approx(phi(height)).margin(1e-12));
      const auto& found =
          features.reduce(sheet.x, vertex(sheet.x, 0), sheet.triangles, sheet.edges, sheet.vertices, range, FeatureCount::inclusion_exclusion);
      int multiplicities = 0;
      for (const PointFeature& f : found) multiplicities += f.multiplicity;
      CHECK(multiplicities == 1);
    }
  };
  for (int v = 1; v < sheet.count(); ++v) check(vertex(sheet.x, v));
  for (const Triangle& t : sheet.triangles)
    for (const double u : {0.5, 0.25, 1e-12})
      check((1 - u) * vertex(sheet.x, t[0]) + u * vertex(sheet.x, t[1]));
}

// A valley or a ridge along z at x = 1/2, whose sides rise or fall with the given slope. Where the
// closest point of both sides is not the line between them, they are separate pieces up to the
// distance of the line: phi(d_1) + phi(d_2) - phi(d_line). Otherwise, as over a blunt ridge, phi(d).
TEST_CASE("valleys and ridges: closed forms, no jumps on a path across", "[contact]") {
  Random random;
  for (const double slope : {1.0, 0.2, -0.2, -1.0, -3.0}) {
    for (const int n : {2, 6, 12}) {
      const auto height = [&](double x) { return slope * std::abs(x - 0.5); };
      Sheet sheet = random_sheet(n, random, [&](const Vec3& p) { return Vec3(p.x(), height(p.x()), p.z()); });
      const Vec3 normals[] = {Vec3(slope, 1, 0).normalized(), Vec3(-slope, 1, 0).normalized()};
      double before = -1, largest_step = 0;
      constexpr int steps = 4000;
      for (int i = 0; i <= steps; ++i) {
        const double along = 0.3 + 0.4 * i / steps;
        const Vec3 p(along, height(along) + 0.05 + 0.02 * std::sin(9 * along), 0.41 + 0.1 * along);
        const double value = sum(sheet, p), line = (p - Vec3(0.5, 0, p.z())).norm();
        double expected = -phi(line);
        for (int side = 0; side < 2; ++side) {
          const double d = normals[side].dot(p - Vec3(0.5, 0, p.z()));
          const double foot = p.x() - d * normals[side].x();
          const bool over = side == 0 ? foot <= 0.5 : foot >= 0.5;
          expected += phi(over ? std::abs(d) : line);
        }
        REQUIRE(value == Approx(expected).margin(1e-11));
        if (i > 0) largest_step = std::max(largest_step, std::abs(value - before));
        before = value;
      }
      CHECK(largest_step <= 3 * 3 / range * 0.4 * 3 / steps);  // phi' is at most 3 / range
    }
  }
}

// Three walls that meet in a corner, with points inside it.
TEST_CASE("a concave corner: pieces minus edges plus the vertex", "[contact]") {
  Sheet s;
  s.add(Vec3::Zero());
  const int o = s.add({0, 0, 0}), a = s.add({2, 0, 0}), b = s.add({0, 2, 0}), c = s.add({0, 0, 2});
  s.triangles = {{o, a, b}, {o, b, c}, {o, c, a}};
  Random random;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 p(random.uniform(0, 0.3), random.uniform(0, 0.3), random.uniform(0, 0.3));
    double expected = phi(p.norm());
    for (int i = 0; i < 3; ++i)
      expected += phi(p(i)) - phi(std::hypot(p((i + 1) % 3), p((i + 2) % 3)));
    REQUIRE(sum(s, p) == Approx(expected).margin(1e-12));
  }
}

TEST_CASE("a straight rod counts once, particles each", "[contact]") {
  Random random;
  Sheet rod;
  rod.add(Vec3::Zero());
  for (int i = 0; i <= 7; ++i) rod.add({i / 7.0, 0, 0});
  for (int i = 1; i <= 7; ++i) rod.edges.push_back({i + i % 2, i + 1 - i % 2});  // either direction
  Sheet particles;
  particles.add(Vec3::Zero());
  particles.vertices = {particles.add({0, 0, 0}), particles.add({0.1, 0, 0})};
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 p(random.uniform(-0.2, 1.2), random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2));
    const Vec3 closest(std::clamp(p.x(), 0.0, 1.0), 0, 0);
    REQUIRE(sum(rod, p) == Approx(phi((p - closest).norm())).margin(1e-12));
    REQUIRE(sum(particles, p) ==
            Approx(phi(p.norm()) + phi((p - Vec3(0.1, 0, 0)).norm())).margin(1e-12));
  }
}

TEST_CASE("plain sums count every triangle", "[contact]") {
  Random random;
  Sheet sheet = flat_sheet(5, random);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 p(random.uniform(0, 1), random.uniform(0.01, 0.3), random.uniform(0, 1));
    double expected = 0;
    for (const Triangle& t : sheet.triangles)
      expected += phi(std::sqrt(point_triangle_distance(p, vertex(sheet.x, t[0]), vertex(sheet.x, t[1]),
                                                        vertex(sheet.x, t[2]))));
    REQUIRE(sum(sheet, p, true) == Approx(expected).margin(1e-12));
  }
}
