#include "framework/contact/surface_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "framework/contact/triangle_division.hpp"
#include "geometry/distance/triangle_triangle.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Largest distance of a corner past the overlap boundary, relative to the root of its triangle's
// area: rounding, when meshes agree. Larger where the corner's own surface ends too, and the
// boundary cannot uncover anything else: plates of one size that contract slightly differently
// would be subdivided all along their boundaries.
constexpr double on_the_rim = 1e-6, on_both_rims = 1e-3;
// Triangles larger than the reach give their area to their corners where the gap changes by no more than this part of the range from one to
// another, and what these face is parallel to them.
constexpr double even = 0.25, parallel = 0.999;
constexpr double accuracy = 1e-9;  // of distances, relative: far above rounding

// By key; -1: none.
int find_view(const std::vector<GroupView>& views, int point, int object) {
  const std::array key{point, object};
  const auto at = std::lower_bound(views.begin(), views.end(), key,
                                   [](const GroupView& v, const std::array<int, 2>& k) { return v.key() < k; });
  return at != views.end() && at->key() == key ? static_cast<int>(at - views.begin()) : -1;
}

}  // namespace

// Results of a chunk of triangles: area shares for the views of the corners, and samples.
struct SurfaceOverlap::Found {
  struct Share {
    Corner corner;
    double area;  // m^2
  };
  std::vector<Share> shares;
  std::vector<ContactSample> samples;
  OverlapFacets parts{};
  std::vector<int> known;  // triangles
  std::vector<Waiting> waiting;
  std::vector<int> around;  // what those that wait refer to

  // All or cells of a triangle.
  void wait(int triangle, int object, int depth, const std::vector<int>& near, const std::vector<TriangleDivision::Left>& left, int region_pair = -1) {
    const int begin = static_cast<int>(around.size());
    around.insert(around.end(), near.begin(), near.end());
    for (const auto& [cell, away] : left) waiting.push_back({triangle, object, depth, cell, begin, static_cast<int>(around.size()), away, region_pair});
  }
};

// An object opposite some triangles, and where to collect the results of its chunks.
struct SurfaceOverlap::Opposite {
  int object;
  Aabb reached;  // where it may be seen from
  Found* found;  // by chunk
};

// Triangles of one object.
struct SurfaceOverlap::Chunk {
  std::vector<Opposite> opposite;
  int index, first, last;
};

SurfaceOverlap::SurfaceOverlap(const ContactSurface& surface, const PairTable& pairs, const LaggedSurface& held)
    : surface_(surface), pairs_(pairs), held_(held), first_triangle_(pairs.objects() + 1, 0), wanted_(pairs.any_overlap_only()) {
  for (const Triangle& t : surface.mesh.triangles) ++first_triangle_[surface.mesh.vertex_object[t[0]] + 1];
  for (int a = 0; a < pairs.objects(); ++a) first_triangle_[a + 1] += first_triangle_[a];
}

std::array<SurfaceOverlap::Corner, 3> SurfaceOverlap::corners(const std::vector<GroupView>& views, int triangle, int object) const {
  std::array<Corner, 3> found;
  for (int i = 0; i < 3; ++i) {
    const int v = surface_.mesh.triangles[triangle][i];
    found[i] = {find_view(views, v, object), -1};
    if (found[i].view < 0) continue;
    const FacingView& view = views[found[i].view].view;
    double most = least_cosine;
    for (int k = 0; k < view.count; ++k) {
      const double cosine = held_.cosine(triangle, view.pieces[k].normal);
      if (cosine > most) most = cosine, found[i].piece = k;
    }
  }
  return found;
}

bool SurfaceOverlap::covered(const std::vector<GroupView>& views, int triangle, const std::array<Corner, 3>& corners) const {
  const double size = std::sqrt(held_.area(triangle));
  return std::all_of(corners.begin(), corners.end(), [&](const Corner& c) {
    if (c.view < 0 || c.piece < 0) return false;
    const GroupView& at = views[c.view];
    const double slack = held_.topology().smooth_vertex(at.point) ? on_the_rim : on_both_rims;
    return at.view.pieces[c.piece].beyond <= slack * size;
  });
}

