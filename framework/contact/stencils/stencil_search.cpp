#include "framework/contact/stencils/stencil_search.hpp"

#include <algorithm>
#include <tuple>

#include "framework/contact/stencils/rest_neighbours.hpp"
#include "framework/contact/stencils/sorted_cursor.hpp"
#include "geometry/concatenate.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"
#include "geometry/parallel.hpp"
#include "geometry/parallel_loops.hpp"

namespace tack {
namespace {

constexpr int chunks_per_task = 4;

// Joins the stencils of one kind of all chunks, stably sorted by law. Both steps are loops over chunks or over runs of
// equal law, so that those of all kinds may run together.
template <class Stencils>
class KindJoin {
 public:
  KindJoin(std::vector<FoundStencils>& chunks, Stencils FoundStencils::* member, Stencils& all)
      : chunks_(chunks), member_(member), all_(all), runs_of_chunk_(chunks.size()) {}

  // Adds the loop that sorts the stencils of each chunk.
  void add_sort(ParallelLoops& loops) {
    loops.add(static_cast<int>(chunks_.size()), [this](int, int first, int last) {
      for (int c = first; c < last; ++c) sort(c);
    }, chunks_per_task);
  }
  // Adds the loop that copies the sorted stencils.
  void add_copy(ParallelLoops& loops) {
    concatenate(runs_of_chunk_, runs_);
    std::stable_sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.law < b.law; });
    size_t size = 0;
    for (Run& run : runs_) {
      run.to = size;
      size += run.last - run.first;
    }
    all_.resize(size);
    loops.add(static_cast<int>(runs_.size()), [this](int, int first, int last) {
      for (int r = first; r < last; ++r) copy(runs_[r]);
    }, chunks_per_task);
  }

 private:
  // Stencils of one law of one chunk, and where they begin in the joined list.
  struct Run {
    int law, chunk;
    size_t first, last, to;
  };

  void sort(int c) {
    Stencils& list = chunks_[c].*member_;
    const auto by_law = [](const auto& a, const auto& b) { return a.law < b.law; };
    if (!std::is_sorted(list.begin(), list.end(), by_law)) std::stable_sort(list.begin(), list.end(), by_law);
    for (size_t i = 0; i < list.size(); ++i) {
      if (i == 0 || list[i].law != list[i - 1].law) runs_of_chunk_[c].push_back({list[i].law, c, i, i, 0});
      runs_of_chunk_[c].back().last = i + 1;
    }
  }
  void copy(const Run& run) {
    const Stencils& list = chunks_[run.chunk].*member_;
    std::copy(list.begin() + static_cast<std::ptrdiff_t>(run.first), list.begin() + static_cast<std::ptrdiff_t>(run.last),
              all_.begin() + static_cast<std::ptrdiff_t>(run.to));
  }

  std::vector<FoundStencils>& chunks_;
  Stencils FoundStencils::* const member_;
  Stencils& all_;
  std::vector<std::vector<Run>> runs_of_chunk_;
  std::vector<Run> runs_;  // by law, then by chunk
};

// Numbers the contact points on from chunk to chunk. Returns their count.
int number_points(std::vector<FoundStencils>& chunks) {
  std::vector<int> first(chunks.size() + 1, 0);
  for (size_t c = 0; c < chunks.size(); ++c) first[c + 1] = first[c] + chunks[c].point_count;
  if (first.back() == 0) return 0;
  for_each(static_cast<int>(chunks.size()), [&](int c) {
    const auto shift = [&](auto& stencils) {
      for (auto& s : stencils) s.point += first[c];
    };
    shift(chunks[c].point_point);
    shift(chunks[c].point_edge);
    shift(chunks[c].point_triangle);
  }, chunks_per_task);
  return first.back();
}

void join_all(std::vector<FoundStencils>& points, std::vector<FoundStencils>& edges, std::vector<FoundStencils>& interior, const VecX& rest,
              ContactSet& contacts) {
  contacts.point_count = number_points(points);
  contacts.interior_point_count = 0;
  std::tuple joins{KindJoin(interior, &FoundStencils::interior_point, contacts.interior_point),
                   KindJoin(interior, &FoundStencils::interior_edge, contacts.interior_edge),
                   KindJoin(interior, &FoundStencils::interior_triangle, contacts.interior_triangle),
                   KindJoin(points, &FoundStencils::point_point, contacts.point_point),
                   KindJoin(points, &FoundStencils::point_edge, contacts.point_edge),
                   KindJoin(points, &FoundStencils::point_triangle, contacts.point_triangle),
                   KindJoin(edges, &FoundStencils::edge_edge, contacts.edge_edge)};
  ParallelLoops sorting, copying;
  std::apply([&](auto&... kinds) { (kinds.add_sort(sorting), ...); }, joins);
  sorting.run();
  std::apply([&](auto&... kinds) { (kinds.add_copy(copying), ...); }, joins);
  copying.run();
  contacts.mollifier_threshold.resize(contacts.edge_edge.size());
  for_each(static_cast<int>(contacts.edge_edge.size()), [&](int i) {
    const auto& v = contacts.edge_edge[i].vertices;
    contacts.mollifier_threshold[i] = edge_edge_mollifier_threshold(vertex(rest, v[0]), vertex(rest, v[1]), vertex(rest, v[2]), vertex(rest, v[3]));
  });
}

