#include "framework/contact/area_integral/surface_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "framework/contact/area_integral/triangle_subdivision.hpp"
#include "geometry/distance/triangle_triangle.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Largest overshoot of a corner, relative to the square root of the area of its triangle, where the
// surface of the corner ends too: plates of one size that contract slightly differently would otherwise
// be subdivided all along their boundaries, without effect on the overlap. Where surfaces adhere,
// overhangs of this size have hardly any force (overhang.hpp), so that it is larger: docs/log/contact.md.
constexpr double shared_boundary_overshoot_max = 1e-3, shared_boundary_overhang_max = 4e-3;
// Triangles larger than twice the range give their area to their corners if the gap between corners
// changes by no more than this fraction of the range, and the opposite triangles are parallel.
constexpr double gap_change_per_range_max = 0.25, parallel_cosine_min = 0.999;
constexpr double distance_tolerance_relative = 1e-9;  // of distances: far above rounding

}  // namespace

// Results of a chunk of triangles: areas of their corners, interior points and deferred cells.
struct SurfaceOverlap::Result {
  struct CornerArea {
    Corner corner;
    double area;  // m^2
  };
  std::vector<CornerArea> corner_areas;
  std::vector<InteriorPoint> interior_points;
  OverlapFacets facets{};
  std::vector<int> known;  // triangles
  std::vector<DeferredCell> deferred;
  std::vector<int> nearby;  // triangles near the deferred cells

  // Defers all cells or some cells of a triangle.
  void defer(int triangle, int object, int depth, const std::vector<int>& near, const std::vector<TriangleSubdivision::SkippedCell>& skipped, int region_pair = -1) {
    const int begin = static_cast<int>(nearby.size());
    nearby.insert(nearby.end(), near.begin(), near.end());
    for (const auto& [cell, excess] : skipped) deferred.push_back({triangle, object, depth, cell, begin, static_cast<int>(nearby.size()), excess, region_pair});
  }
};

// An object opposite some triangles, with the results of its chunks.
struct SurfaceOverlap::OppositeObject {
  int object;
  Aabb reachable;  // its box, inflated by twice the range
  Result* found;   // by chunk
};

// Triangles of one object.
struct SurfaceOverlap::TriangleChunk {
  std::vector<OppositeObject> opposite;
  int index, first, last;
};

SurfaceOverlap::SurfaceOverlap(const ContactSurface& surface, const PairTable& pairs, const IntegrationRules& rules, const LaggedSurface& lagged)
    : surface_(surface), pairs_(pairs), rules_(rules), lagged_(lagged), first_triangle_(pairs.objects() + 1, 0), needed_(rules.any(&IntegrationRule::overlap_only)) {
  for (const Triangle& t : surface.mesh.triangles) ++first_triangle_[surface.mesh.vertex_object[t[0]] + 1];
  for (int a = 0; a < pairs.objects(); ++a) first_triangle_[a + 1] += first_triangle_[a];
}

std::array<SurfaceOverlap::Corner, 3> SurfaceOverlap::corners(const PatchesByVertex& groups, int triangle, int object) const {
  std::array<Corner, 3> found;
  for (int i = 0; i < 3; ++i) {
    const int v = surface_.mesh.triangles[triangle][i];
    found[i] = {groups.find(v, object), -1};
    if (found[i].group < 0) continue;
    const VisiblePatches& visible = groups[found[i].group].visible;
    double most = facing_cosine_min;
    for (int k = 0; k < visible.count; ++k) {
      const double cosine = lagged_.cosine(triangle, visible.patches[k].normal);
      if (cosine > most) most = cosine, found[i].patch = k;
    }
  }
  return found;
}

bool SurfaceOverlap::overlaps_fully(const PatchesByVertex& groups, int triangle, const std::array<Corner, 3>& corners) const {
  const double on_line = TriangleSubdivision::line_tolerance(lagged_.area(triangle));
  const auto shared_of = [&](int object) {
    const bool overhangs = rules_.of(surface_.mesh.vertex_object[surface_.mesh.triangles[triangle][0]], object).overhangs;
    return (overhangs ? shared_boundary_overhang_max : shared_boundary_overshoot_max) * std::sqrt(lagged_.area(triangle));
  };
  return std::all_of(corners.begin(), corners.end(), [&](const Corner& c) {
    if (c.group < 0 || c.patch < 0) return false;
    const double overshoot = groups[c.group].visible.patches[c.patch].overshoot;
    if (overshoot <= on_line) return true;
    const double shared = shared_of(groups[c.group].object);
    return overshoot <= shared && ends_there(groups, c, shared);
  });
}

