#include "framework/contact/rest_gap_finder.hpp"

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
// over a gap, so that any middle value does; 45 degrees is as far from both.
const double gap_sine = std::sqrt(0.5);

// Largest length of the path over the mesh between two neighbours, as a multiple of their distance.
// The path over a right-angled crease is at most twice as long, and paths over the edges of a mesh
// are up to 1.4 times longer than need be: 2 * 1.4 = 2.8. A smaller bound takes creases for gaps; a
// larger one takes narrow folds (below 2 asin(1/3) = 39 degrees) for creases.
constexpr double neighbours_way = 3;

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

RestShape::RestShape(const ContactSurface& all, const PairTable& table, const std::vector<double>& reaches)
    : surface(all), pairs(table), reach(reaches), held(all), start(all.mesh.vertex_object.size() + 1, 0) {
  held.hold(all.rest);
  for (const auto& [a, b] : all.mesh.edges) ++start[a + 1], ++start[b + 1];
  for (size_t v = 1; v < start.size(); ++v) start[v] += start[v - 1];
  beside.resize(start.back());
  std::vector<int> next(start.begin(), start.end() - 1);
  for (const auto& [a, b] : all.mesh.edges) beside[next[a]++] = b, beside[next[b]++] = a;
}

RestGapFinder::RestGapFinder(const RestShape& shape, const Candidates& candidates)
    : shape_(shape), mesh_(shape.surface.mesh), x_(shape.surface.rest), candidates_(candidates), viewer_(mesh_, shape.held),
      way_(mesh_.vertex_object.size(), infinity) {}

double RestGapFinder::sine_from(int triangle, const Vec3& foot, const Vec3& to) const {
  const Vec3 way = to - foot;
  const double sine = shape_.held.normal(triangle).dot(way) / way.norm();
  return shape_.held.topology().two_sided(triangle) ? std::abs(sine) : sine;
}

// Returns the largest sine of the triangles at an edge, or that of a rod.
double RestGapFinder::sine_from(const Edge& edge, const Vec3& foot, const Vec3& to) const {
  double largest = -infinity;
  for (const int t : shape_.held.topology().triangles_at(edge[0])) {
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
void RestGapFinder::walk_from(const std::array<int, A>& sources, double length) {
  for (const int v : reached_) way_[v] = infinity;
  reached_.clear();
  open_.clear();
  const auto reach = [&](int v, double way) {
    if (way > length || way >= way_[v]) return;
    if (way_[v] == infinity) reached_.push_back(v);
    way_[v] = way;
    open_.emplace_back(way, v);
    std::push_heap(open_.begin(), open_.end(), std::greater<>());
  };
  for (const int v : sources) reach(v, 0);
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const auto [way, v] = open_.back();
    open_.pop_back();
    if (way > way_[v]) continue;
    for (int i = shape_.start[v]; i < shape_.start[v + 1]; ++i) reach(shape_.beside[i], way + (vertex(x_, v) - vertex(x_, shape_.beside[i])).norm());
  }
}

template <std::size_t B>
bool RestGapFinder::is_far(const std::array<int, B>& vertices, double distance) const {
  return std::all_of(vertices.begin(), vertices.end(), [&](int v) { return way_[v] > neighbours_way * distance; });
}

double RestGapFinder::of_point(const PointGroup& group, std::vector<std::array<int, 4>>& gaps) {
  const int p = group.point;
  const double range = shape_.reach[group.object];
  // Primitives that face the point press, with or without a gap. With an offset, neighbours within
  // the guard range do not press.
  const double faces_from = shape_.pairs.offset(group.object, group.object) == 0 ? 0 : shape_.pairs.point(group.object, group.object).safety_barrier_range;
  const Viewpoint from = viewer_.vertex_view(p);
  const FacingView view = viewer_.look(from, group.triangle_end - group.triangle_begin,
                                       [&](int k) { return candidates_.point_triangle[group.triangle_begin + k][1]; });
  double least = infinity;
  bool walked = false;
  const auto look = [&](const auto& vertices, bool over, bool seen, const std::array<int, 4>& key) {
    if (!over && !seen) return;
    const double distance = std::sqrt(squared_distance(corners(x_, std::array{p}), corners(x_, vertices)));
    if (!(distance > 0) || distance >= range) return;
    if (over && !walked) walk_from(std::array{p}, neighbours_way * range), walked = true;
    const bool gap = over && is_far(vertices, distance);
    if (gap) gaps.push_back(key);
    if (gap || (seen && distance >= faces_from)) least = std::min(least, distance);
  };
  for (int i = group.triangle_begin; i < group.triangle_end; ++i) {
    const int triangle = candidates_.point_triangle[i][1];
    const Triangle& t = mesh_.triangles[triangle];
    look(t, lies_over(p, triangle), view.count > 0 && viewer_.piece_of(from, view, triangle) >= 0, {p, t[0], t[1], t[2]});
  }
  for (int i = group.edge_begin; i < group.edge_end; ++i) {
    const Edge& rod = mesh_.edges[candidates_.point_edge[i][1]];
    look(rod, lies_over(p, rod), false, {p, rod[0], rod[1], -1});
  }
  return least;
}

double RestGapFinder::of_edges(int candidate, std::vector<std::array<int, 4>>& gaps) {
  const Edge &a = mesh_.edges[candidates_.edge_edge[candidate][0]], &b = mesh_.edges[candidates_.edge_edge[candidate][1]];
  const double range = shape_.reach[mesh_.vertex_object[a[0]]], distance = std::sqrt(squared_distance(corners(x_, a), corners(x_, b)));
  if (!(distance > 0) || distance >= range || !lie_over(a, b)) return infinity;
  if (walked_ != a) walk_from(a, neighbours_way * range), walked_ = a;
  if (!is_far(b, distance)) return infinity;
  gaps.push_back({a[0], a[1], b[0], b[1]});
  return distance;
}

}  // namespace tack