// Returns whether one law holds between a whole overlapping triangle and the opposite surface, and
// for its corners, which get its area.
bool SurfaceOverlap::one_law(const std::vector<GroupView>& views, int triangle, int object, const std::array<Corner, 3>& at) const {
  const CollisionMesh& mesh = surface_.mesh;
  const Triangle& own = mesh.triangles[triangle];
  const int of = mesh.vertex_object[own[0]];
  if (!pairs_.has_regions(of, object)) return true;
  const auto opposite = [&](int i) -> const Triangle& { return mesh.triangles[views[at[i].view].view.pieces[at[i].piece].triangle]; };
  const int region_pair = pairs_.region_pair(of, object, own, opposite(0));
  for (int i = 0; i < 3; ++i)
    if (pairs_.region_pair(of, object, own, opposite(i)) != region_pair || pairs_.region_pair(of, object, std::array{own[i]}, opposite(i)) != region_pair) return false;
  return true;
}

// By their orientations alone.
bool SurfaceOverlap::may_face(int triangle, int other) const {
  return held_.cosine(triangle, held_.normal(other)) > least_cosine ||
         held_.cosine(other, held_.normal(triangle)) > least_cosine;
}

void SurfaceOverlap::capture(const std::vector<GroupView>& views, IntegrationSides& sides) const {
  sides.clear();
  const CollisionMesh& mesh = surface_.mesh;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const int object = mesh.vertex_object[mesh.triangles[t][0]];
    const int lead = mesh.triangles[t][0];
    const auto first = std::lower_bound(views.begin(), views.end(), lead,
                                        [](const GroupView& v, int point) { return v.point < point; });
    for (auto view = first; view != views.end() && view->point == lead; ++view) {
      const PairRole& role = pairs_.point(object, view->object);
      if (!role.by_overlap) continue;
      const auto at = corners(views, t, view->object);
      if (!covered(views, t, at)) continue;
      const SeenPiece& piece = view->view.pieces[at[0].piece];
      if (piece.distance >= role.range_max()) continue;
      IntegrationSides::Capture& capture = sides.capture(object, view->object);
      capture.area += held_.area(t) * held_.cosine(t, piece.normal);
      ++capture.triangles;
    }
  }
  sides.choose();
}

// Adds the area of a triangle that overlaps at its corners.
void SurfaceOverlap::take_covered(int triangle, double reach, bool bonds, const std::array<Corner, 3>& at,
                            const std::vector<GroupView>& views, Found& found) const {
  double area_of_all = 0;
  bool close_by = false;
  for (const Corner& corner : at) {
    const SeenPiece& piece = views[corner.view].view.pieces[corner.piece];
    const double area = held_.area(triangle) / 3 * held_.cosine(triangle, piece.normal);
    area_of_all += area;
    close_by = close_by || piece.distance < reach;
    found.shares.push_back({corner, area});
    if (piece.distance < reach) found.parts.parts.push_back({triangle, piece.triangle, area, piece.distance});
  }
  if (bonds && close_by) found.parts.whole.push_back({triangle, area_of_all});
}

// Returns whether the gap over a triangle that overlaps at its corners is uniform.
bool SurfaceOverlap::even_gap(int triangle, const std::array<Corner, 3>& at, const std::vector<GroupView>& views, double range) const {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  bool level = true;
  for (const Corner& corner : at) {
    const SeenPiece& piece = views[corner.view].view.pieces[corner.piece];
    low = std::min(low, piece.distance);
    high = std::max(high, piece.distance);
    level = level && held_.cosine(triangle, piece.normal) > parallel;
  }
  return level && high - low <= even * range;
}

void SurfaceOverlap::weigh_chunk(const Chunk& chunk, const BroadPhase& broad_phase, const std::vector<GroupView>& views) const {
  const CollisionMesh& mesh = surface_.mesh;
  TriangleDivision division(mesh, held_);
  std::vector<int> near;
  for (int t = chunk.first; t < chunk.last; ++t) {
    Aabb own;
    for (const int v : mesh.triangles[t]) own.include(Vec3(vertex(held_.x(), v)));
    bool listed = false;
    for (const Opposite& other : chunk.opposite) {
      if (!own.overlaps(other.reached)) continue;
      const PairRole& role = pairs_.point(mesh.vertex_object[mesh.triangles[t][0]], other.object);
      const double reach = 2 * role.range_max();
      Found& found = other.found[chunk.index];
      const auto at = corners(views, t, other.object);
      const bool whole = covered(views, t, at) && one_law(views, t, other.object, at), small = 2 * held_.area(t) <= reach * reach;
      if (whole && (small || role.bonds || even_gap(t, at, views, role.range_max()))) {
        take_covered(t, reach, role.bonds, at, views, found);
        found.known.push_back(t);
        continue;
      }
      if (!listed) {
        near.clear();
        broad_phase.others_near(mesh.triangles[t], near);
        listed = true;
      }
      const Around around = find_around(t, other.object, near);
      if (!around.faced) continue;
      divide_or_wait(t, other.object, around, division, found);
      found.known.push_back(t);
    }
  }
}

