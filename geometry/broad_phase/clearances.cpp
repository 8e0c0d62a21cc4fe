#include "geometry/broad_phase/clearances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/distance/box_gap.hpp"
#include "geometry/distance/squared_distance.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr double accuracy = 1e-6;  // of a distance, far above its rounding error
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();  // of coordinates

// A vertex moves in the ball around the centre of its box.
struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius = 0;
};

template <size_t N>
std::array<Vec3, N> centres(const std::vector<Ball>& balls, const std::array<int, N>& v) {
  std::array<Vec3, N> c;
  for (size_t i = 0; i < N; ++i) c[i] = balls[v[i]].centre;
  return c;
}

template <size_t N>
double largest_radius(const std::vector<Ball>& balls, const std::array<int, N>& v) {
  double radius = 0;
  for (const int i : v) radius = std::max(radius, balls[i].radius);
  return radius;
}

struct Bounds {
  double distance, clearance;
};

template <size_t A, size_t B>
Bounds bounds(const std::vector<Ball>& balls, const std::array<int, A>& a, const std::array<int, B>& b, double enough) {
  const auto ca = centres(balls, a);
  const auto cb = centres(balls, b);
  const double motion = largest_radius(balls, a) + largest_radius(balls, b);
  const auto bounded = [&](double squared) {
    const double distance = (1 - accuracy) * std::sqrt(squared);
    return Bounds{distance, std::max(0.0, distance - motion)};
  };
  const Bounds by_boxes = bounded(box_gaps(ca, cb).cwiseMax(0.0).squaredNorm());
  return by_boxes.clearance > enough ? by_boxes : bounded(squared_distance(ca, cb));
}

}  // namespace

void find_clearances(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, double enough,
                     Candidates& candidates) {
  std::vector<Ball> balls(vertex_boxes.size());
  candidates.reference.setZero(3 * static_cast<Eigen::Index>(vertex_boxes.size()));
  for (const int v : mesh.vertices) {
    const Aabb& box = vertex_boxes[v];
    const double error = rounding * (box.lo.cwiseAbs().maxCoeff() + box.hi.cwiseAbs().maxCoeff());
    balls[v] = {0.5 * (box.lo + box.hi), 0.5 * (box.hi - box.lo).norm() * (1 + accuracy) + error};
    candidates.reference.segment<3>(3 * static_cast<Eigen::Index>(v)) = balls[v].centre;
  }
  const auto find = [&](const auto& pairs, const auto& first, const auto& second, auto member) {
    std::vector<double>&clearances = candidates.clearances.*member, &distances = candidates.distances.*member;
    clearances.resize(pairs.size());
    distances.resize(pairs.size());
    for_each(static_cast<int>(pairs.size()), [&](int i) {
      const Bounds b = bounds(balls, first(pairs[i][0]), second(pairs[i][1]), enough);
      distances[i] = b.distance;
      clearances[i] = b.clearance;
    }, 512);
  };
  const auto point = [](int v) { return std::array{v}; };
  const auto edge = [&](int e) { return mesh.edges[e]; };
  const auto triangle = [&](int t) { return mesh.triangles[t]; };
  find(candidates.point_triangle, point, triangle, &Clearances::point_triangle);
  find(candidates.edge_edge, edge, edge, &Clearances::edge_edge);
  find(candidates.point_edge, point, edge, &Clearances::point_edge);
  find(candidates.point_point, point, point, &Clearances::point_point);
}

}  // namespace tack
