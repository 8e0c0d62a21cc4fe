#include "framework/contact/codimensional_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
const double crease_cosine = std::cos(40 * M_PI / 180);
const double one_direction = std::cos(30 * M_PI / 180), other_direction = std::cos(70 * M_PI / 180);
constexpr double in_front = 0.5;                    // height over distance
constexpr double as_near = 0.3;                    // relative: by how much farther a triangle still leads
constexpr double flat = 0.1;                        // sine of the angle that a ridge rises by
constexpr double near_end = 0.9;                    // of the range, where z begins to fall

// From 0 at a to 1 at b.
double rise(double x, double a, double b) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double alike(double cosine) { return rise(cosine, other_direction, one_direction); }

}  // namespace

double one_surface(const TriangleWeight& a, const TriangleWeight& b) {
  const double cosine = a.normal.dot(b.normal);
  if (a.two_sided) return alike(std::abs(cosine));
  const Vec3 way = (b.centre - a.centre).normalized();
  const double ridge = rise(std::min(-a.normal.dot(way), b.normal.dot(way)), -flat, flat);
  return ridge + (1 - ridge) * alike(cosine);
}

// The other triangle at an edge; -1: the surface does not go on there.
int CodimensionalViewer::across(int triangle, int side) const {
  const int a = mesh_.triangles[triangle][side], b = mesh_.triangles[triangle][(side + 1) % 3];
  int found = -1;
  for (const int other : held_.topology().triangles_at(a)) {
    const Triangle& v = mesh_.triangles[other];
    if (other == triangle || std::find(v.begin(), v.end(), b) == v.end()) continue;
    if (found >= 0) return -1;
    found = other;
  }
  return found;
}

Vec3 CodimensionalViewer::turned_like(int triangle, const Vec3& normal) const {
  const Vec3& n = held_.normal(triangle);
  return held_.topology().two_sided(triangle) && n.dot(normal) < 0 ? Vec3(-n) : n;
}

double CodimensionalViewer::sharpness(int triangle, int side, const Vec3& normal, const Vec3& beside) const {
  return held_.topology().smooth_edge(triangle, side) ? 0 : 1 - rise(normal.dot(beside), 0, crease_cosine);
}

// The triangles around a corner of one of them, with normals to the same side.
void CodimensionalViewer::find_fan(int triangle, int corner) {
  fan_.assign(1, {triangle, held_.normal(triangle), 0});
  links_.clear();
  for (int k = 0; k < static_cast<int>(fan_.size()); ++k) {
    const int t = fan_[k].triangle;
    for (int side = 0; side < 3; ++side) {
      const int a = mesh_.triangles[t][side], b = mesh_.triangles[t][(side + 1) % 3];
      const int other = a == corner || b == corner ? across(t, side) : -1;
      if (other < 0) continue;
      const Vec3 normal = fan_[k].normal, turned = turned_like(other, normal);
      int at = 0;
      while (at < static_cast<int>(fan_.size()) && fan_[at].triangle != other) ++at;
      if (at == static_cast<int>(fan_.size())) fan_.push_back({other, turned, 1});
      links_.push_back({k, at, sharpness(t, side, normal, turned)});
    }
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const Link& l : links_) {
      const double over = std::max(fan_[l.from].sharpness, l.sharpness);
      if (over < fan_[l.to].sharpness) fan_[l.to].sharpness = over, changed = true;
    }
  }
}

CodimensionalViewer::Foot CodimensionalViewer::foot(const Vec3& p, int triangle) const {
  const auto [t0, t1, t2] = corners(held_.x(), mesh_.triangles[triangle]);
  const PointTriangleType type = point_triangle_type(p, t0, t1, t2);
  const double squared = point_triangle_distance(p, t0, t1, t2, type), height = held_.normal(triangle).dot(p - t0);
  return {triangle, static_cast<int>(type), std::sqrt(squared), std::sqrt(std::max(0.0, squared - height * height))};
}

