#include "framework/contact/area_integral/rod_overlaps.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "framework/contact/stencils/rest_neighbours.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Sines of the angle between two edges: below the first, their vertices alone carry the common area;
// above the second, the pair of edges does. The mollifier of edge pairs begins at 0.03.
constexpr double parallel_sine_max = 0.03, crossing_sine_min = 0.06;

constexpr double distance_tolerance_relative = 1e-12;  // of equal points

constexpr double search_distance_per_range = 2;  // farther rods have safety barriers alone in this step

double crossing_fraction(double sine) {
  const double t = std::clamp((sine - parallel_sine_max) / (crossing_sine_min - parallel_sine_max), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// A convex polygon; the common part of two quadrangles has at most eight corners.
struct Polygon {
  std::array<Vec2, 8> corners;
  int count = 0;
  void add(const Vec2& c) { corners[count++] = c; }
};

// Returns the part of a polygon on the side of a line where along.dot(p) <= limit.
Polygon cut(const Polygon& polygon, const Vec2& along, double limit) {
  Polygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const Vec2 &p = polygon.corners[i], &q = polygon.corners[(i + 1) % polygon.count];
    const double dp = along.dot(p) - limit, dq = along.dot(q) - limit;
    if (dp <= 0) kept.add(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) kept.add(p + dp / (dp - dq) * (q - p));
  }
  return kept;
}

// Projection of an edge: from its first end along u over a length, half a width to both sides.
struct Strip {
  Vec2 start, u;
  double length, half;
};

Strip strip_of(const std::array<Vec3, 2>& edge, double width, const Vec3& x, const Vec3& y) {
  const auto flat = [&](const Vec3& p) { return Vec2(p.dot(x), p.dot(y)); };
  const Vec2 start = flat(edge[0]), direction = flat(edge[1]) - start;
  const double length = direction.norm();
  return {start, length > 0 ? Vec2(direction / length) : Vec2(1, 0), length, width / 2};
}

Polygon corners_of(const Strip& s) {
  const Vec2 v(-s.u.y(), s.u.x());
  Polygon p;
  p.add(s.start - s.half * v);
  p.add(s.start + s.length * s.u - s.half * v);
  p.add(s.start + s.length * s.u + s.half * v);
  p.add(s.start + s.half * v);
  return p;
}

Polygon within(Polygon p, const Strip& s) {
  const Vec2 v(-s.u.y(), s.u.x());
  p = cut(p, s.u, s.u.dot(s.start) + s.length);
  p = cut(p, -s.u, -s.u.dot(s.start));
  p = cut(p, v, v.dot(s.start) + s.half);
  return cut(p, -v, -v.dot(s.start) + s.half);
}

double area_of(const Polygon& p, Vec2& centre) {
  double twice = 0;
  centre.setZero();
  for (int i = 1; i + 1 < p.count; ++i) {
    const Vec2 a = p.corners[i] - p.corners[0], b = p.corners[i + 1] - p.corners[0];
    const double twice_triangle = a.x() * b.y() - a.y() * b.x();
    twice += twice_triangle;
    centre += twice_triangle * (p.corners[0] + (a + b) / 3);
  }
  if (twice != 0) centre /= twice;
  return std::abs(twice) / 2;
}

// Nearest points of two edges.
struct Nearest {
  Vec3 first, second;
  double distance;
};

Nearest nearest_points(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  const Vec2 at = edge_edge_parameters(a[0], a[1], b[0], b[1]);
  const Vec3 first = (1 - at.x()) * a[0] + at.x() * a[1], second = (1 - at.y()) * b[0] + at.y() * b[1];
  return {first, second, (first - second).norm()};
}

double distance_to(const Vec3& p, const std::array<Vec3, 2>& edge) { return std::sqrt(point_edge_distance(p, edge[0], edge[1])); }

}  // namespace

