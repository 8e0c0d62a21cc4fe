#include "geometry/mesh/oriented_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

Edge key_of(int a, int b) { return a < b ? Edge{a, b} : Edge{b, a}; }

// Returns the triangles at each edge, ascending.
std::map<Edge, std::vector<int>> triangles_at_edges(const std::vector<Triangle>& triangles) {
  std::map<Edge, std::vector<int>> at;
  for (size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) at[key_of(triangles[t][k], triangles[t][(k + 1) % 3])].push_back(static_cast<int>(t));
  return at;
}

bool leads(const Triangle& t, int a, int b) { return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b); }

int opposite(const Triangle& t, int a, int b) { return t[0] + t[1] + t[2] - a - b; }

// Visits the triangles of each connected component from its first one: begin(first), then visit(triangle, neighbour, edge,
// whether the neighbour was visited before).
template <class Begin, class Visit>
void for_each_neighbour(const std::vector<Triangle>& triangles, const Begin& begin, const Visit& visit) {
  const auto at = triangles_at_edges(triangles);
  std::vector<char> visited(triangles.size(), 0);
  std::vector<int> open;
  for (size_t first = 0; first < triangles.size(); ++first) {
    if (visited[first]) continue;
    visited[first] = 1;
    begin(static_cast<int>(first));
    open.assign(1, static_cast<int>(first));
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k) {
        const Edge edge = key_of(triangles[t][k], triangles[t][(k + 1) % 3]);
        for (const int other : at.at(edge)) {
          if (other == t) continue;
          const bool known = visited[other];
          visited[other] = 1;
          visit(t, other, edge, known);
          if (!known) open.push_back(other);
        }
      }
    }
  }
}

}  // namespace

OrientedSurface::OrientedSurface(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  for (const auto& [edge, at] : triangles_at_edges(triangles_)) {
    const Triangle& t = triangles_[at.front()];
    const bool along = leads(t, edge[0], edge[1]);
    const auto [a, b] = along ? edge : Edge{edge[1], edge[0]};
    const int other = at.size() > 1 ? opposite(triangles_[at[1]], a, b) : -1;
    edges_.push_back({a, b, opposite(t, a, b), other});
    closed_ = closed_ && other >= 0;
  }
  for (const Triangle& t : triangles_) vertices_.insert(vertices_.end(), t.begin(), t.end());
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
}

double OrientedSurface::volume(const VecX& x, const Vec3& origin) const {
  return sum_chunks(static_cast<int>(triangles_.size()), [&](int first, int last) {
    double sum = 0;
    for (int t = first; t < last; ++t) {
      const auto [a, b, c] = corners(x, triangles_[t]);
      sum += (a - origin).dot((b - origin).cross(c - origin));
    }
    return sum;
  }) / 6;
}

double OrientedSurface::area(const VecX& x) const {
  double sum = 0;
  for (const Triangle& t : triangles_) sum += triangle_area(x, t);
  return sum;
}

void OrientedSurface::add_areas(const VecX& x, double factor, VecX& sum) const {
  for (const Triangle& t : triangles_) {
    const auto [a, b, c] = corners(x, t);
    const Vec3 third = factor / 6 * (b - a).cross(c - a);
    for (const int v : t) vertex(sum, v) += third;
  }
}

Vec3 OrientedSurface::edge_area_vector(const SurfaceEdge& e, const VecX& x) const {
  const Vec3 a = vertex(x, e.a), along = vertex(x, e.b) - a, left = vertex(x, e.left);
  return along.cross(left - (e.right >= 0 ? Vec3(vertex(x, e.right)) : a)) / 12;
}

Vec3 OrientedSurface::mean_position(const VecX& x) const {
  Vec3 sum = Vec3::Zero();
  for (const int v : vertices_) sum += vertex(x, v);
  return sum / static_cast<double>(vertices_.size());
}

std::vector<Triangle> consistently_oriented(std::vector<Triangle> triangles) {
  for (const auto& [edge, at] : triangles_at_edges(triangles))
    if (at.size() > 2) throw InputError("more than two triangles meet in an edge, so that there is no inside");
  const std::vector<Triangle> input = triangles;
  for_each_neighbour(input, [](int) {}, [&](int t, int other, const Edge& edge, bool known) {
    if (leads(triangles[t], edge[0], edge[1]) != leads(triangles[other], edge[0], edge[1])) return;
    if (known) throw InputError("it has one side only, as a Moebius strip, so that there is no inside");
    std::swap(triangles[other][1], triangles[other][2]);
  });
  return triangles;
}

std::vector<int> components_by_edges(const std::vector<Triangle>& triangles) {
  std::vector<int> component(triangles.size(), -1);
  int count = 0;
  for_each_neighbour(triangles, [&](int t) { component[t] = count++; }, [&](int t, int other, const Edge&, bool known) {
    if (!known) component[other] = component[t];
  });
  return component;
}

std::vector<std::vector<int>> boundary_loops(const std::vector<Triangle>& triangles) {
  std::map<int, int> next;
  for (const auto& [edge, at] : triangles_at_edges(triangles)) {
    if (at.size() != 1) continue;
    const bool along = leads(triangles[at.front()], edge[0], edge[1]);
    if (!next.emplace(along ? edge[0] : edge[1], along ? edge[1] : edge[0]).second)
      throw InputError("two boundaries meet in a vertex; choose vertices so that its triangles hang together by edges");
  }
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      loops.back().push_back(at->first);
      const int to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return loops;
}

std::vector<Triangle> stitched(std::span<const int> first, std::span<const int> second, const VecX& x) {
  const auto distance = [&](int a, int b) { return (vertex(x, a) - vertex(x, b)).squaredNorm(); };
  size_t from = 0;
  for (size_t j = 1; j < second.size(); ++j)
    if (distance(first[0], second[j]) < distance(first[0], second[from])) from = j;
  std::vector<Triangle> best;
  double least = std::numeric_limits<double>::infinity();
  for (const int direction : {1, -1}) {
    const auto count = static_cast<int>(second.size());
    const auto of_first = [&](size_t i) { return first[i % first.size()]; };
    const auto of_second = [&](size_t j) { return second[((static_cast<int>(from) + direction * static_cast<int>(j)) % count + count) % count]; };
    std::vector<Triangle> strip;
    double length = 0;
    for (size_t i = 0, j = 0; i < first.size() || j < second.size();) {
      const bool on_first = j == second.size() || (i < first.size() && distance(of_first(i + 1), of_second(j)) <= distance(of_first(i), of_second(j + 1)));
      strip.push_back({of_first(i), on_first ? of_first(i + 1) : of_second(j + 1), of_second(j)});
      ++(on_first ? i : j);
      length += std::sqrt(distance(of_first(i), of_second(j)));
    }
    if (length < least) {
      least = length;
      best = std::move(strip);
    }
  }
  return best;
}

}  // namespace tack