// The nearest one of those around the closest point, and the sharpness of what is between.
std::pair<CodimensionalViewer::Foot, double> CodimensionalViewer::nearer(const Vec3& p, const Foot& from) {
  std::pair<Foot, double> best{from, 0};
  const auto look_at = [&](int triangle, double over) {
    const Foot there = foot(p, triangle);
    if (there.distance < (1 - same_distance) * best.first.distance) best = {there, over};
  };
  if (from.feature >= 6) return best;
  if (from.feature >= 3) {
    const int side = from.feature - 3, other = across(from.triangle, side);
    if (other >= 0) look_at(other, sharpness(from.triangle, side, held_.normal(from.triangle), turned_like(other, held_.normal(from.triangle))));
    return best;
  }
  find_fan(from.triangle, mesh_.triangles[from.triangle][from.feature]);
  for (const Side& s : fan_) look_at(s.triangle, s.sharpness);
  return best;
}

// Over a corner, the point is above the surface in all directions of the normals of triangles, and between those of two
// that meet in an edge, as it is over that edge.
double CodimensionalViewer::beyond_corner(const Vec3& p, const Foot& at) {
  const int corner = mesh_.triangles[at.triangle][at.feature];
  Vec3 towards = p - vertex(held_.x(), corner);
  find_fan(at.triangle, corner);
  if (held_.topology().two_sided(at.triangle) && fan_[0].normal.dot(towards) < 0) towards = -towards;
  double least = at.off;
  const auto allow = [&](double off, double sharp) {
    least = std::min(least, std::sqrt(off * off + sharp * sharp * std::max(0.0, at.off * at.off - off * off)));
  };
  for (const Side& s : fan_)
    if (const double height = s.normal.dot(towards); height > 0) allow(std::sqrt(std::max(0.0, towards.squaredNorm() - height * height)), s.sharpness);
  for (const Link& l : links_) {
    const Vec3 &n = fan_[l.from].normal, &m = fan_[l.to].normal;
    const Vec3 axis = n.cross(m).normalized(), flat = towards - axis.dot(towards) * axis;
    if (axis.squaredNorm() > 0 && n.cross(flat).dot(axis) >= 0 && flat.cross(m).dot(axis) >= 0)
      allow(std::abs(axis.dot(towards)), std::max(fan_[l.from].sharpness, l.sharpness));
  }
  return least;
}

// On the way down to where the surface is nearest, and there.
double CodimensionalViewer::beyond(const Vec3& p, Foot at) {
  double sum = 0;
  for (auto [next, over] = nearer(p, at); next.triangle != at.triangle; std::tie(next, over) = nearer(p, at)) {
    sum += over * at.off;
    at = next;
  }
  if (at.feature >= 6) return sum;
  const SurfaceTopology& topology = held_.topology();
  if (at.feature < 3) return topology.smooth_vertex(mesh_.triangles[at.triangle][at.feature]) ? sum : sum + beyond_corner(p, at);
  const int side = at.feature - 3, other = across(at.triangle, side);
  if (other < 0) return sum + at.off;
  return sum + sharpness(at.triangle, side, held_.normal(at.triangle), turned_like(other, held_.normal(at.triangle))) * at.off;
}

CodimensionalViewer::Seen CodimensionalViewer::see(int vertex_index, int triangle, double range) {
  const Vec3 p = vertex(held_.x(), vertex_index);
  const Foot at = foot(p, triangle);
  const bool own = mesh_.vertex_object[vertex_index] == mesh_.vertex_object[mesh_.triangles[triangle][0]];
  const double low = own ? own_front : 0;
  double height = held_.normal(triangle).dot(p - vertex(held_.x(), mesh_.triangles[triangle][0]));
  if (held_.topology().two_sided(triangle)) height = std::abs(height);
  const double front = at.distance > 0 ? rise(height / at.distance, low, low + in_front) : 0;
  const double reach = 1 - rise(at.distance / range, near_end, 1);
  if (!(front > 0)) return {0, at.distance, reach, never};
  const double above = 1 - rise(beyond(p, at), 0, half_width_);
  return {held_.thin(vertex_index, held_.normal(triangle)) / held_.thin(vertex_index) * above * front, at.distance, reach,
          reach > 0 ? at.distance / (front * reach) : never};
}

