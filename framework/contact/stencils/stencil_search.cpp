#include "framework/contact/stencils/stencil_search.hpp"

#include "framework/contact/stencils/rest_neighbours.hpp"
#include "framework/contact/stencils/sorted_cursor.hpp"
#include "geometry/concatenate.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// added(chunk, begin, end): called after the stencils of a chunk were added.
template <class Stencils, class Added>
void join_kind(const std::vector<FoundStencils>& chunks, Stencils FoundStencils::* member, Stencils& all, Added added) {
  all.clear();
  for (const FoundStencils& chunk : chunks) {
    const auto begin = all.insert(all.end(), (chunk.*member).begin(), (chunk.*member).end());
    added(chunk, begin, all.end());
  }
  const auto by_law = [](const auto& a, const auto& b) { return a.law < b.law; };
  if (!std::is_sorted(all.begin(), all.end(), by_law)) std::stable_sort(all.begin(), all.end(), by_law);
}

template <int K>
void join_points(const std::vector<FoundStencils>& chunks, ContactStencils<K> FoundStencils::* member, ContactStencils<K>& all) {
  join_kind(chunks, member, all, [first = 0](const FoundStencils& chunk, auto begin, auto end) mutable {
    if (first > 0)
      for (auto s = begin; s != end; ++s) s->point += first;
    first += chunk.point_count;
  });
}

void join_all(const std::vector<FoundStencils>& points, const std::vector<FoundStencils>& edges, const std::vector<FoundStencils>& interior, const VecX& rest,
              ContactSet& contacts) {
  const auto as_they_are = [](const FoundStencils&, auto, auto) {};
  join_kind(interior, &FoundStencils::interior_point, contacts.interior_point, as_they_are);
  join_kind(interior, &FoundStencils::interior_edge, contacts.interior_edge, as_they_are);
  join_kind(interior, &FoundStencils::interior_triangle, contacts.interior_triangle, as_they_are);
  join_points(points, &FoundStencils::point_point, contacts.point_point);
  join_points(points, &FoundStencils::point_edge, contacts.point_edge);
  join_points(points, &FoundStencils::point_triangle, contacts.point_triangle);
  join_kind(edges, &FoundStencils::edge_edge, contacts.edge_edge, as_they_are);
  contacts.point_count = contacts.interior_point_count = 0;
  for (const FoundStencils& chunk : points) contacts.point_count += chunk.point_count;
  contacts.mollifier_threshold.clear();
  for (const auto& s : contacts.edge_edge)
    contacts.mollifier_threshold.push_back(edge_edge_mollifier_threshold(
        vertex(rest, s.vertices[0]), vertex(rest, s.vertices[1]), vertex(rest, s.vertices[2]), vertex(rest, s.vertices[3])));
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
  constexpr int chunk = 4096;
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
  std::vector<EdgePair> all;
  concatenate(chunks, all);
  chosen_ = std::move(all);
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

void join(const FoundChunks& chunks, const VecX& rest, ContactSet& contacts) { join_all(chunks.points, chunks.edges, chunks.interior, rest, contacts); }

void join(const std::vector<FoundStencils>& chunks, const VecX& rest, ContactSet& contacts) { join_all(chunks, chunks, chunks, rest, contacts); }

}  // namespace tack
