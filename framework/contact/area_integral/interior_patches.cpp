#include "framework/contact/area_integral/interior_patches.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/concatenate.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int chunk = 64;

// Finder for consecutive interior points; points of one triangle share a search.
class InteriorPatchFinder {
 public:
  InteriorPatchFinder(const SurfaceOverlap& overlap, const CollisionMesh& mesh, const LaggedSurface& lagged, const BroadPhase& broad_phase)
      : overlap_(overlap), mesh_(mesh), lagged_(lagged), broad_phase_(broad_phase), finder_(mesh, lagged) {}

  // Appends the triangles of the patch, and returns their number.
  int find(const InteriorPoint& s, std::vector<int>& out) {
    const Triangle& own = mesh_.triangles[s.triangle];
    if (s.triangle != triangle_ || s.object != object_) search(s.triangle, s.object);
    const size_t before = out.size();
    broad_phase_.triangles_near(own, s.inside, near_, out);
    const QueryPoint from = finder_.inside_triangle(s.triangle, point_inside(lagged_.x(), own, s.inside), s.area);
    VisiblePatches patch;
    patch.count = 1;
    patch.patches[0] = {s.normal, s.area, 0, 0, 0, -1};
    const auto begin = out.begin() + static_cast<std::ptrdiff_t>(before);
    out.erase(std::remove_if(begin, out.end(), [&](int t) { return finder_.patch_of(from, patch, t) < 0; }), out.end());
    return static_cast<int>(out.size() - before);
  }

 private:
  void search(int triangle, int object) {
    triangle_ = triangle;
    object_ = object;
    near_.clear();
    overlap_.others_near(triangle, broad_phase_, near_);
    std::erase_if(near_, [&](int t) { return mesh_.vertex_object[mesh_.triangles[t][0]] != object; });
  }

  const SurfaceOverlap& overlap_;
  const CollisionMesh& mesh_;
  const LaggedSurface& lagged_;
  const BroadPhase& broad_phase_;
  PatchFinder finder_;
  int triangle_ = -1, object_ = -1;  // of near_
  std::vector<int> near_;
};

// Patches of some points: one list of triangles per chunk, and the number of triangles per point.
struct FoundPatches {
  std::vector<std::vector<int>> triangles;
  std::vector<int> count;
};

FoundPatches find_patches(const std::vector<int>& indices, const SurfaceOverlap& overlap, const CollisionMesh& mesh,
                          const LaggedSurface& lagged, const BroadPhase& broad_phase) {
  const int n = static_cast<int>(indices.size());
  FoundPatches found{std::vector<std::vector<int>>(chunk_count(n, chunk)), std::vector<int>(n)};
  for_each_chunk(n, [&](int c, int first, int last) {
    InteriorPatchFinder finder(overlap, mesh, lagged, broad_phase);
    for (int i = first; i < last; ++i) found.count[i] = finder.find(overlap.interior_points()[indices[i]], found.triangles[c]);
  }, chunk);
  return found;
}

}  // namespace

void add_interior_patches(const std::vector<int>& indices, const SurfaceOverlap& overlap, const CollisionMesh& mesh,
                          const LaggedSurface& lagged, const BroadPhase& broad_phase, InteriorPatches& patches) {
  const int n = static_cast<int>(indices.size());
  const FoundPatches found = find_patches(indices, overlap, mesh, lagged, broad_phase);
  std::vector<InteriorPatches::Range> all;
  all.reserve(overlap.interior_points().size());
  auto known = patches.ranges.begin();
  int end = static_cast<int>(patches.triangles.size());
  for (int i = 0; i < n; ++i) {
    const auto before = indices[i] - static_cast<std::ptrdiff_t>(all.size());
    all.insert(all.end(), known, known + before);
    known += before;
    all.push_back({end, end + found.count[i]});
    end += found.count[i];
  }
  all.insert(all.end(), known, patches.ranges.end());
  patches.ranges = std::move(all);
  patches.triangles.reserve(end);
  for (const auto& list : found.triangles) patches.triangles.insert(patches.triangles.end(), list.begin(), list.end());
}

void update_interior_patches(const ChangedPrimitives& changed, const SurfaceOverlap& overlap, const CollisionMesh& mesh,
                             const LaggedSurface& lagged, const BroadPhase& broad_phase, InteriorPatches& patches) {
  const std::vector<InteriorPoint>& points = overlap.interior_points();
  std::vector<int> indices;
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    if (changed.triangles[points[i].triangle] || changed.objects[points[i].object]) indices.push_back(i);
  const FoundPatches found = find_patches(indices, overlap, mesh, lagged, broad_phase);
  std::vector<int> changed_triangles;
  concatenate(found.triangles, changed_triangles);
  InteriorPatches all;
  all.triangles.reserve(patches.triangles.size() + changed_triangles.size());
  auto index = indices.begin();
  auto count = found.count.begin();
  auto next = changed_triangles.begin();
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const int begin = static_cast<int>(all.triangles.size());
    if (index != indices.end() && *index == i) {
      all.triangles.insert(all.triangles.end(), next, next + *count);
      next += *count++;
      ++index;
    } else {
      const auto& [first, last] = patches.ranges[i];
      all.triangles.insert(all.triangles.end(), patches.triangles.begin() + first, patches.triangles.begin() + last);
    }
    all.ranges.push_back({begin, static_cast<int>(all.triangles.size())});
  }
  patches = std::move(all);
}

InteriorPatches make_interior_patches(const SurfaceOverlap& overlap, const CollisionMesh& mesh,
                                      const LaggedSurface& lagged, const BroadPhase& broad_phase) {
  std::vector<int> all(overlap.interior_points().size());
  std::iota(all.begin(), all.end(), 0);
  InteriorPatches patches;
  add_interior_patches(all, overlap, mesh, lagged, broad_phase, patches);
  return patches;
}

}  // namespace tack
