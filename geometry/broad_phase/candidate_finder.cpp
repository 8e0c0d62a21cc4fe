#include "geometry/broad_phase/candidate_finder.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "geometry/broad_phase/overlap_pairs.hpp"
#include "geometry/prefix_sums.hpp"

namespace tack {
namespace {

// The relation of overlap_pairs: no common vertex, not rigid together, and objects that may touch.
template <std::size_t M, std::size_t N>
struct MayTouch {
  const Primitives<M>& first;
  const Primitives<N>& second;
  const CollidingObjects& colliding;
  const NearbyObjects& nearby;

  bool accept(int a, int b) const {
    if (first.groups[a] >= 0 && first.groups[a] == second.groups[b]) return false;
    return !share_vertex(first.vertices[a], second.vertices[b]) &&
           colliding.allows(first.objects[a], second.objects[b]);
  }
  static bool skips(int /*rigid_group*/) { return true; }
  bool isolated(int rigid_group, const Aabb& box) const { return !nearby.near(rigid_group, box); }
  std::array<int, 2> pair(int a, int b) const { return {first.ids[a], second.ids[b]}; }
};
template <std::size_t M, std::size_t N>
MayTouch(const Primitives<M>&, const Primitives<N>&, const CollidingObjects&, const NearbyObjects&) -> MayTouch<M, N>;

// Returns 0 .. n-1, stably sorted by the object of the triangle: the order of point-triangle candidates.
std::vector<int> triangles_by_object(const CollisionMesh& mesh) {
  std::vector<int> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0);
  const auto object = [&](int t) { return mesh.vertex_object[mesh.triangles[t][0]]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return object(a) < object(b); });
  return order;
}

// The pairs of one kind, with their lengths.
template <class List, class Lengths>
struct CandidateList {
  List& pairs;
  Lengths &distance_bounds, &reference_distances;
};
template <class List, class Lengths>
CandidateList(List&, Lengths&, Lengths&) -> CandidateList<List, Lengths>;
template <class Kind, class C>
auto list_of(C& candidates) {
  return CandidateList{candidates.*Kind::list, candidates.distance_bounds.*Kind::lengths, candidates.reference_distances.*Kind::lengths};
}

// Merges the new pairs and the old pairs for which `kept` holds into `out`, in the order of `key`. new_at: the indices of new pairs
// in `out`; their lengths are not set. Old pairs are taken in chunks, each with the new pairs from its first pair on.
template <class Kept, class Key, class Old, class Out>
void merge_kept(const Old& old, const Kept& kept, const std::vector<std::array<int, 2>>& new_candidates, const Key& key, const Out& out, std::vector<int>& new_at) {
  constexpr int chunk = 1024;
  const int n = static_cast<int>(old.pairs.size()), chunks = std::max(chunk_count(n, chunk), 1);
  std::vector<size_t> new_begin(chunks + 1, 0), begin(chunks + 1, 0);
  new_begin.back() = new_candidates.size();
  for_each(chunks, [&](int c) {
    const int first = c * chunk, last = std::min(n, first + chunk);
    if (c > 0)
      new_begin[c] = std::lower_bound(new_candidates.begin(), new_candidates.end(), key(old.pairs[first]), [&](const auto& pair, const auto& k) { return key(pair) < k; }) - new_candidates.begin();
    begin[c + 1] = std::count_if(old.pairs.begin() + first, old.pairs.begin() + last, kept);
  }, 1);
  for (int c = 0; c < chunks; ++c) begin[c + 1] += new_begin[c + 1] - new_begin[c];
  prefix_sums(begin);
  out.pairs.resize(begin.back());
  out.distance_bounds.resize(begin.back());
  out.reference_distances.resize(begin.back());
  new_at.resize(new_candidates.size());
  for_each(chunks, [&](int c) {
    size_t to = begin[c], next = new_begin[c];
    const auto put_new = [&] {
      new_at[next] = static_cast<int>(to);
      out.pairs[to++] = new_candidates[next++];
    };
    for (int i = c * chunk; i < std::min(n, c * chunk + chunk); ++i) {
      if (!kept(old.pairs[i])) continue;
      if (next < new_begin[c + 1])
        for (const auto before = key(old.pairs[i]); next < new_begin[c + 1] && key(new_candidates[next]) < before;) put_new();
      out.pairs[to] = old.pairs[i];
      out.distance_bounds[to] = old.distance_bounds[i];
      out.reference_distances[to++] = old.reference_distances[i];
    }
    while (next < new_begin[c + 1]) put_new();
  }, 1);
}

}  // namespace