// Returns whether the own surface ends at a corner as well: no triangle there that faces the patch of
// the corner overshoots the boundary by more than overshoot_max [m].
bool SurfaceOverlap::ends_there(const PatchesByVertex& groups, const Corner& corner, double overshoot_max) const {
  const GroupPatches& at = groups[corner.group];
  const SurfaceTopology& topology = lagged_.topology();
  if (topology.smooth_vertex(at.point)) return false;
  const Vec3& normal = at.visible.patches[corner.patch].normal;
  for (const int t : topology.triangles_at(at.point)) {
    if (!(lagged_.cosine(t, normal) > facing_cosine_min)) continue;
    for (const int v : surface_.mesh.triangles[t]) {
      const int group = groups.find(v, at.object);
      const int patch = group < 0 ? -1 : groups[group].visible.patch_of(normal);
      if (patch < 0 || groups[group].visible.patches[patch].overshoot > overshoot_max) return false;
    }
  }
  return true;
}

// Returns whether one law holds between a fully overlapping triangle and the opposite surface, and
// for its corners, which receive its area.
bool SurfaceOverlap::has_one_law(const PatchesByVertex& groups, int triangle, int object, const std::array<Corner, 3>& at) const {
  const CollisionMesh& mesh = surface_.mesh;
  const Triangle& own = mesh.triangles[triangle];
  const int of = mesh.vertex_object[own[0]];
  if (!pairs_.has_regions(of, object)) return true;
  const auto opposite = [&](int i) -> const Triangle& { return mesh.triangles[groups[at[i].group].visible.patches[at[i].patch].seed_triangle]; };
  const int region_pair = pairs_.region_pair(of, object, own, opposite(0));
  for (int i = 0; i < 3; ++i)
    if (pairs_.region_pair(of, object, own, opposite(i)) != region_pair || pairs_.region_pair(of, object, std::array{own[i]}, opposite(i)) != region_pair) return false;
  return true;
}

// Returns whether a triangle may face another one, by their orientations alone.
bool SurfaceOverlap::may_face(int triangle, int other) const {
  return lagged_.cosine(triangle, lagged_.normal(other)) > facing_cosine_min ||
         lagged_.cosine(other, lagged_.normal(triangle)) > facing_cosine_min;
}

void SurfaceOverlap::choose_sides(const std::vector<GroupPatches>& all, IntegrationSides& sides) const {
  const PatchesByVertex groups(all, surface_.mesh.vertex_object.size());
  sides.clear();
  const CollisionMesh& mesh = surface_.mesh;
  const int triangles = rules_.any(&IntegrationRule::by_overlap) ? static_cast<int>(mesh.triangles.size()) : 0;
  for (int t = 0; t < triangles; ++t) {
    const int object = mesh.vertex_object[mesh.triangles[t][0]];
    for (const GroupPatches& group : groups.of_vertex(mesh.triangles[t][0])) {
      const PairRole& role = pairs_.point(object, group.object);
      if (!rules_.of(object, group.object).by_overlap) continue;
      const auto at = corners(groups, t, group.object);
      if (!overlaps_fully(groups, t, at)) continue;
      const VisiblePatch& patch = group.visible.patches[at[0].patch];
      if (patch.distance >= role.range_max()) continue;
      IntegrationSides::Overlap& overlap = sides.overlap(object, group.object);
      overlap.area += lagged_.area(t) * lagged_.cosine(t, patch.normal);
      ++overlap.triangles;
    }
  }
  sides.choose();
}

// Adds the area of a triangle that overlaps at its corners.
void SurfaceOverlap::add_full_triangle(int triangle, double range_twice, bool bonds, const std::array<Corner, 3>& at,
                                       const PatchesByVertex& groups, Result& found) const {
  double area_of_all = 0;
  bool close_by = false;
  for (const Corner& corner : at) {
    const VisiblePatch& patch = groups[corner.group].visible.patches[corner.patch];
    const double area = lagged_.area(triangle) / 3 * lagged_.cosine(triangle, patch.normal);
    area_of_all += area;
    close_by = close_by || patch.distance < range_twice;
    found.corner_areas.push_back({corner, area});
    if (patch.distance < range_twice) found.facets.facets.push_back({triangle, patch.seed_triangle, area, patch.distance});
  }
  if (bonds && close_by) found.facets.full_triangles.push_back({triangle, area_of_all});
}

