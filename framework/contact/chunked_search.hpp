// Chunks of a search over the candidates of surfaces: point-triangle candidates by vertex, then
// edge-edge candidates. Each chunk has its own results, in the order of the candidates, so that
// they are the same for any number of threads.
#pragma once

#include <vector>

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/parallel.hpp"

namespace tack {

// Returns the results of all chunks. make_search(found) makes the search of a chunk, with
//   search_vertex(first, last)  the point-triangle candidates [first, last), all of one vertex
//   search_edges(i)             one edge-edge candidate
template <class Found, class MakeSearch>
std::vector<Found> search_in_chunks(const Candidates& candidates, const MakeSearch& make_search) {
  std::vector<int> groups;  // first candidate of each vertex, and the end
  const auto& points = candidates.point_triangle;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (i == 0 || points[i][0] != points[i - 1][0]) groups.push_back(static_cast<int>(i));
  const int vertices = static_cast<int>(groups.size());
  const int edges = static_cast<int>(candidates.edge_edge.size());
  groups.push_back(static_cast<int>(points.size()));
  constexpr int vertices_per_chunk = 64;
  const int vertex_chunks = chunk_count(vertices, vertices_per_chunk);
  std::vector<Found> found(vertex_chunks + chunk_count(edges));
  for_each_chunk(
      vertices,
      [&](int c, int first, int last) {
        auto search = make_search(found[c]);
        for (int g = first; g < last; ++g) search.search_vertex(groups[g], groups[g + 1]);
      },
      vertices_per_chunk);
  for_each_chunk(edges, [&](int c, int first, int last) {
    auto search = make_search(found[vertex_chunks + c]);
    for (int i = first; i < last; ++i) search.search_edges(i);
  });
  return found;
}

}  // namespace tack
