#include "framework/contact/area_integral/codimensional_weights.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const double crease_cosine = std::cos(40 * M_PI / 180);
const double same_patch_cosine = std::cos(30 * M_PI / 180), other_patch_cosine = std::cos(70 * M_PI / 180);
constexpr double height_per_distance_span = 0.5;  // over which f rises from 0 to 1
constexpr double seed_distance_margin = 0.3;      // over the nearest seed, where psi falls to 0
constexpr double ridge_sine = 0.1;                // sine of the angle over which an edge becomes a ridge
constexpr double fade_start = 0.9;                // of the range: where z begins to fall

// Returns a smooth step from 0 at a to 1 at b.
double rise(double x, double a, double b) {
  const double t = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

double normal_affinity(double cosine) { return rise(cosine, other_patch_cosine, same_patch_cosine); }

}  // namespace

double patch_affinity(const TriangleWeight& a, const TriangleWeight& b) {
  const double cosine = a.normal.dot(b.normal);
  if (a.two_sided) return normal_affinity(std::abs(cosine));
  const Vec3 direction = (b.centre - a.centre).normalized();
  const double ridge = rise(std::min(-a.normal.dot(direction), b.normal.dot(direction)), -ridge_sine, ridge_sine);
  return ridge + (1 - ridge) * normal_affinity(cosine);
}

// Returns the other triangle at an edge; -1: a boundary, or more than two triangles.
int CodimensionalWeights::neighbour_across(int triangle, int side) const {
  const int a = mesh_.triangles[triangle][side], b = mesh_.triangles[triangle][(side + 1) % 3];
  int found = -1;
  for (const int other : lagged_.topology().triangles_at(a)) {
    const Triangle& v = mesh_.triangles[other];
    if (other == triangle || std::find(v.begin(), v.end(), b) == v.end()) continue;
    if (found >= 0) return -1;
    found = other;
  }
  return found;
}

Vec3 CodimensionalWeights::normal_along(int triangle, const Vec3& normal) const {
  const Vec3& n = lagged_.normal(triangle);
  return lagged_.topology().two_sided(triangle) && n.dot(normal) < 0 ? Vec3(-n) : n;
}

double CodimensionalWeights::sharpness(int triangle, int side, const Vec3& normal, const Vec3& neighbour_normal) const {
  return lagged_.topology().smooth_edge(triangle, side) ? 0 : 1 - rise(normal.dot(neighbour_normal), 0, crease_cosine);
}

// Sets the fan: the triangles at a corner of a triangle, with normals to one side.
void CodimensionalWeights::find_fan(int triangle, int corner) {
  fan_.assign(1, {triangle, lagged_.normal(triangle), 0});
  fan_edges_.clear();
  for (int k = 0; k < static_cast<int>(fan_.size()); ++k) {
    const int t = fan_[k].triangle;
    for (int side = 0; side < 3; ++side) {
      const int a = mesh_.triangles[t][side], b = mesh_.triangles[t][(side + 1) % 3];
      const int other = a == corner || b == corner ? neighbour_across(t, side) : -1;
      if (other < 0) continue;
      const Vec3 normal = fan_[k].normal, other_normal = normal_along(other, normal);
      int at = 0;
      while (at < static_cast<int>(fan_.size()) && fan_[at].triangle != other) ++at;
      if (at == static_cast<int>(fan_.size())) fan_.push_back({other, other_normal, 1});
      fan_edges_.push_back({k, at, sharpness(t, side, normal, other_normal)});
    }
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const FanEdge& l : fan_edges_) {
      const double over = std::max(fan_[l.from].sharpness, l.sharpness);
      if (over < fan_[l.to].sharpness) fan_[l.to].sharpness = over, changed = true;
    }
  }
}

CodimensionalWeights::Foot CodimensionalWeights::foot(const Vec3& p, int triangle) const {
  const auto [t0, t1, t2] = corners(lagged_.x(), mesh_.triangles[triangle]);
  const PointTriangleType type = point_triangle_type(p, t0, t1, t2);
  const double squared = point_triangle_distance(p, t0, t1, t2, type), height = lagged_.normal(triangle).dot(p - t0);
  return {triangle, static_cast<int>(type), std::sqrt(squared), std::sqrt(std::max(0.0, squared - height * height))};
}