// Returns whether the gap over a triangle that overlaps at its corners is uniform.
bool SurfaceOverlap::has_uniform_gap(int triangle, const std::array<Corner, 3>& at, const PatchesByVertex& groups, double range) const {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  bool level = true;
  for (const Corner& corner : at) {
    const VisiblePatch& patch = groups[corner.group].visible.patches[corner.patch];
    low = std::min(low, patch.distance);
    high = std::max(high, patch.distance);
    level = level && lagged_.cosine(triangle, patch.normal) > parallel_cosine_min;
  }
  return level && high - low <= gap_change_per_range_max * range;
}

// Returns the lists of the triangles that were subdivided or deferred.
NearbyLists SurfaceOverlap::evaluate_chunk(const TriangleChunk& chunk, const BroadPhase& broad_phase, const PatchesByVertex& groups) const {
  const CollisionMesh& mesh = surface_.mesh;
  TriangleSubdivision subdivision(mesh, lagged_);
  std::vector<int> near;
  NearbyLists lists;
  for (int t = chunk.first; t < chunk.last; ++t) {
    Aabb own;
    for (const int v : mesh.triangles[t]) own.include(Vec3(vertex(lagged_.x(), v)));
    bool listed = false, kept = false;
    for (const OppositeObject& other : chunk.opposite) {
      if (!own.overlaps(other.reachable)) continue;
      const PairRole& role = pairs_.point(mesh.vertex_object[mesh.triangles[t][0]], other.object);
      const double range_twice = 2 * role.range_max();
      Result& found = other.found[chunk.index];
      const auto at = corners(groups, t, other.object);
      const bool full = overlaps_fully(groups, t, at) && has_one_law(groups, t, other.object, at), small = 2 * lagged_.area(t) <= range_twice * range_twice;
      if (full && (small || role.bonds || has_uniform_gap(t, at, groups, role.range_max()))) {
        add_full_triangle(t, range_twice, role.bonds, at, groups, found);
        found.known.push_back(t);
        continue;
      }
      if (!listed) {
        near.clear();
        broad_phase.others_near(mesh.triangles[t], near);
        listed = true;
      }
      const NearbyTriangles nearby = find_nearby(t, other.object, near);
      if (!nearby.faced) continue;
      if (!kept) lists.add(t, near), kept = true;
      subdivide_or_defer(t, other.object, nearby, subdivision, found);
      found.known.push_back(t);
    }
  }
  return lists;
}

void SurfaceOverlap::others_near(int triangle, const BroadPhase& broad_phase, std::vector<int>& out) const {
  std::span<const int> near;
  if (builds_of_lists_ == broad_phase.builds() && nearby_lists_.find(triangle, near)) out.insert(out.end(), near.begin(), near.end());
  else broad_phase.others_near(surface_.mesh.triangles[triangle], out);
}

std::vector<int> SurfaceOverlap::facing(int triangle, std::span<const int> others) const {
  std::vector<int> found;
  std::copy_if(others.begin(), others.end(), std::back_inserter(found), [&](int other) { return may_face(triangle, other); });
  return found;
}

// others: triangles of the object.
std::vector<SurfaceOverlap::FacedRegion> SurfaceOverlap::faced_regions(int triangle, int object, std::span<const int> others) const {
  const CollisionMesh& mesh = surface_.mesh;
  const std::vector<int> faced = facing(triangle, others);
  const int own = mesh.vertex_object[mesh.triangles[triangle][0]];
  std::vector<FacedRegion> found;
  if (!pairs_.has_regions(own, object)) found.push_back({std::nullopt, faced});
  else
    for (int region_pair = -1; region_pair < pairs_.region_pair_count(own, object); ++region_pair) {
      const SurfaceRegion region(pairs_, mesh, triangle, object, region_pair);
      std::vector<int> of_region;
      std::copy_if(faced.begin(), faced.end(), std::back_inserter(of_region), [&](int t) { return region.contains(t); });
      if (!of_region.empty()) found.push_back({region, std::move(of_region)});
    }
  return found;
}

