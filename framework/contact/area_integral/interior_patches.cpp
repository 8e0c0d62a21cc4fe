#include "framework/contact/area_integral/interior_patches.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/concatenate.hpp"
#include "geometry/parallel.hpp"
#include "geometry/prefix_sums.hpp"

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
  const int n = static_cast<int>(points.size());
  std::vector<std::vector<int>> chunks(chunk_count(n));
  for_each_chunk(n, [&](int c, int first, int last) {
    for (int i = first; i < last; ++i)
      if (changed.triangles[points[i].triangle] || changed.objects[points[i].object]) chunks[c].push_back(i);
  });
  std::vector<int> indices;
  concatenate(chunks, indices);
  const FoundPatches found = find_patches(indices, overlap, mesh, lagged, broad_phase);
  std::vector<int> new_triangles;
  concatenate(found.triangles, new_triangles);

  // The patch of each point, in one of both lists of triangles.
  struct Source {
    const std::vector<int>* triangles;
    InteriorPatches::Range range;
  };
  std::vector<Source> sources(n);
  for_each(n, [&](int i) { sources[i] = {&patches.triangles, patches.ranges[i]}; });
  std::vector<int> end = found.count;
  prefix_sums(end);
  for_each(static_cast<int>(indices.size()), [&](int k) { sources[indices[k]] = {&new_triangles, {end[k] - found.count[k], end[k]}}; });

  std::vector<int> begin(n + 1, 0);
  for_each(n, [&](int i) { begin[i + 1] = sources[i].range.end - sources[i].range.begin; });
  prefix_sums(begin);
  InteriorPatches all{std::vector<InteriorPatches::Range>(n), std::vector<int>(begin.back())};
  for_each(n, [&](int i) {
    const auto& [triangles, range] = sources[i];
    all.ranges[i] = {begin[i], begin[i + 1]};
    std::copy(triangles->begin() + range.begin, triangles->begin() + range.end, all.triangles.begin() + begin[i]);
  });
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