std::vector<int> SurfaceOverlap::facing(int triangle, std::span<const int> others) const {
  std::vector<int> found;
  std::copy_if(others.begin(), others.end(), std::back_inserter(found), [&](int other) { return may_face(triangle, other); });
  return found;
}

// others: of that object.
std::vector<SurfaceOverlap::FacedRegion> SurfaceOverlap::faced_regions(int triangle, int object, std::span<const int> others) const {
  const CollisionMesh& mesh = surface_.mesh;
  const std::vector<int> faced = facing(triangle, others);
  const int own = mesh.vertex_object[mesh.triangles[triangle][0]];
  std::vector<FacedRegion> found;
  if (!pairs_.has_regions(own, object)) found.push_back({std::nullopt, faced});
  else
    for (int region_pair = -1; region_pair < pairs_.region_pair_count(own, object); ++region_pair) {
      const SurfaceRegion seen(pairs_, mesh, triangle, object, region_pair);
      std::vector<int> of_region;
      std::copy_if(faced.begin(), faced.end(), std::back_inserter(of_region), [&](int t) { return seen.contains(t); });
      if (!of_region.empty()) found.push_back({seen, std::move(of_region)});
    }
  return found;
}

// near: triangles of any object, ascending.
SurfaceOverlap::Around SurfaceOverlap::find_around(int triangle, int object, const std::vector<int>& near) const {
  const CollisionMesh& mesh = surface_.mesh;
  const double range = pairs_.point(mesh.vertex_object[mesh.triangles[triangle][0]], object).range_max();
  Around around{{}, 2 * range, true, false};
  const auto first = std::lower_bound(near.begin(), near.end(), first_triangle_[object]);
  const auto last = std::lower_bound(first, near.end(), first_triangle_[object + 1]);
  if (std::none_of(first, last, [&](int t) { return may_face(triangle, t); })) return around;
  const std::array<Vec3, 3> own = tack::corners(held_.x(), mesh.triangles[triangle]);
  for (auto i = first; i != last; ++i) {
    const double apart = (1 - accuracy) * triangles_apart(own, tack::corners(held_.x(), mesh.triangles[*i]), range);
    if (apart >= 2 * range) continue;
    around.nearest = std::min(around.nearest, apart);
    around.triangles.push_back(*i);
    if (!may_face(triangle, *i)) continue;
    around.faced = true;
    const double cosine = held_.cosine(triangle, held_.normal(*i));
    around.parallel = around.parallel && (held_.topology().two_sided(*i) ? std::abs(cosine) : cosine) > parallel;
  }
  return around;
}

void SurfaceOverlap::divide_or_wait(int triangle, int object, const Around& around, TriangleDivision& division, Found& found) const {
  const PairRole& role = pairs_.point(surface_.mesh.vertex_object[surface_.mesh.triangles[triangle][0]], object);
  // Samples are no larger than the reach, as what they stand for has about one gap; where it varies, than the range.
  const int depth = TriangleDivision::depth_of(held_.area(triangle), around.parallel ? 2 * role.range_max() : role.range_max());
  if (around.nearest > role.range_max() && !role.bonds)
    return found.wait(triangle, object, depth, around.triangles, {{TriangleDivision::all, around.nearest - role.range_max()}});
  for (const FacedRegion& faced : faced_regions(triangle, object, around.triangles)) {
    std::vector<TriangleDivision::Left> left;
    division.divide({triangle, object, role.range_max(), depth}, faced.triangles, faced.seen(), role.bonds ? std::span<const int>() : around.triangles, found.samples, found.parts, left);
    if (!left.empty()) found.wait(triangle, object, depth, around.triangles, left, faced.region_pair());
  }
}

bool SurfaceOverlap::weighs(int a, int b, const IntegrationSides& sides) const {
  return pairs_.point(a, b).overlap_only && sides.integrates(a, b);
}

double SurfaceOverlap::unknown_area(int vertex_index, int object, const Vec3& normal) const {
  const std::array key{surface_.mesh.vertex_object[vertex_index], object};
  const auto at = std::lower_bound(known_.begin(), known_.end(), key, [](const KnownPair& k, const std::array<int, 2>& of) { return std::array{k.a, k.b} < of; });
  const bool any = at != known_.end() && std::array{at->a, at->b} == key;
  double area = 0;
  for (const int t : held_.topology().triangles_at(vertex_index))
    if (!any || !std::binary_search(at->triangles.begin(), at->triangles.end(), t)) area += held_.area(t) / 3 * std::max(0.0, held_.cosine(t, normal));
  return area;
}