// Returns the nearest triangle at the closest feature of another one, and the sharpness in between.
std::pair<CodimensionalWeights::Foot, double> CodimensionalWeights::descend(const Vec3& p, const Foot& from) {
  std::pair<Foot, double> best{from, 0};
  const auto consider = [&](int triangle, double over) {
    const Foot there = foot(p, triangle);
    if (there.distance < (1 - distance_tolerance) * best.first.distance) best = {there, over};
  };
  if (from.feature >= 6) return best;
  if (from.feature >= 3) {
    const int side = from.feature - 3, other = neighbour_across(from.triangle, side);
    if (other >= 0) consider(other, sharpness(from.triangle, side, lagged_.normal(from.triangle), normal_along(other, lagged_.normal(from.triangle))));
    return best;
  }
  find_fan(from.triangle, mesh_.triangles[from.triangle][from.feature]);
  for (const FanTriangle& s : fan_) consider(s.triangle, s.sharpness);
  return best;
}

// Returns the overshoot at a corner. It is zero in the directions of the normals of its triangles, and
// between the normals of two triangles that meet in an edge, as over that edge.
double CodimensionalWeights::overshoot_at_corner(const Vec3& p, const Foot& at) {
  const int corner = mesh_.triangles[at.triangle][at.feature];
  Vec3 towards = p - vertex(lagged_.x(), corner);
  find_fan(at.triangle, corner);
  if (lagged_.topology().two_sided(at.triangle) && fan_[0].normal.dot(towards) < 0) towards = -towards;
  double least = at.lateral;
  const auto allow = [&](double lateral, double sharp) {
    least = std::min(least, std::sqrt(lateral * lateral + sharp * sharp * std::max(0.0, at.lateral * at.lateral - lateral * lateral)));
  };
  for (const FanTriangle& s : fan_)
    if (const double height = s.normal.dot(towards); height > 0) allow(std::sqrt(std::max(0.0, towards.squaredNorm() - height * height)), s.sharpness);
  for (const FanEdge& l : fan_edges_) {
    const Vec3 &n = fan_[l.from].normal, &m = fan_[l.to].normal;
    const Vec3 axis = n.cross(m).normalized(), flat = towards - axis.dot(towards) * axis;
    if (axis.squaredNorm() > 0 && n.cross(flat).dot(axis) >= 0 && flat.cross(m).dot(axis) >= 0)
      allow(std::abs(axis.dot(towards)), std::max(fan_[l.from].sharpness, l.sharpness));
  }
  return least;
}

// Returns the overshoot of a point: summed on the path over triangles down to the nearest one.
double CodimensionalWeights::overshoot(const Vec3& p, Foot at) {
  double sum = 0;
  for (auto [next, over] = descend(p, at); next.triangle != at.triangle; std::tie(next, over) = descend(p, at)) {
    sum += over * at.lateral;
    at = next;
  }
  if (at.feature >= 6) return sum;
  const SurfaceTopology& topology = lagged_.topology();
  if (at.feature < 3) return topology.smooth_vertex(mesh_.triangles[at.triangle][at.feature]) ? sum : sum + overshoot_at_corner(p, at);
  const int side = at.feature - 3, other = neighbour_across(at.triangle, side);
  if (other < 0) return sum + at.lateral;
  return sum + sharpness(at.triangle, side, lagged_.normal(at.triangle), normal_along(other, lagged_.normal(at.triangle))) * at.lateral;
}

CodimensionalWeights::Seed CodimensionalWeights::seed_of(int vertex_index, int triangle, double range) {
  const Vec3 p = vertex(lagged_.x(), vertex_index);
  const Foot at = foot(p, triangle);
  const bool own = mesh_.vertex_object[vertex_index] == mesh_.vertex_object[mesh_.triangles[triangle][0]];
  const double low = own ? self_height_per_distance_min : 0;
  double height = lagged_.normal(triangle).dot(p - vertex(lagged_.x(), mesh_.triangles[triangle][0]));
  if (lagged_.topology().two_sided(triangle)) height = std::abs(height);
  const double front = at.distance > 0 ? rise(height / at.distance, low, low + height_per_distance_span) : 0;
  const double fade = 1 - rise(at.distance / range, fade_start, 1);
  if (!(front > 0)) return {0, at.distance, fade, infinity};
  const double above = 1 - rise(overshoot(p, at), 0, half_width_);
  return {lagged_.codimensional_area(vertex_index, lagged_.normal(triangle)) / lagged_.codimensional_area(vertex_index) * above * front, at.distance, fade,
          fade > 0 ? at.distance / (front * fade) : infinity};
}