// Over edges, of those within range.
void CodimensionalViewer::find_neighbours(std::span<const int> triangles, double range) {
  uses_.clear();
  for (int i = 0; i < static_cast<int>(triangles.size()); ++i) {
    if (seen_[i].distance >= range) continue;
    const Triangle& t = mesh_.triangles[triangles[i]];
    for (int side = 0; side < 3; ++side) {
      const auto [a, b] = std::minmax(t[side], t[(side + 1) % 3]);
      uses_.push_back({a, b, i});
    }
  }
  std::sort(uses_.begin(), uses_.end());
  neighbours_.clear();
  for (size_t i = 0; i < uses_.size(); ++i)
    for (size_t k = i + 1; k < uses_.size() && uses_[k][0] == uses_[i][0] && uses_[k][1] == uses_[i][1]; ++k) {
      neighbours_.push_back({uses_[i][2], uses_[k][2]});
      neighbours_.push_back({uses_[k][2], uses_[i][2]});
    }
  std::sort(neighbours_.begin(), neighbours_.end());
  neighbour_start_.assign(triangles.size() + 1, 0);
  for (const auto& [a, b] : neighbours_) ++neighbour_start_[a + 1];
  std::partial_sum(neighbour_start_.begin(), neighbour_start_.end(), neighbour_start_.begin());
}

// way: k_ij of all triangles i. From the best one on, each by its best neighbour.
void CodimensionalViewer::lead(int leader, double range, double* way) {
  const TriangleWeight& first = shares_[leader];
  const auto like_first = [&](int i) {
    const double cosine = first.normal.dot(shares_[i].normal);
    return alike(first.two_sided ? std::abs(cosine) : cosine);
  };
  const int n = static_cast<int>(seen_.size());
  for (int i = 0; i < n; ++i) way[i] = seen_[i].distance >= range ? like_first(i) : 0;
  open_.assign(1, {1.0, leader});
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end());
    const auto [best, i] = open_.back();
    open_.pop_back();
    if (way[i] > 0) continue;
    way[i] = best;
    for (int k = neighbour_start_[i]; k < neighbour_start_[i + 1]; ++k) {
      const int other = neighbours_[k][1];
      if (way[other] > 0) continue;
      const double next = std::min({best, seen_[i].reach, like_first(other)});
      if (!(next > 0)) continue;
      open_.emplace_back(next, other);
      std::push_heap(open_.begin(), open_.end());
    }
  }
}

std::vector<TriangleWeight>& CodimensionalViewer::look(int vertex_index, std::span<const int> triangles, double range) {
  const int n = static_cast<int>(triangles.size());
  const int object = mesh_.vertex_object[vertex_index];
  const double radius = held_.topology().particle_radius(vertex_index);
  half_width_ = radius > 0 ? radius : held_.rod_width(object) / 2;
  seen_.clear();
  shares_.clear();
  leaders_.clear();
  for (int i = 0; i < n; ++i) {
    seen_.push_back(see(vertex_index, triangles[i], range));
    if (seen_[i].away < never) leaders_.push_back(i);
    const auto [a, b, c] = corners(held_.x(), mesh_.triangles[triangles[i]]);
    shares_.push_back({0, held_.normal(triangles[i]), (a + b + c) / 3, held_.topology().two_sided(triangles[i]), seen_[i].distance});
  }
  std::stable_sort(leaders_.begin(), leaders_.end(), [&](int a, int b) { return seen_[a].away < seen_[b].away; });
  if (!leaders_.empty()) find_neighbours(triangles, range);
  nearest_.assign(n, never);
  int used = 0;
  for (const int j : leaders_) {
    // All further leaders are too far away for triangles that have one already.
    if (seen_[j].away > (1 + as_near) * *std::max_element(nearest_.begin(), nearest_.end())) break;
    ways_.resize(std::max<size_t>(ways_.size(), static_cast<size_t>(n) * (used + 1)));
    double* way = &ways_[static_cast<size_t>(n) * used++];
    lead(j, range, way);
    for (int i = 0; i < n; ++i)
      if (way[i] > 0) nearest_[i] = std::min(nearest_[i], seen_[j].away / way[i]);
  }
  for (int i = 0; i < n; ++i)
    if (nearest_[i] == never) shares_[i].share = seen_[i].strength;
  for (int k = 0; k < used; ++k) {
    const Seen& leader = seen_[leaders_[k]];
    for (int i = 0; i < n; ++i) {
      const double way = ways_[static_cast<size_t>(n) * k + i];
      if (!(way > 0)) continue;
      const double part = 1 - rise(leader.away / way / nearest_[i], 1, 1 + as_near);
      shares_[i].share = std::max(shares_[i].share, way * leader.strength * part);
    }
  }
  return shares_;
}

}  // namespace tack
