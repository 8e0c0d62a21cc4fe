#include "geometry/broad_phase/sphere_tree.hpp"

#include <catch2/catch.hpp>

#include <random>

#include "geometry/distance/squared_distance.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/shapes/lines.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/shapes/surfaces.hpp"

using namespace tack;

namespace {

double distance_by_force(const Mesh& a, const Eigen::Isometry3d& at_a, const Mesh& b, const Eigen::Isometry3d& at_b) {
  const Surface s = extract_surface(a), t = extract_surface(b);
  const auto x = [&](int v) -> Vec3 { return at_a * a.vertices[v]; };
  const auto y = [&](int v) -> Vec3 { return at_b * b.vertices[v]; };
  double least = 1e9;
  for (const int v : s.vertices)
    for (const Triangle& f : t.triangles) least = std::min(least, point_triangle_distance(x(v), y(f[0]), y(f[1]), y(f[2])));
  for (const int v : t.vertices)
    for (const Triangle& f : s.triangles) least = std::min(least, point_triangle_distance(y(v), x(f[0]), x(f[1]), x(f[2])));
  for (const Edge& e : s.edges)
    for (const Edge& f : t.edges) least = std::min(least, edge_edge_distance(x(e[0]), x(e[1]), y(f[0]), y(f[1])));
  for (const int v : s.vertices)
    for (const int w : t.vertices) least = std::min(least, (x(v) - y(w)).squaredNorm());
  return std::sqrt(least);
}

}  // namespace

TEST_CASE("the sphere tree agrees with distances by brute force", "[broad_phase]") {
  std::vector<Mesh> shapes = {box_tets(Vec3(1, 0.5, 0.3), {2, 2, 1}), sphere_surface(0.6, 4), segment(1, 3), ring(0.5, 8), point_grid(Vec3(1, 1, 0), {2, 2, 1}),
                              grid(Vec2(1, 1), {3, 3})};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> part(-1, 1);
  int close = 0, far = 0;
  for (const Mesh& a : shapes)
    for (const Mesh& b : shapes) {
      const SphereTree p(a), q(b);
      for (int n = 0; n < 20; ++n) {
        Eigen::Isometry3d at_a = Eigen::Isometry3d::Identity(), at_b = at_a;
        at_a.rotate(Eigen::Quaterniond(part(random), part(random), part(random), part(random)).normalized());
        at_b.translate(1.2 * Vec3(part(random), part(random), part(random)));
        at_b.rotate(Eigen::Quaterniond(part(random), part(random), part(random), part(random)).normalized());
        const double truth = distance_by_force(a, at_a, b, at_b);
        CHECK_FALSE(farther_than(p, at_a, q, at_b, 1.001 * truth));
        // Crossing surfaces have a distance by vertices and edges too, and are not apart for any.
        if (farther_than(p, at_a, q, at_b, 0.999 * truth)) ++far;
        else ++close;
      }
    }
  CHECK(far > 300);
  CHECK(close > 20);
}

TEST_CASE("surfaces that cross are not farther apart than any distance, whatever the distances of their vertices and edges", "[broad_phase]") {
  const Mesh plate = grid(Vec2(10, 10), {1, 1}), needle = segment(2, 1);
  Eigen::Isometry3d upright = Eigen::Isometry3d::Identity(), identity = upright;
  upright.translate(Vec3(1, 0, 0.5));
  upright.rotate(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()));
  CHECK_FALSE(farther_than(SphereTree(plate), identity, SphereTree(needle), upright, 1e-3));
  upright.pretranslate(Vec3(0, 1.1, 0));
  CHECK(farther_than(SphereTree(plate), identity, SphereTree(needle), upright, 1e-3));
}