std::vector<Aabb> SurfaceOverlap::object_boxes() const {
  std::vector<Aabb> boxes(pairs_.objects());
  for_each(pairs_.objects(), [&](int a) {
    for (int t = first_triangle_[a]; t < first_triangle_[a + 1]; ++t)
      for (const int v : surface_.mesh.triangles[t]) boxes[a].include(Vec3(vertex(held_.x(), v)));
  });
  return boxes;
}

std::vector<std::array<int, 2>> SurfaceOverlap::near_objects(const IntegrationSides& sides, const std::vector<Aabb>& boxes) const {
  const int n = pairs_.objects();
  // From left to right, each with those that begin before it ends.
  double widest = 0;
  for (const PairLaw& law : pairs_.laws()) widest = std::max(widest, 2 * law.range());
  std::vector<int> order;
  for (int a = 0; a < n; ++a)
    if (first_triangle_[a] < first_triangle_[a + 1]) order.push_back(a);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return std::pair(boxes[a].lo[0], a) < std::pair(boxes[b].lo[0], b); });
  std::vector<std::array<int, 2>> found;
  const auto take = [&](int a, int b) {
    Aabb reached = boxes[b];
    reached.inflate(2 * pairs_.point(a, b).range_max());
    if (weighs(a, b, sides) && boxes[a].overlaps(reached)) found.push_back({a, b});
  };
  for (size_t i = 0; i < order.size(); ++i)
    for (size_t j = i + 1; j < order.size() && boxes[order[j]].lo[0] <= boxes[order[i]].hi[0] + widest; ++j) {
      take(order[i], order[j]);
      take(order[j], order[i]);
    }
  std::sort(found.begin(), found.end());
  return found;
}

void SurfaceOverlap::weigh(const IntegrationSides& sides, const BroadPhase& broad_phase, std::vector<GroupView>& views) {
  samples_.clear();
  parts_.clear();
  known_.clear();
  waiting_pairs_.clear();
  waiting_.clear();
  around_.clear();
  const std::vector<Aabb> boxes = object_boxes();
  const std::vector<std::array<int, 2>> near = near_objects(sides, boxes);
  std::vector<std::vector<Found>> all(near.size());
  // All pairs of one object together: what is near a triangle is asked once.
  std::vector<Chunk> chunks;
  for (size_t first = 0, last = 0; first < near.size(); first = last) {
    const int a = near[first][0], begin = first_triangle_[a], n = first_triangle_[a + 1] - begin;
    std::vector<Opposite> opposite;
    for (; last < near.size() && near[last][0] == a; ++last) {
      const int b = near[last][1];
      all[last].resize(chunk_count(n));
      opposite.push_back({b, boxes[b], all[last].data()});
      opposite.back().reached.inflate(2 * pairs_.point(a, b).range_max());
    }
    for (int c = 0; c < chunk_count(n); ++c)
      chunks.push_back({opposite, c, begin + c * chunk_size, begin + std::min(n, (c + 1) * chunk_size)});
  }
  for_each(static_cast<int>(chunks.size()), [&](int i) { weigh_chunk(chunks[i], broad_phase, views); }, 1);
  for (size_t pair = 0; pair < near.size(); ++pair) {
    OverlapFacets& parts = parts_.emplace_back(OverlapFacets{near[pair][0], near[pair][1], {}, {}, {}});
    KnownPair& known = known_.emplace_back(KnownPair{near[pair][0], near[pair][1], {}});
    for (const Found& found : all[pair]) {
      known.triangles.insert(known.triangles.end(), found.known.begin(), found.known.end());
      parts.parts.insert(parts.parts.end(), found.parts.parts.begin(), found.parts.parts.end());
      parts.rims.insert(parts.rims.end(), found.parts.rims.begin(), found.parts.rims.end());
      parts.whole.insert(parts.whole.end(), found.parts.whole.begin(), found.parts.whole.end());
    }
    for (const Found& found : all[pair]) add_waiting(near[pair][0], near[pair][1], found.waiting, found.around);
  }
  for (GroupView& group : views)
    if (weighs(surface_.mesh.vertex_object[group.point], group.object, sides))
      for (SeenPiece& piece : group.view.pieces) piece.area = 0;
  for (const std::vector<Found>& pair : all)
    for (const Found& found : pair) {
      for (const auto& [corner, area] : found.shares) views[corner.view].view.pieces[corner.piece].area += area;
      samples_.insert(samples_.end(), found.samples.begin(), found.samples.end());
    }
}

}  // namespace tack