// near: triangles of any object, ascending.
SurfaceOverlap::NearbyTriangles SurfaceOverlap::find_nearby(int triangle, int object, const std::vector<int>& near) const {
  const CollisionMesh& mesh = surface_.mesh;
  const double range = pairs_.point(mesh.vertex_object[mesh.triangles[triangle][0]], object).range_max();
  NearbyTriangles nearby{{}, 2 * range, true, false};
  const auto first = std::lower_bound(near.begin(), near.end(), first_triangle_[object]);
  const auto last = std::lower_bound(first, near.end(), first_triangle_[object + 1]);
  if (std::none_of(first, last, [&](int t) { return may_face(triangle, t); })) return nearby;
  const std::array<Vec3, 3> own = tack::corners(lagged_.x(), mesh.triangles[triangle]);
  for (auto i = first; i != last; ++i) {
    const double apart = (1 - distance_tolerance_relative) * triangles_apart(own, tack::corners(lagged_.x(), mesh.triangles[*i]), range);
    if (apart >= 2 * range) continue;
    nearby.nearest = std::min(nearby.nearest, apart);
    nearby.triangles.push_back(*i);
    if (!may_face(triangle, *i)) continue;
    nearby.faced = true;
    const double cosine = lagged_.cosine(triangle, lagged_.normal(*i));
    nearby.parallel = nearby.parallel && (lagged_.topology().two_sided(*i) ? std::abs(cosine) : cosine) > parallel_cosine_min;
  }
  return nearby;
}

void SurfaceOverlap::subdivide_or_defer(int triangle, int object, const NearbyTriangles& nearby, TriangleSubdivision& subdivision, Result& found) const {
  const PairRole& role = pairs_.point(surface_.mesh.vertex_object[surface_.mesh.triangles[triangle][0]], object);
  // Cells are no larger than twice the range, so that the gap is about constant in each; where the
  // gap varies, no larger than the range.
  const int depth = TriangleSubdivision::depth_of(lagged_.area(triangle), nearby.parallel ? 2 * role.range_max() : role.range_max());
  if (nearby.nearest > role.range_max() && !role.bonds)
    return found.defer(triangle, object, depth, nearby.triangles, {{TriangleSubdivision::all, nearby.nearest - role.range_max()}});
  for (const FacedRegion& faced : faced_regions(triangle, object, nearby.triangles)) {
    std::vector<TriangleSubdivision::SkippedCell> skipped;
    subdivision.subdivide({triangle, object, role.range_max(), depth}, faced.triangles, faced.region_or_null(), role.bonds ? std::span<const int>() : nearby.triangles, found.interior_points, found.facets, skipped);
    if (!skipped.empty()) found.defer(triangle, object, depth, nearby.triangles, skipped, faced.region_pair());
  }
}

bool SurfaceOverlap::uses_overlap(int a, int b, const IntegrationSides& sides) const {
  return rules_.of(a, b).overlap_only && sides.integrates(a, b);
}

double SurfaceOverlap::unknown_area(int vertex_index, int object, const Vec3& normal) const {
  const std::array key{surface_.mesh.vertex_object[vertex_index], object};
  const auto at = std::lower_bound(known_.begin(), known_.end(), key, [](const KnownPair& k, const std::array<int, 2>& of) { return std::array{k.a, k.b} < of; });
  const bool any = at != known_.end() && std::array{at->a, at->b} == key;
  double area = 0;
  for (const int t : lagged_.topology().triangles_at(vertex_index))
    if (!any || !std::binary_search(at->triangles.begin(), at->triangles.end(), t)) area += lagged_.area(t) / 3 * std::max(0.0, lagged_.cosine(t, normal));
  return area;
}

std::vector<Aabb> SurfaceOverlap::object_boxes() const {
  std::vector<Aabb> boxes(pairs_.objects());
  for_each(pairs_.objects(), [&](int a) {
    for (int t = first_triangle_[a]; t < first_triangle_[a + 1]; ++t)
      for (const int v : surface_.mesh.triangles[t]) boxes[a].include(Vec3(vertex(lagged_.x(), v)));
  });
  return boxes;
}