CandidateFinder::CandidateFinder(const CollisionMesh& mesh, CollidingObjects colliding)
    : mesh_(mesh), colliding_(std::move(colliding)), nearby_(mesh) {
  for (const int v : mesh.vertices) points_.add({v}, v, mesh);
  for (const int v : mesh.codim_points) codim_points_.add({v}, v, mesh);
  for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e) edges_.add(mesh.edges[e], e, mesh);
  for (const int e : mesh.codim_edges) codim_edges_.add(mesh.edges[e], e, mesh);
  for (const int t : triangles_by_object(mesh)) triangles_.add(mesh.triangles[t], t, mesh);
}

template <SearchedPrimitives searched>
const auto& CandidateFinder::primitives() const {
  if constexpr (searched == SearchedPrimitives::vertices) return points_;
  else if constexpr (searched == SearchedPrimitives::edges) return edges_;
  else if constexpr (searched == SearchedPrimitives::triangles) return triangles_;
  else if constexpr (searched == SearchedPrimitives::rods) return codim_edges_;
  else return codim_points_;
}

void CandidateFinder::find(const std::vector<Aabb>& vertex_boxes, const InflationRadii& radii, Candidates& candidates) {
  search(vertex_boxes, radii, {}, candidates);
}

void CandidateFinder::find_changed(const std::vector<Aabb>& vertex_boxes, const InflationRadii& radii, const std::vector<char>& changed,
                                   Candidates& candidates) {
  search(vertex_boxes, radii, changed, changed_pairs_);
  changed_.mark(mesh_, changed);
  for_each_kind([&](auto kind) {
    using Kind = decltype(kind);
    const std::vector<char>&first = Kind::First::of(changed_), &second = Kind::Second::of(changed_);
    const auto kept = [&](const std::array<int, 2>& pair) { return !(first[pair[0]] | second[pair[1]]); };
    const auto key = [&](const std::array<int, 2>& pair) { return Kind::order_key(mesh_, pair); };
    merge_kept(list_of<Kind>(std::as_const(candidates)), kept, changed_pairs_.*Kind::list, key, list_of<Kind>(merged_), new_candidates_.*Kind::indices);
  });
  merged_.reference = std::move(candidates.reference);
  merged_.groups = std::move(candidates.groups);
  std::swap(candidates, merged_);
}

void CandidateFinder::search(const std::vector<Aabb>& vertex_boxes, const InflationRadii& radii, const std::vector<char>& active_objects,
                             Candidates& candidates) {
  const auto refresh = [&](auto&... kinds) { (kinds.refresh_tree(vertex_boxes, radii.surface, active_objects), ...); };
  refresh(points_, codim_points_, codim_edges_, triangles_);
  edges_.refresh_tree(vertex_boxes, radii.edge, active_objects);
  std::vector<double> largest_radii = radii.surface;
  for (size_t i = 0; i < largest_radii.size(); ++i) largest_radii[i] = std::max(largest_radii[i], radii.edge[i]);
  nearby_.find(vertex_boxes, largest_radii);
  for_each_kind([&](auto kind) {
    using Kind = decltype(kind);
    const auto& first = primitives<Kind::first_searched>();
    const auto& second = primitives<Kind::second_searched>();
    const MayTouch may_touch{first, second, colliding_, nearby_};
    if constexpr (Kind::first_searched == Kind::second_searched) overlap_pairs(first.tree, may_touch, candidates.*Kind::list);
    else overlap_pairs(first.tree, second.tree, may_touch, candidates.*Kind::list);
  });
}

void CandidateFinder::triangles_in(const Aabb& box, int without, int without_group, std::vector<int>& out) const {
  if (triangles_.tree.size() == 0) return;
  const size_t before = out.size();
  detail::visit_groups(triangles_.tree, box, false, without_group, [&](int group) {
    for (unsigned lanes = triangles_.tree.boxes(0, group).overlap_mask(box); lanes != 0; lanes &= lanes - 1) {
      const int i = triangles_.tree.primitives(group)[std::countr_zero(lanes)];
      if (triangles_.objects[i] != without && (without_group < 0 || triangles_.groups[i] != without_group)) out.push_back(triangles_.ids[i]);
    }
  });
  std::sort(out.begin() + static_cast<std::ptrdiff_t>(before), out.end());
}

}  // namespace tack
