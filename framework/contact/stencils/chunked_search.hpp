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
  const auto& points = candidates.point_triangle;
  const int all = static_cast<int>(points.size());
  const int edges = static_cast<int>(candidates.edge_edge.size());
  // Returns the first candidate from i on whose vertex has none before it, or the end.
  const auto next_vertex = [&](int i) {
    while (i > 0 && i < all && points[i][0] == points[i - 1][0]) ++i;
    return i;
  };
  constexpr int candidates_per_chunk = 1024;
  const int point_chunks = chunk_count(all, candidates_per_chunk);
  std::vector<Found> found(point_chunks + chunk_count(edges));
  for_each_chunk(
      all,
      [&](int c, int first, int last) {
        auto search = make_search(found[c]);
        const int end = next_vertex(last);
        for (int from = next_vertex(first), to; from < end; from = to) {
          to = next_vertex(from + 1);
          search.search_vertex(from, to);
        }
      },
      candidates_per_chunk);
  for_each_chunk(edges, [&](int c, int first, int last) {
    auto search = make_search(found[point_chunks + c]);
    for (int i = first; i < last; ++i) search.search_edges(i);
  });
  return found;
}

}  // namespace tack
