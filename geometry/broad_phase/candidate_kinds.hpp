// Kinds of candidates (candidates.hpp), in one place: a vertex and a triangle, two edges, a vertex
// and a rod, two particles. Code that treats all kinds alike visits them:
//    for_each_kind(mesh, candidates, [&](const auto& kind) {
//      for (const auto& pair : kind.pairs) use(kind.first(pair), kind.second(pair));
//    });
#pragma once

#include <array>
#include <vector>

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

/// The primitives of one class of a mesh; operator() returns the global vertices of one.
struct VertexPrimitives {
  std::array<int, 1> operator()(int vertex) const { return {vertex}; }
};
struct EdgePrimitives {
  const std::vector<Edge>& edges;
  const Edge& operator()(int edge) const { return edges[edge]; }
};
struct TrianglePrimitives {
  const std::vector<Triangle>& triangles;
  const Triangle& operator()(int triangle) const { return triangles[triangle]; }
};

/// The candidates of one kind.
template <class First, class Second>
struct CandidateKind {
  using Pairs = std::vector<std::array<int, 2>>;

  First first_primitives;
  Second second_primitives;
  Pairs Candidates::*list;                         // member with the pairs
  std::vector<double> CandidateLengths::*lengths;  // member with their lengths
  std::vector<int> CandidateIndices::*indices;     // member with indices of them
  const Pairs& pairs;

  /// Return the global vertices of the primitives of a pair.
  decltype(auto) first(const std::array<int, 2>& pair) const { return first_primitives(pair[0]); }
  decltype(auto) second(const std::array<int, 2>& pair) const { return second_primitives(pair[1]); }
};

/// Calls visit(CandidateKind) for each kind of candidates.
template <class Visit>
void for_each_kind(const CollisionMesh& mesh, const Candidates& candidates, const Visit& visit) {
  const VertexPrimitives vertices;
  const EdgePrimitives edges{mesh.edges};
  const TrianglePrimitives triangles{mesh.triangles};
  using C = Candidates;
  using L = CandidateLengths;
  using I = CandidateIndices;
  const auto kind = [&](const auto& first, const auto& second, auto list, auto lengths,
                        auto indices) {
    using First = std::decay_t<decltype(first)>;
    using Second = std::decay_t<decltype(second)>;
    visit(CandidateKind<First, Second>{first, second, list, lengths, indices, candidates.*list});
  };
  kind(vertices, triangles, &C::point_triangle, &L::point_triangle, &I::point_triangle);
  kind(edges, edges, &C::edge_edge, &L::edge_edge, &I::edge_edge);
  kind(vertices, edges, &C::point_edge, &L::point_edge, &I::point_edge);
  kind(vertices, vertices, &C::point_point, &L::point_point, &I::point_point);
}

}  // namespace tack
