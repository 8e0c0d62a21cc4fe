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

template <size_t N>
double largest_radius(const std::vector<double>& radii, const std::array<int, N>& v) {
  double radius = 0;
  for (const int i : v) radius = std::max(radius, radii[i]);
  return radius;
}

// Sets one lane to the places of vertices, from an origin.
template <size_t N>
void set_places(const VecX& x, const std::array<int, N>& v, const Vec3& origin, int lane, std::array<PackVec3, N>& places) {
  for (size_t i = 0; i < N; ++i)
    for (int d = 0; d < 3; ++d) places[i](d).set(lane, x[3 * v[i] + d] - origin[d]);
}

// Calls visit(pairs, vertices of the first, of the second, members of Clearances and SomeCandidates) for each kind of candidates.
template <class Visit>
void for_each_kind(const CollisionMesh& mesh, const Candidates& c, const Visit& visit) {
  const auto point = [](int v) { return std::array{v}; };
  const auto edge = [&](int e) { return mesh.edges[e]; };
  const auto triangle = [&](int t) { return mesh.triangles[t]; };
  visit(c.point_triangle, point, triangle, &Clearances::point_triangle, &SomeCandidates::point_triangle);
  visit(c.edge_edge, edge, edge, &Clearances::edge_edge, &SomeCandidates::edge_edge);
  visit(c.point_edge, point, edge, &Clearances::point_edge, &SomeCandidates::point_edge);
  visit(c.point_point, point, point, &Clearances::point_point, &SomeCandidates::point_point);
}

// Half diagonals of boxes around the places that distances are of, so that vertices in the boxes are no further from there [m].
std::vector<double> radii_around(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, const VecX& places) {
  std::vector<double> radii(vertex_boxes.size());
  for (const int v : mesh.vertices) {
    const Aabb& box = vertex_boxes[v];
    const double error = rounding * (box.lo.cwiseAbs().maxCoeff() + box.hi.cwiseAbs().maxCoeff());
    const Vec3 place = vertex(places, v);
    radii[v] = (box.hi - place).cwiseMax(place - box.lo).norm() * (1 + accuracy) + error;
  }
  return radii;
}

void set_centre(const std::vector<Aabb>& vertex_boxes, int v, VecX& places) {
  vertex(places, v) = 0.5 * (vertex_boxes[v].lo + vertex_boxes[v].hi);
}

// Calls body(begin, end, at) for runs of all candidates of a kind (null), or of some; at(i): the place of the i-th of them.
template <class Body>
void for_places(size_t all, const std::vector<int>* some, int chunk, const Body& body) {
  const int n = static_cast<int>(some ? some->size() : all);
  for_each_chunk(n, [&](int, int begin, int end) {
    if (some) body(begin, end, [&](int i) { return (*some)[i]; });
    else body(begin, end, [](int i) { return i; });
  }, chunk);
}

// The distances, where vertices are at the reference, of all candidates (null) or of some.
void find_distances(const CollisionMesh& mesh, const SomeCandidates* some, Candidates& candidates) {
  const VecX& x = candidates.reference;
  for_each_kind(mesh, candidates, [&](const auto& pairs, const auto& first, const auto& second, auto member, auto places) {
    std::vector<double>& distances = candidates.distances.*member;
    distances.resize(pairs.size());
    for_places(pairs.size(), some ? &(some->*places) : nullptr, 512, [&](int begin, int end, const auto& at) {
      std::array<PackVec3, std::tuple_size_v<decltype(first(0))>> a;
      std::array<PackVec3, std::tuple_size_v<decltype(second(0))>> b;
      for (int i = begin; i < end; i += pack_width) {
        const int n = std::min(pack_width, end - i);
        for (int l = 0; l < pack_width; ++l) {
          const auto& pair = pairs[at(i + std::min(l, n - 1))];
          const auto va = first(pair[0]);
          const Vec3 origin = vertex(x, va[0]);
          set_places(x, va, origin, l, a);
          set_places(x, second(pair[1]), origin, l, b);
        }
        const Pack apart = slab_bound(a, b);
        for (int l = 0; l < n; ++l) distances[at(i + l)] = std::max(0.0, (1 - accuracy) * apart[l]);
      }
    });
  });
}

// From the distances, likewise.
void set_clearances(const CollisionMesh& mesh, const std::vector<double>& radii, const SomeCandidates* some, Candidates& candidates) {
  for_each_kind(mesh, candidates, [&](const auto& pairs, const auto& first, const auto& second, auto member, auto places) {
    std::vector<double>& clearances = candidates.clearances.*member;
    clearances.resize(pairs.size());
    for_places(pairs.size(), some ? &(some->*places) : nullptr, 2048, [&](int begin, int end, const auto& at) {
      for (int k = begin; k < end; ++k) {
        const int i = at(k);
        const double motion = largest_radius(radii, first(pairs[i][0])) + largest_radius(radii, second(pairs[i][1]));
        clearances[i] = std::max(0.0, (candidates.distances.*member)[i] - motion);
      }
    });
  });
}

}  // namespace

void find_distances(const CollisionMesh& mesh, const VecX& x, Candidates& candidates) {
  candidates.reference = x;
  find_distances(mesh, nullptr, candidates);
}

void find_clearances(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, Candidates& candidates) {
  candidates.reference = VecX::Zero(3 * static_cast<Eigen::Index>(vertex_boxes.size()));
  for (const int v : mesh.vertices) set_centre(vertex_boxes, v, candidates.reference);
  find_distances(mesh, nullptr, candidates);
  set_clearances(mesh, radii_around(mesh, vertex_boxes, candidates.reference), nullptr, candidates);
}

void find_fresh_clearances(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, const std::vector<char>& changed, const SomeCandidates& fresh,
                           Candidates& candidates) {
  for (const int v : mesh.vertices)
    if (changed[mesh.vertex_object[v]]) set_centre(vertex_boxes, v, candidates.reference);
  find_distances(mesh, &fresh, candidates);
  set_clearances(mesh, radii_around(mesh, vertex_boxes, candidates.reference), &fresh, candidates);
}

}  // namespace tack