double projected_overlap(const std::array<Vec3, 2>& a, double width_a, const std::array<Vec3, 2>& b, double width_b,
                         const Vec3& n, Vec3& centre) {
  const Vec3 x = n.unitOrthogonal(), y = n.cross(x);
  const Vec3& origin = a[0];
  const auto from = [&](const std::array<Vec3, 2>& e) { return std::array<Vec3, 2>{Vec3(e[0] - origin), Vec3(e[1] - origin)}; };
  const Strip sa = strip_of(from(a), width_a, x, y), sb = strip_of(from(b), width_b, x, y);
  Vec2 flat;
  const double area = area_of(within(corners_of(sa), sb), flat);
  centre = origin + flat.x() * x + flat.y() * y;
  return area;
}

double disc_overlap(double radius, double width) {
  const double half = width / 2;
  if (half >= radius) return M_PI * radius * radius;
  return 2 * (half * std::sqrt(radius * radius - half * half) + radius * radius * std::asin(half / radius));
}

struct RodOverlaps::ChunkOverlaps {
  std::vector<Crossing> crossings;
  std::vector<VertexArea> vertex_areas;
};

RodOverlaps::RodOverlaps(const ContactSurface& surface, const PairTable& pairs) : surface_(surface), pairs_(pairs) {
  if (surface.mesh.codim_edges.empty()) return;
  is_rod_.assign(surface.mesh.edges.size(), 0);
  for (const int e : surface.mesh.codim_edges) is_rod_[e] = 1;
  longest_overlap_ = 2 * *std::max_element(surface.rod_width.begin(), surface.rod_width.end()) / parallel_sine_max;
}

// Returns whether this edge is the nearest one of its rod to a point of the other rod; at a vertex,
// the first of its edges counts for all.
bool RodOverlaps::closest_of_rod(int edge, const Vec3& opposite, double distance, const LaggedSurface& lagged) const {
  for (const int end : surface_.mesh.edges[edge]) {
    if ((vertex(lagged.x(), end) - opposite).norm() > (1 + distance_tolerance_relative) * distance) continue;
    const auto rods = lagged.topology().rods_at(end);
    const bool first = rods.front() == edge && std::all_of(rods.begin(), rods.end(), [&](int other) {
                         return distance_to(opposite, corners(lagged.x(), surface_.mesh.edges[other])) >= (1 - distance_tolerance_relative) * distance;
                       });
    if (!first) return false;
  }
  return true;
}

// Returns the ends of an edge, extended straight at ends where the rod continues, by the length of
// the longest overlap: the overlap of crossing rods does not depend on the lengths of edges.
std::array<Vec3, 2> RodOverlaps::extended(int edge, const LaggedSurface& lagged) const {
  const Edge& e = surface_.mesh.edges[edge];
  auto ends = corners(lagged.x(), e);
  const Vec3 along = (ends[1] - ends[0]).normalized() * longest_overlap_;
  if (lagged.topology().rods_at(e[0]).size() > 1) ends[0] -= along;
  if (lagged.topology().rods_at(e[1]).size() > 1) ends[1] += along;
  return ends;
}

// Returns the fraction of the overlap that an edge carries. At a vertex where a rod bends towards
// the other rod, both of its edges are nearer than the vertex, each at a point of its own, but the
// overlap must count once. The fraction of each edge is proportional to how much nearer it is than
// the vertex, so that it changes without a jump as the rods slide or bend.
double RodOverlaps::nearest_edge_fraction(int edge, int opposite, double distance, const LaggedSurface& lagged) const {
  const auto opposite_ends = corners(lagged.x(), surface_.mesh.edges[opposite]);
  double fraction = 1;
  for (const int end : surface_.mesh.edges[edge]) {
    const double at_end = distance_to(vertex(lagged.x(), end), opposite_ends);
    for (const int other : lagged.topology().rods_at(end)) {
      if (other == edge) continue;
      const Nearest nearest = nearest_points(corners(lagged.x(), surface_.mesh.edges[other]), opposite_ends);
      if (!closest_of_rod(other, nearest.second, nearest.distance, lagged) || !closest_of_rod(opposite, nearest.first, nearest.distance, lagged))
        continue;
      const double nearer = std::max(0.0, at_end - distance), both = nearer + std::max(0.0, at_end - nearest.distance);
      if (both > 0) fraction *= nearer / both;
    }
  }
  return fraction;
}

