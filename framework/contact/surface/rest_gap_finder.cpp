#include "framework/contact/surface/rest_gap_finder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "geometry/distance/closest_parameters.hpp"
#include "geometry/distance/squared_distance.hpp"

namespace tack {
namespace {

// Sine of the smallest angle, 45 degrees, between a primitive and the line to the closest point of
// another at which there is a gap between them. The angle is about 0 along a surface and 90 degrees
// over a gap; 45 degrees is half-way.
const double gap_sine = std::sqrt(0.5);

// Largest length of the path over the mesh between two neighbours, as a multiple of their distance.
// The path over a right-angled crease is at most twice as long as the distance, and paths along the
// edges of a mesh are up to 1.4 times longer than geodesics: 2 * 1.4 = 2.8. A smaller bound mistakes
// creases for gaps; a larger one mistakes narrow folds (below 2 asin(1/3) = 39 degrees) for creases.
constexpr double neighbour_path_ratio_max = 3;

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

RestShape::RestShape(const ContactSurface& all, const PairTable& table, const std::vector<double>& search_radii)
    : surface(all), pairs(table), search_radius(search_radii), lagged(all), start(all.mesh.vertex_object.size() + 1, 0) {
  lagged.update(all.rest);
  for (const auto& [a, b] : all.mesh.edges) ++start[a + 1], ++start[b + 1];
  for (size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
  neighbours.resize(start.back());
  std::vector<int> next(start.begin(), start.end() - 1);
  for (const auto& [a, b] : all.mesh.edges) neighbours[next[a]++] = b, neighbours[next[b]++] = a;
}

RestGapFinder::RestGapFinder(const RestShape& shape, const Candidates& candidates)
    : shape_(shape), mesh_(shape.surface.mesh), x_(shape.surface.rest), candidates_(candidates), finder_(mesh_, shape.lagged),
      path_length_(mesh_.vertex_object.size(), infinity) {}

double RestGapFinder::sine_from(int triangle, const Vec3& foot, const Vec3& to) const {
  const Vec3 direction = to - foot;
  const double sine = shape_.lagged.normal(triangle).dot(direction) / direction.norm();
  return shape_.lagged.topology().two_sided(triangle) ? std::abs(sine) : sine;
}

// Returns the largest sine of the triangles at an edge, or that of a rod.
double RestGapFinder::sine_from(const Edge& edge, const Vec3& foot, const Vec3& to) const {
  double largest = -infinity;
  for (const int t : shape_.lagged.topology().triangles_at(edge[0])) {
    const Triangle& v = mesh_.triangles[t];
    if (std::find(v.begin(), v.end(), edge[1]) != v.end()) largest = std::max(largest, sine_from(t, foot, to));
  }
  if (largest > -infinity) return largest;
  const auto [a, b] = corners(x_, edge);
  return (to - foot).normalized().cross((b - a).normalized()).norm();
}

bool RestGapFinder::lies_over(int point, int triangle) const {
  const auto [a, b, c] = corners(x_, mesh_.triangles[triangle]);
  const Vec3 to = vertex(x_, point), l = point_triangle_barycentric(to, a, b, c);
  return sine_from(triangle, l[0] * a + l[1] * b + l[2] * c, to) >= gap_sine;
}

bool RestGapFinder::lies_over(int point, const Edge& rod) const {
  const auto [a, b] = corners(x_, rod);
  const Vec3 to = vertex(x_, point);
  return sine_from(rod, a + point_edge_parameter(to, a, b) * (b - a), to) >= gap_sine;
}

bool RestGapFinder::lie_over(const Edge& a, const Edge& b) const {
  const auto [a0, a1] = corners(x_, a);
  const auto [b0, b1] = corners(x_, b);
  const Vec2 at = edge_edge_parameters(a0, a1, b0, b1);
  const Vec3 on_a = a0 + at.x() * (a1 - a0), on_b = b0 + at.y() * (b1 - b0);
  return std::max(sine_from(a, on_a, on_b), sine_from(b, on_b, on_a)) >= gap_sine;
}

// Finds the shortest paths over edges up to a length [m], by Dijkstra's algorithm.
template <std::size_t A>
void RestGapFinder::find_paths_from(const std::array<int, A>& sources, double length) {
  for (const int v : reached_) path_length_[v] = infinity;
  reached_.clear();
  open_.clear();
  const auto visit = [&](int v, double length_to_v) {
    if (length_to_v > length || length_to_v >= path_length_[v]) return;
    if (path_length_[v] == infinity) reached_.push_back(v);
    path_length_[v] = length_to_v;
    open_.emplace_back(length_to_v, v);
    std::push_heap(open_.begin(), open_.end(), std::greater<>());
  };
  for (const int v : sources) visit(v, 0);
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const auto [length_to_v, v] = open_.back();
    open_.pop_back();
    if (length_to_v > path_length_[v]) continue;
    for (int i = shape_.start[v]; i < shape_.start[v + 1]; ++i) visit(shape_.neighbours[i], length_to_v + (vertex(x_, v) - vertex(x_, shape_.neighbours[i])).norm());
  }
}

template <std::size_t B>
bool RestGapFinder::is_far(const std::array<int, B>& vertices, double distance) const {
  return std::all_of(vertices.begin(), vertices.end(), [&](int v) { return path_length_[v] > neighbour_path_ratio_max * distance; });
}

double RestGapFinder::of_point(const PointGroup& group, std::vector<std::array<int, 4>>& gaps) {
  const int p = group.point;
  const double range = shape_.search_radius[group.object];
  // Primitives that face the point press, with or without a gap. With an offset, neighbours within
  // the range of the safety barrier do not press.
  const double faces_from = shape_.pairs.offset(group.object, group.object) == 0 ? 0 : shape_.pairs.point(group.object, group.object).safety_barrier_range;
  const QueryPoint from = finder_.at_vertex(p);
  const VisiblePatches patches = finder_.find(from, group.triangle_end - group.triangle_begin,
                                              [&](int k) { return candidates_.point_triangle[group.triangle_begin + k][1]; });
  double least = infinity;
  bool paths_found = false;
  const auto consider = [&](const auto& vertices, bool over, bool visible, const std::array<int, 4>& key) {
    if (!over && !visible) return;
    const double distance = std::sqrt(squared_distance(corners(x_, std::array{p}), corners(x_, vertices)));
    if (!(distance > 0) || distance >= range) return;
    if (over && !paths_found) find_paths_from(std::array{p}, neighbour_path_ratio_max * range), paths_found = true;
    const bool gap = over && is_far(vertices, distance);
    if (gap) gaps.push_back(key);
    if (gap || (visible && distance >= faces_from)) least = std::min(least, distance);
  };
  for (int i = group.triangle_begin; i < group.triangle_end; ++i) {
    const int triangle = candidates_.point_triangle[i][1];
    const Triangle& t = mesh_.triangles[triangle];
    consider(t, lies_over(p, triangle), patches.count > 0 && finder_.patch_of(from, patches, triangle) >= 0, {p, t[0], t[1], t[2]});
  }
  for (int i = group.edge_begin; i < group.edge_end; ++i) {
    const Edge& rod = mesh_.edges[candidates_.point_edge[i][1]];
    consider(rod, lies_over(p, rod), false, {p, rod[0], rod[1], -1});
  }
  return least;
}

double RestGapFinder::of_edges(int candidate, std::vector<std::array<int, 4>>& gaps) {
  const Edge &a = mesh_.edges[candidates_.edge_edge[candidate][0]], &b = mesh_.edges[candidates_.edge_edge[candidate][1]];
  const double range = shape_.search_radius[mesh_.vertex_object[a[0]]], distance = std::sqrt(squared_distance(corners(x_, a), corners(x_, b)));
  if (!(distance > 0) || distance >= range || !lie_over(a, b)) return infinity;
  if (path_source_ != a) find_paths_from(a, neighbour_path_ratio_max * range), path_source_ = a;
  if (!is_far(b, distance)) return infinity;
  gaps.push_back({a[0], a[1], b[0], b[1]});
  return distance;
}

}  // namespace tack