std::vector<std::array<int, 2>> SurfaceOverlap::near_objects(const IntegrationSides& sides, const std::vector<Aabb>& boxes) const {
  const int n = pairs_.objects();
  // Sweep along x: each box is tested against the boxes that begin before its end.
  double widest = 0;
  for (const PairLaw& law : pairs_.laws()) widest = std::max(widest, 2 * law.range());
  std::vector<int> order;
  for (int a = 0; a < n; ++a)
    if (first_triangle_[a] < first_triangle_[a + 1]) order.push_back(a);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return std::pair(boxes[a].lo[0], a) < std::pair(boxes[b].lo[0], b); });
  std::vector<std::array<int, 2>> found;
  const auto take = [&](int a, int b) {
    Aabb reachable = boxes[b];
    reachable.inflate(2 * pairs_.point(a, b).range_max());
    if (uses_overlap(a, b, sides) && boxes[a].overlaps(reachable)) found.push_back({a, b});
  };
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t j = i + 1; j < order.size() && boxes[order[j]].lo[0] <= boxes[order[i]].hi[0] + widest; ++j) {
      take(order[i], order[j]);
      take(order[j], order[i]);
    }
  std::sort(found.begin(), found.end());
  return found;
}

void SurfaceOverlap::evaluate(const IntegrationSides& sides, const BroadPhase& broad_phase, std::vector<GroupPatches>& groups) {
  interior_points_.clear();
  facets_.clear();
  known_.clear();
  deferred_pairs_.clear();
  deferred_.clear();
  nearby_triangles_.clear();
  nearby_lists_.clear();
  const std::vector<Aabb> boxes = object_boxes();
  const std::vector<std::array<int, 2>> near = near_objects(sides, boxes);
  std::vector<std::vector<Result>> all(near.size());
  // Chunks of one object contain all of its pairs: nearby triangles are searched once per triangle.
  std::vector<TriangleChunk> chunks;
  for (size_t first = 0, last = 0; first < near.size(); first = last) {
    const int a = near[first][0], begin = first_triangle_[a], n = first_triangle_[a + 1] - begin;
    std::vector<OppositeObject> opposite;
    for (; last < near.size() && near[last][0] == a; ++last) {
      const int b = near[last][1];
      all[last].resize(chunk_count(n));
      opposite.push_back({b, boxes[b], all[last].data()});
      opposite.back().reachable.inflate(2 * pairs_.point(a, b).range_max());
    }
    for (int c = 0; c < chunk_count(n); ++c)
      chunks.push_back({opposite, c, begin + c * chunk_size, begin + std::min(n, (c + 1) * chunk_size)});
  }
  const PatchesByVertex by_vertex(groups, surface_.mesh.vertex_object.size());
  std::vector<NearbyLists> lists(chunks.size());
  for_each(static_cast<int>(chunks.size()), [&](int i) { lists[i] = evaluate_chunk(chunks[i], broad_phase, by_vertex); }, 1);
  for (const NearbyLists& of_chunk : lists) nearby_lists_.append(of_chunk);
  builds_of_lists_ = broad_phase.builds();
  for (size_t pair = 0; pair < near.size(); ++pair) {
    OverlapFacets& facets = facets_.emplace_back(OverlapFacets{near[pair][0], near[pair][1], {}, {}, {}});
    KnownPair& known = known_.emplace_back(KnownPair{near[pair][0], near[pair][1], {}});
    for (const Result& found : all[pair]) {
      known.triangles.insert(known.triangles.end(), found.known.begin(), found.known.end());
      facets.facets.insert(facets.facets.end(), found.facets.facets.begin(), found.facets.facets.end());
      facets.boundary_edges.insert(facets.boundary_edges.end(), found.facets.boundary_edges.begin(), found.facets.boundary_edges.end());
      facets.full_triangles.insert(facets.full_triangles.end(), found.facets.full_triangles.begin(), found.facets.full_triangles.end());
    }
    for (const Result& found : all[pair]) add_deferred(near[pair][0], near[pair][1], found.deferred, found.nearby);
  }
  for (GroupPatches& group : groups)
    if (uses_overlap(surface_.mesh.vertex_object[group.point], group.object, sides))
      for (VisiblePatch& patch : group.visible.patches) patch.area = 0;
  for (const std::vector<Result>& pair : all)
    for (const Result& found : pair) {
      for (const auto& [corner, area] : found.corner_areas) groups[corner.group].visible.patches[corner.patch].area += area;
      interior_points_.insert(interior_points_.end(), found.interior_points.begin(), found.interior_points.end());
    }
}

}  // namespace tack