void RodOverlaps::add(int first, int second, const LaggedSurface& lagged, ChunkOverlaps& found) const {
  const CollisionMesh& mesh = surface_.mesh;
  const Edge &ea = mesh.edges[first], &eb = mesh.edges[second];
  const int object_a = mesh.vertex_object[ea[0]], object_b = mesh.vertex_object[eb[0]];
  const PairRole& role = pairs_.codimensional(object_a, object_b);
  if (role.law < 0 || rest_neighbours(surface_, ea, eb, role.range_max())) return;
  const auto a = corners(lagged.x(), ea), b = corners(lagged.x(), eb);
  const auto [on_first, on_second, distance] = nearest_points(a, b);
  if (!(distance > 0) || distance > search_distance_per_range * role.range_max()) return;
  const Vec3 n = (on_first - on_second) / distance, along_a = a[1] - a[0], along_b = b[1] - b[0];
  const double width_a = surface_.rod_width[object_a], width_b = surface_.rod_width[object_b];
  const double fraction = crossing_fraction(along_a.cross(along_b).norm() / (along_a.norm() * along_b.norm()));
  Vec3 centre;
  if (fraction > 0 && closest_of_rod(first, on_second, distance, lagged) && closest_of_rod(second, on_first, distance, lagged)) {
    const double area = projected_overlap(extended(first, lagged), width_a, extended(second, lagged), width_b, n, centre);
    const double nearest_fraction = nearest_edge_fraction(first, second, distance, lagged) * nearest_edge_fraction(second, first, distance, lagged);
    if (area > 0 && nearest_fraction > 0) found.crossings.push_back({{first, second}, fraction * nearest_fraction * area});
  }
  if (fraction == 1) return;
  const double area = projected_overlap(a, width_a, b, width_b, n, centre);
  if (!(area > 0)) return;
  const auto share_area = [&](const std::array<Vec3, 2>& edge, const Edge& vertices, int object) {
    const Vec3 along = edge[1] - edge[0];
    const double u = std::clamp((centre - edge[0]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    found.vertex_areas.push_back({{vertices[0], object}, (1 - fraction) * area / 2 * (1 - u)});
    found.vertex_areas.push_back({{vertices[1], object}, (1 - fraction) * area / 2 * u});
  };
  share_area(a, ea, object_b);
  share_area(b, eb, object_a);
}

void RodOverlaps::find(const Candidates& candidates, const LaggedSurface& lagged) {
  crossings_.clear();
  vertex_areas_.clear();
  if (is_rod_.empty()) return;
  const int n = static_cast<int>(candidates.edge_edge.size());
  std::vector<ChunkOverlaps> chunks(chunk_count(n));
  for_each_chunk(n, [&](int c, int first, int last) {
    for (int i = first; i < last; ++i) {
      const auto [a, b] = candidates.edge_edge[i];
      if (is_rod_[a] && is_rod_[b]) add(a, b, lagged, chunks[c]);
    }
  });
  for (const ChunkOverlaps& found : chunks) {
    crossings_.insert(crossings_.end(), found.crossings.begin(), found.crossings.end());
    vertex_areas_.insert(vertex_areas_.end(), found.vertex_areas.begin(), found.vertex_areas.end());
  }
  std::stable_sort(vertex_areas_.begin(), vertex_areas_.end(), [](const VertexArea& a, const VertexArea& b) { return a.key < b.key; });
  size_t kept = 0;
  for (size_t i = 0; i < vertex_areas_.size(); ++i) {
    if (kept > 0 && vertex_areas_[kept - 1].key == vertex_areas_[i].key) vertex_areas_[kept - 1].area += vertex_areas_[i].area;
    else vertex_areas_[kept++] = vertex_areas_[i];
  }
  vertex_areas_.resize(kept);
}

double RodOverlaps::area(int vertex, int object) const {
  const std::array key{vertex, object};
  const auto at = std::lower_bound(vertex_areas_.begin(), vertex_areas_.end(), key,
                                   [](const VertexArea& s, const std::array<int, 2>& k) { return s.key < k; });
  return at != vertex_areas_.end() && at->key == key ? at->area : 0;
}

}  // namespace tack
