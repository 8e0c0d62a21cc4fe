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

// found <- what it holds and the pairs of `kept` that touch nothing that changed, in the order of `key`.
template <class Key, class Changed>
void merge_kept(const std::vector<std::array<int, 2>>& kept, const Changed& changed, const Key& key,
                std::vector<std::array<int, 2>>& found) {
  std::vector<std::array<int, 2>> all;
  all.reserve(kept.size() + found.size());
  auto next = found.begin();
  for (const auto& pair : kept) {
    if (changed(pair)) continue;
    for (; next != found.end() && key(*next) < key(pair); ++next) all.push_back(*next);
    all.push_back(pair);
  }
  all.insert(all.end(), next, found.end());
  found = std::move(all);
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

void CandidateFinder::find(const std::vector<Aabb>& vertex_boxes, double inflation,
                           double edge_inflation, Candidates& candidates) {
  search(vertex_boxes, inflation, edge_inflation, {}, candidates);
}

void CandidateFinder::find_again(const std::vector<Aabb>& vertex_boxes, double inflation, double edge_inflation,
                                 const std::vector<char>& changed, Candidates& candidates) {
  Candidates found;
  search(vertex_boxes, inflation, edge_inflation, changed, found);
  const auto of_vertex = [&](int v) { return changed[mesh_.vertex_object[v]] != 0; };
  const auto of_edge = [&](int e) { return of_vertex(mesh_.edges[e][0]); };
  const auto of_triangle = [&](int t) { return of_vertex(mesh_.triangles[t][0]); };
  const auto same = [](const std::array<int, 2>& pair) { return pair; };
  merge_kept(candidates.point_triangle, [&](const auto& pair) { return of_vertex(pair[0]) || of_triangle(pair[1]); },
             [&](const auto& pair) { return std::array{pair[0], mesh_.vertex_object[mesh_.triangles[pair[1]][0]], pair[1]}; },
             found.point_triangle);
  merge_kept(candidates.edge_edge, [&](const auto& pair) { return of_edge(pair[0]) || of_edge(pair[1]); }, same, found.edge_edge);
  merge_kept(candidates.point_edge, [&](const auto& pair) { return of_vertex(pair[0]) || of_edge(pair[1]); }, same,
             found.point_edge);
  merge_kept(candidates.point_point, [&](const auto& pair) { return of_vertex(pair[0]) || of_vertex(pair[1]); }, same,
             found.point_point);
  candidates = std::move(found);
}

void CandidateFinder::search(const std::vector<Aabb>& vertex_boxes, double inflation, double edge_inflation,
                             const std::vector<char>& active_objects, Candidates& candidates) {
  const auto refresh = [&](auto&... kinds) { (kinds.refresh_tree(vertex_boxes, inflation, active_objects), ...); };
  refresh(points_, codim_points_, codim_edges_, triangles_);
  edges_.refresh_tree(vertex_boxes, edge_inflation, active_objects);
  rivals_.find(vertex_boxes, std::max(inflation, edge_inflation));
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
