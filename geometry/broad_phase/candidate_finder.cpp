#include "geometry/broad_phase/candidate_finder.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "geometry/broad_phase/overlap_pairs.hpp"

namespace tack {
namespace {

// The relation of overlap_pairs: no common vertex, not rigid together, and objects that may touch.
template <std::size_t M, std::size_t N>
struct MayTouch {
  const Primitives<M>& first;
  const Primitives<N>& second;
  const CollidingObjects& colliding;
  bool dissolved;  // whether groups count for nothing
  const Rivals& rivals;

  bool accept(int a, int b) const {
    if (!dissolved && first.groups[a] >= 0 && first.groups[a] == second.groups[b]) return false;
    return !share_vertex(first.vertices[a], second.vertices[b]) &&
           colliding.allows(first.objects[a], second.objects[b]);
  }
  bool skips_kin() const { return !dissolved; }
  bool alone(int kin, const Aabb& box) const { return !rivals.near(kin, box); }
  std::array<int, 2> pair(int a, int b) const { return {first.ids[a], second.ids[b]}; }
};

// 0 .. n-1, stably sorted by the object of the triangle: the order that candidates are wanted in.
std::vector<int> triangles_by_object(const CollisionMesh& mesh) {
  std::vector<int> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  const auto object = [&](int t) { return mesh.vertex_object[mesh.triangles[t][0]]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return object(a) < object(b); });
  return order;
}

// found <- what it holds and the pairs of `kept` that touch nothing that changed, in the order of `key`, of one kind of candidates.
template <class Changed, class Key>
void merge_kept(const Candidates& kept, std::vector<std::array<int, 2>> Candidates::* list, std::vector<double> Clearances::* lengths,
                const Changed& changed, const Key& key, Candidates& found) {
  const std::vector<std::array<int, 2>> fresh = std::move(found.*list);
  const std::vector<std::array<int, 2>>& old = kept.*list;
  std::vector<std::array<int, 2>> all;
  std::vector<double> clearances, distances;
  const size_t most = old.size() + fresh.size();
  all.reserve(most);
  clearances.reserve(most);
  distances.reserve(most);
  auto next = fresh.begin();
  const auto take_fresh = [&](auto end) {
    all.insert(all.end(), next, end);
    clearances.resize(all.size(), unknown_length);
    distances.resize(all.size(), unknown_length);
    next = end;
  };
  for (size_t i = 0; i < old.size(); ++i) {
    if (changed(old[i])) continue;
    if (next != fresh.end() && key(*next) < key(old[i]))
      take_fresh(std::find_if(next, fresh.end(), [&](const auto& pair) { return !(key(pair) < key(old[i])); }));
    all.push_back(old[i]);
    clearances.push_back((kept.clearances.*lengths)[i]);
    distances.push_back((kept.distances.*lengths)[i]);
  }
  take_fresh(fresh.end());
  found.*list = std::move(all);
  found.clearances.*lengths = std::move(clearances);
  found.distances.*lengths = std::move(distances);
}

}  // namespace

CandidateFinder::CandidateFinder(const CollisionMesh& mesh, CollidingObjects colliding)
    : mesh_(mesh), colliding_(std::move(colliding)), rivals_(mesh) {
  for (const int v : mesh.vertices) points_.add({v}, v, mesh);
  for (const int v : mesh.codim_points) codim_points_.add({v}, v, mesh);
  for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e) edges_.add(mesh.edges[e], e, mesh);
  for (const int e : mesh.codim_edges) codim_edges_.add(mesh.edges[e], e, mesh);
  for (const int t : triangles_by_object(mesh)) triangles_.add(mesh.triangles[t], t, mesh);
}

void CandidateFinder::find(const std::vector<Aabb>& vertex_boxes, const Reaches& reaches, Candidates& candidates) {
  search(vertex_boxes, reaches, {}, candidates);
}

void CandidateFinder::find_again(const std::vector<Aabb>& vertex_boxes, const Reaches& reaches, const std::vector<char>& changed,
                                 Candidates& candidates) {
  Candidates found;
  search(vertex_boxes, reaches, changed, found);
  found.reference = std::move(candidates.reference);
  const auto of_vertex = [&](int v) { return changed[mesh_.vertex_object[v]] != 0; };
  const auto of_edge = [&](int e) { return of_vertex(mesh_.edges[e][0]); };
  const auto of_triangle = [&](int t) { return of_vertex(mesh_.triangles[t][0]); };
  const auto same = [](const std::array<int, 2>& pair) { return pair; };
  const auto merge = [&](auto list, auto lengths, const auto& first, const auto& second, const auto& key) {
    merge_kept(candidates, list, lengths, [&](const auto& pair) { return first(pair[0]) || second(pair[1]); }, key, found);
  };
  merge(&Candidates::point_triangle, &Clearances::point_triangle, of_vertex, of_triangle,
        [&](const auto& pair) { return std::array{pair[0], mesh_.vertex_object[mesh_.triangles[pair[1]][0]], pair[1]}; });
  merge(&Candidates::edge_edge, &Clearances::edge_edge, of_edge, of_edge, same);
  merge(&Candidates::point_edge, &Clearances::point_edge, of_vertex, of_edge, same);
  merge(&Candidates::point_point, &Clearances::point_point, of_vertex, of_vertex, same);
  candidates = std::move(found);
}

void CandidateFinder::search(const std::vector<Aabb>& vertex_boxes, const Reaches& reaches, const std::vector<char>& active_objects,
                             Candidates& candidates) {
  const auto refresh = [&](auto&... kinds) { (kinds.refresh_tree(vertex_boxes, reaches.surface, active_objects), ...); };
  refresh(points_, codim_points_, codim_edges_, triangles_);
  edges_.refresh_tree(vertex_boxes, reaches.edge, active_objects);
  std::vector<double> furthest = reaches.surface;
  for (size_t i = 0; i < furthest.size(); ++i) furthest[i] = std::max(furthest[i], reaches.edge[i]);
  rivals_.find(vertex_boxes, furthest);
  overlap_pairs(points_.tree, triangles_.tree, MayTouch<1, 3>{points_, triangles_, colliding_, dissolved_, rivals_},
                candidates.point_triangle);
  overlap_pairs(edges_.tree, MayTouch<2, 2>{edges_, edges_, colliding_, dissolved_, rivals_}, candidates.edge_edge);
  overlap_pairs(points_.tree, codim_edges_.tree, MayTouch<1, 2>{points_, codim_edges_, colliding_, dissolved_, rivals_},
                candidates.point_edge);
  overlap_pairs(codim_points_.tree, MayTouch<1, 1>{codim_points_, codim_points_, colliding_, dissolved_, rivals_},
                candidates.point_point);
}

void CandidateFinder::triangles_in(const Aabb& box, int without, std::vector<int>& out) const {
  if (triangles_.tree.size() == 0) return;
  const size_t before = out.size();
  detail::visit_groups(triangles_.tree, box, false, -1, [&](int group) {
    for (unsigned lanes = triangles_.tree.boxes(0, group).overlap_mask(box); lanes != 0; lanes &= lanes - 1) {
      const int i = triangles_.tree.primitives(group)[std::countr_zero(lanes)];
      if (triangles_.objects[i] != without) out.push_back(triangles_.ids[i]);
    }
  });
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end());
}

}  // namespace tack