double shared_area(double a, double b, double area_ratio_max) {
  const auto [smaller, larger] = std::minmax(a, b);
  return smaller > 0 ? smaller + std::min(larger, area_ratio_max * smaller) : larger;
}

}  // namespace

FreeVertices::FreeVertices(const CollisionMesh& mesh, std::vector<char> free_vertices) : free(std::move(free_vertices)) {
  if (free.empty()) return;
  one_ring = free;
  for (const auto& [a, b] : mesh.edges) {
    one_ring[a] |= free[b];
    one_ring[b] |= free[a];
  }
}

const PairRole& EdgePairs::role_of(const Edge& a, const Edge& b) const {
  const int object = surface_.mesh.vertex_object[a[0]], other = surface_.mesh.vertex_object[b[0]];
  return pairs_.edge(object, other, pairs_.region_pair(object, other, a, b));
}

void EdgePairs::choose(const Candidates& candidates, const ChangedPrimitives* changed) {
  constexpr int chunk = 1024;
  const CollisionMesh& mesh = surface_.mesh;
  // Returns the law of an edge-edge candidate; -1: it does not press.
  const auto law_of = [&, largest = pairs_.largest_edge_range()](int i) {
    if (candidates.distance_bounds.edge_edge[i] >= largest) return -1;
    const auto [ia, ib] = candidates.edge_edge[i];
    const Edge &a = mesh.edges[ia], &b = mesh.edges[ib];
    const PairRole& role = role_of(a, b);
    if (role.law < 0 || candidates.distance_bounds.edge_edge[i] >= role.range) return -1;
    const bool within_object = mesh.vertex_object[a[0]] == mesh.vertex_object[b[0]];
    if (!within_object || neighbours_ == RestNeighbours::press || !close_at_rest(surface_, a, b, role.range)) return role.law;
    if (!surface_.rest_gaps || !surface_.rest_gaps->gap_between(a, b)) return -1;
    return surface_.rest_gaps->law_of_edges(role.law, a, b);
  };
  const int n = static_cast<int>(candidates.edge_edge.size());
  std::vector<std::vector<EdgePair>> chunks(chunk_count(n, chunk));
  for_each_chunk(n, [&](int c, int first, int last) {
    SortedCursor<EdgePair> before(chosen_);
    for (int i = first; i < last; ++i) {
      const std::array<int, 2>& edges = candidates.edge_edge[i];
      const bool decided = changed && !changed->edges[edges[0]] && !changed->edges[edges[1]];
      const EdgePair* known = decided ? before.find(edges) : nullptr;
      const int law = known ? known->law : decided ? -1 : law_of(i);
      if (law >= 0) chunks[c].push_back({i, edges, law});
    }
  }, chunk);
  concatenate(chunks, chosen_before_);
  std::swap(chosen_, chosen_before_);
}

void EdgePairs::search(const Candidates& candidates, const DisplacementBounds& displacements, const std::vector<char>& free, const VecX& x, int first,
                       int last, const std::vector<double>& edge_area, FoundStencils& found) const {
  const double largest = pairs_.largest_edge_range();
  for (int i = first; i < last; ++i) {
    const auto [ia, ib] = chosen_[i].edges;
    if (candidates.reference_distances.edge_edge[chosen_[i].candidate] - displacements.edge(ia) - displacements.edge(ib) >= largest) continue;
    search(free, x, i, edge_area, found);
  }
}

void EdgePairs::search(const std::vector<char>& free, const VecX& x, int pair, const std::vector<double>& edge_area, FoundStencils& found) const {
  const auto [ia, ib] = chosen_[pair].edges;
  const Edge &a = surface_.mesh.edges[ia], &b = surface_.mesh.edges[ib];
  const PairRole& role = role_of(a, b);
  const int law = chosen_[pair].law;
  const double range = law == role.law ? role.range : surface_.rest_gaps->range(law);
  const auto ca = corners(x, a), cb = corners(x, b);
  if (box_gaps(ca, cb).maxCoeff() >= range) return;  // their boxes are too far apart already
  if (!(edge_edge_distance(ca[0], ca[1], cb[0], cb[1]) < range * range)) return;
  if (!any_of(free, std::array{a[0], a[1], b[0], b[1]})) return;
  found.edge_edge.push_back({{a[0], a[1], b[0], b[1]}, law, -1, role.area_factor * shared_area(edge_area[ia], edge_area[ib], role.area_ratio_max)});
}

void join(FoundChunks chunks, const VecX& rest, ContactSet& contacts) { join_all(chunks.points, chunks.edges, chunks.interior, rest, contacts); }

void join(std::vector<FoundStencils> chunks, const VecX& rest, ContactSet& contacts) { join_all(chunks, chunks, chunks, rest, contacts); }

}  // namespace tack
