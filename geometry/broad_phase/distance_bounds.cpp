#include "geometry/broad_phase/distance_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/broad_phase/candidate_kinds.hpp"
#include "geometry/distance/slab_bounds.hpp"
#include "geometry/parallel.hpp"
#include "geometry/parallel_loops.hpp"

namespace tack {
namespace {

constexpr double distance_tolerance = 1e-6;                               // relative: far above rounding errors of distances
constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();  // relative, of coordinates

constexpr int vertices_per_chunk = 1024;
constexpr int distances_per_chunk = 256, bounds_per_chunk = 1024;  // candidates

template <size_t N>
double largest_radius(const std::vector<double>& radii, const std::array<int, N>& v) {
  double radius = 0;
  for (const int i : v) radius = std::max(radius, radii[i]);
  return radius;
}

// Sets one lane to the positions of vertices, relative to an origin.
template <size_t N>
void set_positions(const VecX& x, const std::array<int, N>& v, const Vec3& origin, int lane, std::array<PackVec3, N>& positions) {
  for (size_t i = 0; i < N; ++i)
    for (int d = 0; d < 3; ++d) positions[i](d).set(lane, x[3 * v[i] + d] - origin[d]);
}

// Returns, per vertex, the largest distance from its reference position to a point of its box [m].
std::vector<double> radii_around(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, const VecX& reference) {
  std::vector<double> radii(vertex_boxes.size());
  for_each(static_cast<int>(mesh.vertices.size()), [&](int i) {
    const int v = mesh.vertices[i];
    const Aabb& box = vertex_boxes[v];
    const double error = rounding * (box.lo.cwiseAbs().maxCoeff() + box.hi.cwiseAbs().maxCoeff());
    const Vec3 position = vertex(reference, v);
    radii[v] = (box.hi - position).cwiseMax(position - box.lo).norm() * (1 + distance_tolerance) + error;
  }, vertices_per_chunk);
  return radii;
}

void set_centre(const std::vector<Aabb>& vertex_boxes, int v, VecX& positions) {
  vertex(positions, v) = 0.5 * (vertex_boxes[v].lo + vertex_boxes[v].hi);
}

// Adds a loop that calls body(begin, end, at) for chunks of all candidates of a kind (some: null) or of some. at(i):
// index of the i-th candidate.
template <class Body>
void add_loop(size_t all, const std::vector<int>* some, int chunk, const Body& body, ParallelLoops& loops) {
  const int n = static_cast<int>(some ? some->size() : all);
  loops.add(n, [some, body](int, int begin, int end) {
    if (some) body(begin, end, [&](int i) { return (*some)[i]; });
    else body(begin, end, [](int i) { return i; });
  }, chunk);
}

// Sets the reference distances of all candidates (some: null) or of some.
void find_reference_distances(const CollisionMesh& mesh, const CandidateIndices* some, Candidates& candidates) {
  const VecX& x = candidates.reference;
  ParallelLoops loops;
  for_each_kind(mesh, candidates, [&](const auto& kind) {
    std::vector<double>& distances = candidates.reference_distances.*kind.lengths;
    distances.resize(kind.pairs.size());
    add_loop(kind.pairs.size(), some ? &(some->*kind.indices) : nullptr, distances_per_chunk, [kind, &x, &distances](int begin, int end, const auto& at) {
      std::array<PackVec3, std::tuple_size_v<std::decay_t<decltype(kind.first({}))>>> a;
      std::array<PackVec3, std::tuple_size_v<std::decay_t<decltype(kind.second({}))>>> b;
      for (int i = begin; i < end; i += pack_width) {
        const int n = std::min(pack_width, end - i);
        for (int l = 0; l < pack_width; ++l) {
          const auto& pair = kind.pairs[at(i + std::min(l, n - 1))];
          const auto va = kind.first(pair);
          const Vec3 origin = vertex(x, va[0]);
          set_positions(x, va, origin, l, a);
          set_positions(x, kind.second(pair), origin, l, b);
        }
        const Pack slab_distance = slab_bound(a, b);
        for (int l = 0; l < n; ++l) distances[at(i + l)] = std::max(0.0, (1 - distance_tolerance) * slab_distance[l]);
      }
    }, loops);
  });
  loops.run();
}

// Sets the distance bounds of all candidates (some: null) or of some, from their reference distances.
void set_distance_bounds(const CollisionMesh& mesh, const std::vector<double>& radii, const CandidateIndices* some, Candidates& candidates) {
  ParallelLoops loops;
  for_each_kind(mesh, candidates, [&](const auto& kind) {
    std::vector<double>& distance_bounds = candidates.distance_bounds.*kind.lengths;
    distance_bounds.resize(kind.pairs.size());
    add_loop(kind.pairs.size(), some ? &(some->*kind.indices) : nullptr, bounds_per_chunk, [kind, &radii, &distance_bounds, &candidates](int begin, int end, const auto& at) {
      for (int k = begin; k < end; ++k) {
        const int i = at(k);
        const double motion = largest_radius(radii, kind.first(kind.pairs[i])) + largest_radius(radii, kind.second(kind.pairs[i]));
        distance_bounds[i] = std::max(0.0, (candidates.reference_distances.*kind.lengths)[i] - motion);
      }
    }, loops);
  });
  loops.run();
}

}  // namespace

void find_reference_distances(const CollisionMesh& mesh, const VecX& x, Candidates& candidates) {
  candidates.reference = x;
  find_reference_distances(mesh, nullptr, candidates);
}

void find_distance_bounds(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, Candidates& candidates) {
  candidates.reference = VecX::Zero(3 * static_cast<Eigen::Index>(vertex_boxes.size()));
  for_each(static_cast<int>(mesh.vertices.size()), [&](int i) { set_centre(vertex_boxes, mesh.vertices[i], candidates.reference); }, vertices_per_chunk);
  find_reference_distances(mesh, nullptr, candidates);
  set_distance_bounds(mesh, radii_around(mesh, vertex_boxes, candidates.reference), nullptr, candidates);
}

void find_new_distance_bounds(const CollisionMesh& mesh, const std::vector<Aabb>& vertex_boxes, const std::vector<char>& changed, const CandidateIndices& new_candidates,
                              Candidates& candidates) {
  for_each(static_cast<int>(mesh.vertices.size()), [&](int i) {
    const int v = mesh.vertices[i];
    if (changed[mesh.vertex_object[v]]) set_centre(vertex_boxes, v, candidates.reference);
  }, vertices_per_chunk);
  find_reference_distances(mesh, &new_candidates, candidates);
  set_distance_bounds(mesh, radii_around(mesh, vertex_boxes, candidates.reference), &new_candidates, candidates);
}

}  // namespace tack
