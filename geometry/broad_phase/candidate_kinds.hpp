// Kinds of candidates (candidates.hpp), in one place: a vertex and a triangle, two edges, a vertex
// and a rod, two particles. Code that treats all kinds alike visits them:
//    for_each_kind(mesh, candidates, [&](const auto& kind) {
//      for (const auto& pair : kind.pairs) use(kind.first(pair), kind.second(pair));
//    });
#pragma once

#include <array>
#include <vector>

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/broad_phase/changed_primitives.hpp"
#include "geometry/broad_phase/displacement_bounds.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

/// The primitives of one class of a mesh; operator() returns the global vertices of one, bound()
/// its displacement bound [m].
struct VertexPrimitives {
  explicit VertexPrimitives(const CollisionMesh&) {}
  std::array<int, 1> operator()(int vertex) const { return {vertex}; }
  static double bound(const DisplacementBounds& bounds, int vertex) {
    return bounds.vertex(vertex);
  }
  static const std::vector<char>& of(const ChangedPrimitives& flags) { return flags.vertices; }
};
struct EdgePrimitives {
  explicit EdgePrimitives(const CollisionMesh& mesh) : edges(mesh.edges) {}
  const Edge& operator()(int edge) const { return edges[edge]; }
  static double bound(const DisplacementBounds& bounds, int edge) { return bounds.edge(edge); }
  static const std::vector<char>& of(const ChangedPrimitives& flags) { return flags.edges; }
  const std::vector<Edge>& edges;
};
struct TrianglePrimitives {
  explicit TrianglePrimitives(const CollisionMesh& mesh) : triangles(mesh.triangles) {}
  const Triangle& operator()(int triangle) const { return triangles[triangle]; }
  static double bound(const DisplacementBounds& bounds, int triangle) {
    return bounds.triangle(triangle);
  }
  static const std::vector<char>& of(const ChangedPrimitives& flags) { return flags.triangles; }
  const std::vector<Triangle>& triangles;
};

/// Primitives that a search pairs; rods are codimensional edges, particles codimensional points.
enum class SearchedPrimitives { vertices, edges, triangles, rods, particles };

/// The kinds. First and Second: classes of the primitives; first_searched, second_searched: those
/// among them that are searched; list, lengths, indices: members with the pairs, with their
/// lengths and with indices of them; order_key(mesh, pair): the lists ascend by it.
struct PointTriangleCandidates {
  using First = VertexPrimitives;
  using Second = TrianglePrimitives;
  static constexpr auto first_searched = SearchedPrimitives::vertices;
  static constexpr auto second_searched = SearchedPrimitives::triangles;
  static constexpr auto list = &Candidates::point_triangle;
  static constexpr auto lengths = &CandidateLengths::point_triangle;
  static constexpr auto indices = &CandidateIndices::point_triangle;
  static std::array<int, 3> order_key(const CollisionMesh& mesh, const std::array<int, 2>& pair) {
    return {pair[0], mesh.vertex_object[mesh.triangles[pair[1]][0]], pair[1]};
  }
};
struct OrderedByPair {
  static std::array<int, 2> order_key(const CollisionMesh&, const std::array<int, 2>& pair) {
    return pair;
  }
};
struct EdgeEdgeCandidates : OrderedByPair {
  using First = EdgePrimitives;
  using Second = EdgePrimitives;
  static constexpr auto first_searched = SearchedPrimitives::edges;
  static constexpr auto second_searched = SearchedPrimitives::edges;
  static constexpr auto list = &Candidates::edge_edge;
  static constexpr auto lengths = &CandidateLengths::edge_edge;
  static constexpr auto indices = &CandidateIndices::edge_edge;
};
struct PointEdgeCandidates : OrderedByPair {
  using First = VertexPrimitives;
  using Second = EdgePrimitives;
  static constexpr auto first_searched = SearchedPrimitives::vertices;
  static constexpr auto second_searched = SearchedPrimitives::rods;
  static constexpr auto list = &Candidates::point_edge;
  static constexpr auto lengths = &CandidateLengths::point_edge;
  static constexpr auto indices = &CandidateIndices::point_edge;
};
struct PointPointCandidates : OrderedByPair {
  using First = VertexPrimitives;
  using Second = VertexPrimitives;
  static constexpr auto first_searched = SearchedPrimitives::particles;
  static constexpr auto second_searched = SearchedPrimitives::particles;
  static constexpr auto list = &Candidates::point_point;
  static constexpr auto lengths = &CandidateLengths::point_point;
  static constexpr auto indices = &CandidateIndices::point_point;
};

/// Calls visit(kind) with an object of each kind: the most numerous one first, which bounds steps
/// most tightly.
template <class Visit>
void for_each_kind(const Visit& visit) {
  visit(EdgeEdgeCandidates{});
  visit(PointTriangleCandidates{});
  visit(PointEdgeCandidates{});
  visit(PointPointCandidates{});
}

/// The candidates of one kind.
template <class Kind>
struct CandidatesOfKind : Kind {
  CandidatesOfKind(const CollisionMesh& mesh, const Candidates& candidates)
      : first_primitives(mesh), second_primitives(mesh), pairs(candidates.*Kind::list),
        distance_bounds(candidates.distance_bounds.*Kind::lengths),
        reference_distances(candidates.reference_distances.*Kind::lengths) {}

  /// Return the global vertices of the primitives of a pair.
  decltype(auto) first(const std::array<int, 2>& pair) const { return first_primitives(pair[0]); }
  decltype(auto) second(const std::array<int, 2>& pair) const { return second_primitives(pair[1]); }
  /// Returns the largest change of the distance of a pair [m].
  static double distance_change(const DisplacementBounds& bounds, const std::array<int, 2>& pair) {
    return Kind::First::bound(bounds, pair[0]) + Kind::Second::bound(bounds, pair[1]);
  }

  typename Kind::First first_primitives;
  typename Kind::Second second_primitives;
  const std::vector<std::array<int, 2>>& pairs;
  const std::vector<double>&distance_bounds, &reference_distances;  // of the pairs [m]
};

/// Calls visit(CandidatesOfKind) for each kind of candidates.
template <class Visit>
void for_each_kind(const CollisionMesh& mesh, const Candidates& candidates, const Visit& visit) {
  for_each_kind([&](auto kind) { visit(CandidatesOfKind<decltype(kind)>(mesh, candidates)); });
}

}  // namespace tack
