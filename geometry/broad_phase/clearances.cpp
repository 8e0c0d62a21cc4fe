#include "geometry/broad_phase/clearances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/distance/slab_bounds.hpp"
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
double largest_radius(const std::vector<Ball>& balls, const std::array<int, N>& v) {
  double radius = 0;
  for (const int i : v) radius = std::max(radius, balls[i].radius);
  return radius;
}

// Sets one lane to the centres of vertices, from an origin.
template <size_t N>
void set_centres(const std::vector<Ball>& balls, const std::array<int, N>& v, const Vec3& origin, int lane,
                 std::array<PackVec3, N>& centres) {
  for (size_t i = 0; i < N; ++i)
    for (int d = 0; d < 3; ++d) centres[i](d).set(lane, balls[v[i]].centre[d] - origin[d]);
}

}  // namespace

void find_clearances(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, Candidates& candidates) {
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
    for_each_chunk(static_cast<int>(pairs.size()), [&](int, int begin, int end) {
      std::array<PackVec3, std::tuple_size_v<decltype(first(0))>> a;
      std::array<PackVec3, std::tuple_size_v<decltype(second(0))>> b;
      for (int i = begin; i < end; i += pack_width) {
        const int n = std::min(pack_width, end - i);
        for (int l = 0; l < pack_width; ++l) {
          const auto& pair = pairs[i + std::min(l, n - 1)];
          const auto va = first(pair[0]);
          set_centres(balls, va, balls[va[0]].centre, l, a);
          set_centres(balls, second(pair[1]), balls[va[0]].centre, l, b);
        }
        const Pack apart = slab_bound(a, b);
        for (int l = 0; l < n; ++l) {
          const auto va = first(pairs[i + l][0]);
          const auto vb = second(pairs[i + l][1]);
          const double distance = std::max(0.0, (1 - accuracy) * apart[l]);
          distances[i + l] = distance;
          clearances[i + l] = std::max(0.0, distance - largest_radius(balls, va) - largest_radius(balls, vb));
        }
      }
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