// Finds the neighbours across edges of the triangles within range.
void CodimensionalWeights::find_neighbours(std::span<const int> triangles, double range) {
  uses_.clear();
  for (int i = 0; i < static_cast<int>(triangles.size()); ++i) {
    if (seeds_[i].distance >= range) continue;
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

// Sets membership: k_ij of all triangles i for a seed j, by a search in descending order of k
// (Dijkstra, with the least value on a path in place of its length).
void CodimensionalWeights::grow_patch(int seed, double range, double* membership) {
  const TriangleWeight& first = weights_[seed];
  const auto affinity_to_seed = [&](int i) {
    const double cosine = first.normal.dot(weights_[i].normal);
    return normal_affinity(first.two_sided ? std::abs(cosine) : cosine);
  };
  const int n = static_cast<int>(seeds_.size());
  for (int i = 0; i < n; ++i) membership[i] = seeds_[i].distance >= range ? affinity_to_seed(i) : 0;
  open_.assign(1, {1.0, seed});
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end());
    const auto [best, i] = open_.back();
    open_.pop_back();
    if (membership[i] > 0) continue;
    membership[i] = best;
    for (int k = neighbour_start_[i]; k < neighbour_start_[i + 1]; ++k) {
      const int other = neighbours_[k][1];
      if (membership[other] > 0) continue;
      const double next = std::min({best, seeds_[i].fade, affinity_to_seed(other)});
      if (!(next > 0)) continue;
      open_.emplace_back(next, other);
      std::push_heap(open_.begin(), open_.end());
    }
  }
}

std::vector<TriangleWeight>& CodimensionalWeights::find(int vertex_index, std::span<const int> triangles, double range) {
  const int n = static_cast<int>(triangles.size());
  const int object = mesh_.vertex_object[vertex_index];
  const double radius = lagged_.topology().particle_radius(vertex_index);
  half_width_ = radius > 0 ? radius : lagged_.rod_width(object) / 2;
  seeds_.clear();
  weights_.clear();
  seed_order_.clear();
  for (int i = 0; i < n; ++i) {
    seeds_.push_back(seed_of(vertex_index, triangles[i], range));
    if (seeds_[i].scaled_distance < infinity) seed_order_.push_back(i);
    const auto [a, b, c] = corners(lagged_.x(), mesh_.triangles[triangles[i]]);
    weights_.push_back({0, lagged_.normal(triangles[i]), (a + b + c) / 3, lagged_.topology().two_sided(triangles[i]), seeds_[i].distance});
  }
  std::stable_sort(seed_order_.begin(), seed_order_.end(), [&](int a, int b) { return seeds_[a].scaled_distance < seeds_[b].scaled_distance; });
  if (!seed_order_.empty()) find_neighbours(triangles, range);
  nearest_.assign(n, infinity);
  int used = 0;
  for (const int j : seed_order_) {
    // All further seeds are too far for triangles that have a seed.
    if (seeds_[j].scaled_distance > (1 + seed_distance_margin) * *std::max_element(nearest_.begin(), nearest_.end())) break;
    memberships_.resize(std::max<size_t>(memberships_.size(), static_cast<size_t>(n) * (used + 1)));
    double* membership = &memberships_[static_cast<size_t>(n) * used++];
    grow_patch(j, range, membership);
    for (int i = 0; i < n; ++i)
      if (membership[i] > 0) nearest_[i] = std::min(nearest_[i], seeds_[j].scaled_distance / membership[i]);
  }
  for (int i = 0; i < n; ++i)
    if (nearest_[i] == infinity) weights_[i].weight = seeds_[i].strength;
  for (int k = 0; k < used; ++k) {
    const Seed& seed = seeds_[seed_order_[k]];
    for (int i = 0; i < n; ++i) {
      const double membership = memberships_[static_cast<size_t>(n) * k + i];
      if (!(membership > 0)) continue;
      const double psi = 1 - rise(seed.scaled_distance / membership / nearest_[i], 1, 1 + seed_distance_margin);
      weights_[i].weight = std::max(weights_[i].weight, membership * seed.strength * psi);
    }
  }
  return weights_;
}

}  // namespace tack
