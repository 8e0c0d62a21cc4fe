// Deferred subdivision (surface_overlap.hpp): finds deferred triangles that may have come within
// range, and subdivides them.
#include <algorithm>
#include <limits>

#include "framework/contact/area_integral/surface_overlap.hpp"
#include "framework/contact/area_integral/triangle_subdivision.hpp"
#include "geometry/parallel.hpp"

namespace tack {

// nearby: the triangles that `some` refers to.
void SurfaceOverlap::add_deferred(int a, int b, std::span<const DeferredCell> some, const std::vector<int>& nearby) {
  if (some.empty()) return;
  const int first = static_cast<int>(deferred_.size());
  DeferredPair& pair = deferred_pairs_.emplace_back(DeferredPair{a, b, first, 0, std::numeric_limits<double>::infinity()});
  const int low = some.front().begin, high = some.back().end, shift = static_cast<int>(nearby_triangles_.size()) - low;
  nearby_triangles_.insert(nearby_triangles_.end(), nearby.begin() + low, nearby.begin() + high);
  for (DeferredCell w : some) {
    w.begin += shift;
    w.end += shift;
    deferred_.push_back(w);
    pair.excess = std::min(pair.excess, w.excess);
  }
  pair.end = static_cast<int>(deferred_.size());
}

// Displacements since the start of the step. Points of two triangles approach by no more than the
// largest difference of the displacements of their corners, which AABBs of displacements bound.
class SurfaceOverlap::Displacements {
 public:
  Displacements(const VecX& x, const VecX& start) : moved_(x - start) {}

  void include(Aabb& box, const Triangle& t) const {
    for (const int v : t) box.include(Vec3(vertex(moved_, v)));
  }
  static double approach_max(const Aabb& a, const Aabb& b) { return (a.hi - b.lo).cwiseMax(b.hi - a.lo).norm(); }

 private:
  VecX moved_;
};

std::vector<int> SurfaceOverlap::subdivide_approached(const VecX& x) {
  if (deferred_.empty()) return {};
  const CollisionMesh& mesh = surface_.mesh;
  const Displacements displacements(x, lagged_.x());
  std::vector<Aabb> objects(pairs_.objects());
  for_each(pairs_.objects(), [&](int a) {
    for (int t = first_triangle_[a]; t < first_triangle_[a + 1]; ++t) displacements.include(objects[a], mesh.triangles[t]);
  }, 1);
  std::vector<int> pairs;
  for (size_t i = 0; i < deferred_pairs_.size(); ++i)
    if (const DeferredPair& pair = deferred_pairs_[i]; Displacements::approach_max(objects[pair.a], objects[pair.b]) >= pair.excess)
      pairs.push_back(static_cast<int>(i));
  std::vector<int> chosen;
  std::vector<char> approached(deferred_.size(), 0);
  for_each(static_cast<int>(pairs.size()), [&](int i) {
    const DeferredPair& pair = deferred_pairs_[pairs[i]];
    const double range = pairs_.point(pair.a, pair.b).range_max();
    for (int k = pair.begin; k < pair.end; ++k) {
      DeferredCell& w = deferred_[k];
      if (w.begin == w.end) continue;
      Aabb own, other;
      displacements.include(own, mesh.triangles[w.triangle]);
      const double farthest = Displacements::approach_max(own, objects[pair.b]);
      if (farthest < w.excess) continue;
      for (int j = w.begin; j < w.end; ++j) displacements.include(other, mesh.triangles[nearby_triangles_[j]]);
      approached[k] = farthest >= range || Displacements::approach_max(own, other) >= w.excess;
    }
  }, 1);
  for (const int i : pairs)
    for (int k = deferred_pairs_[i].begin; k < deferred_pairs_[i].end; ++k)
      if (approached[k]) chosen.push_back(k);
  return chosen.empty() ? std::vector<int>() : subdivide(chosen);
}

// indices_of_cells: of deferred cells, ascending. Their facets are out of range at the start of the
// step and exert no overlap-boundary force.
std::vector<int> SurfaceOverlap::subdivide(const std::vector<int>& indices_of_cells) {
  constexpr int few = 16;
  const int n = static_cast<int>(indices_of_cells.size());
  const auto own = [&](int triangle) { return surface_.mesh.vertex_object[surface_.mesh.triangles[triangle][0]]; };
  struct Subdivided {
    std::vector<InteriorPoint> interior_points;
    OverlapFacets facets{};
  };
  std::vector<Subdivided> found(chunk_count(n, few));
  for_each_chunk(n, [&](int c, int first, int last) {
    TriangleSubdivision subdivision(surface_.mesh, lagged_);
    for (int i = first; i < last; ++i) {
      DeferredCell& w = deferred_[indices_of_cells[i]];
      const std::vector<FacedRegion> regions = faced_regions(w.triangle, w.object, std::span(nearby_triangles_).subspan(w.begin, w.end - w.begin));
      w.end = w.begin;  // no longer deferred
      const TriangleSubdivision::Request request{w.triangle, w.object, pairs_.point(own(w.triangle), w.object).range_max(), w.depth};
      for (const FacedRegion& faced : regions)
        if (w.cell == TriangleSubdivision::all) {
          std::vector<TriangleSubdivision::SkippedCell> none;
          subdivision.subdivide(request, faced.triangles, faced.region_or_null(), {}, found[c].interior_points, found[c].facets, none);
        } else if (faced.region_pair() == w.region_pair) subdivision.subdivide_cell(request, w.cell, faced.triangles, faced.region_or_null(), found[c].interior_points, found[c].facets);
    }
  }, few);
  std::vector<InteriorPoint> added;
  for (const Subdivided& chunk : found) added.insert(added.end(), chunk.interior_points.begin(), chunk.interior_points.end());
  return insert(added);
}

// Inserts interior points into the sorted list, and returns their indices. Cells of one triangle may
// be added at different times.
std::vector<int> SurfaceOverlap::insert(std::vector<InteriorPoint>& added) {
  const auto key = [&](const InteriorPoint& s) {
    return std::array{surface_.mesh.vertex_object[surface_.mesh.triangles[s.triangle][0]], s.object, s.triangle, s.cell, s.region_pair};
  };
  const auto before = [&](const InteriorPoint& a, const InteriorPoint& b) { return key(a) < key(b); };
  std::sort(added.begin(), added.end(), before);
  std::vector<InteriorPoint> all;
  all.reserve(interior_points_.size() + added.size());
  std::vector<int> indices;
  indices.reserve(added.size());
  auto known = interior_points_.begin();
  for (const InteriorPoint& s : added) {
    while (known != interior_points_.end() && before(*known, s)) all.push_back(*known++);
    indices.push_back(static_cast<int>(all.size()));
    all.push_back(s);
  }
  all.insert(all.end(), known, interior_points_.end());
  interior_points_ = std::move(all);
  return indices;
}

}  // namespace tack
