#include "framework/contact/coverage.hpp"

#include <algorithm>
#include <cmath>

#include "framework/contact/triangle_division.hpp"
#include "geometry/broad_phase/aabb.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// How far beyond the rim a corner may lie, relative to the root of its triangle's area: rounding, when meshes agree. More where its own
// surface ends, too, and the rim can uncover nothing else: plates of one size that contract a little differently would be
// divided all along their rims.
constexpr double on_the_rim = 1e-6, on_both_rims = 1e-3;

// By key; -1: none.
int find_view(const std::vector<GroupView>& views, int point, int object) {
  const std::array key{point, object};
  const auto at = std::lower_bound(views.begin(), views.end(), key,
                                   [](const GroupView& v, const std::array<int, 2>& k) { return v.key() < k; });
  return at != views.end() && at->key() == key ? static_cast<int>(at - views.begin()) : -1;
}

}  // namespace

// What a chunk of triangles adds: shares of area for the corners' views, and samples.
struct Coverage::Found {
  struct Share {
    Corner corner;
    double area;  // m^2
  };
  std::vector<Share> shares;
  std::vector<ContactSample> samples;
  CoveredParts parts{};
};

Coverage::Coverage(const ContactSurface& surface, const PairTable& pairs, const HeldSurface& held)
    : surface_(surface), pairs_(pairs), held_(held), first_triangle_(pairs.objects() + 1, 0), wanted_(pairs.any_covered()) {
  for (const Triangle& t : surface.mesh.triangles) ++first_triangle_[surface.mesh.vertex_object[t[0]] + 1];
  for (int a = 0; a < pairs.objects(); ++a) first_triangle_[a + 1] += first_triangle_[a];
}

std::array<Coverage::Corner, 3> Coverage::corners(const std::vector<GroupView>& views, int triangle, int object) const {
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

bool Coverage::covered(const std::vector<GroupView>& views, int triangle, const std::array<Corner, 3>& corners) const {
  const double size = std::sqrt(held_.area(triangle));
  return std::all_of(corners.begin(), corners.end(), [&](const Corner& c) {
    if (c.view < 0 || c.piece < 0) return false;
    const GroupView& at = views[c.view];
    const double slack = held_.topology().smooth_vertex(at.point) ? on_the_rim : on_both_rims;
    return at.view.pieces[c.piece].beyond <= slack * size;
  });
}

// By their orientations alone.
bool Coverage::may_face(int triangle, int other) const {
  return held_.cosine(triangle, held_.normal(other)) > least_cosine ||
         held_.cosine(other, held_.normal(triangle)) > least_cosine;
}

void Coverage::capture(const std::vector<GroupView>& views, IntegrationSides& sides) const {
  sides.clear();
  const CollisionMesh& mesh = surface_.mesh;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    const int object = mesh.vertex_object[mesh.triangles[t][0]];
    const int lead = mesh.triangles[t][0];
    const auto first = std::lower_bound(views.begin(), views.end(), lead,
                                        [](const GroupView& v, int point) { return v.point < point; });
    for (auto view = first; view != views.end() && view->point == lead; ++view) {
      const PairRole& role = pairs_.point(object, view->object);
      if (!role.automatic) continue;
      const auto at = corners(views, t, view->object);
      if (!covered(views, t, at)) continue;
      const SeenPiece& piece = view->view.pieces[at[0].piece];
      if (piece.distance >= role.range) continue;
      IntegrationSides::Capture& capture = sides.capture(object, view->object);
      capture.area += held_.area(t) * held_.cosine(t, piece.normal);
      ++capture.triangles;
    }
  }
  sides.choose();
}

void Coverage::weigh_pair(int a, int b, const NearTriangles& near, const std::vector<GroupView>& views,
                          std::vector<Found>& found) const {
  const CollisionMesh& mesh = surface_.mesh;
  const double reach = 2 * pairs_.point(a, b).range;
  const bool bonds = pairs_.point(a, b).bonds;
  Aabb box;
  for (int t = first_triangle_[b]; t < first_triangle_[b + 1]; ++t)
    for (const int v : mesh.triangles[t]) box.include(Vec3(vertex(held_.x(), v)));
  box.inflate(reach);
  const int begin = first_triangle_[a], n = first_triangle_[a + 1] - begin;
  found.resize(chunk_count(n));
  for_each_chunk(n, [&](int c, int first, int last) {
    TriangleDivision division(mesh, held_);
    std::vector<int> close;
    for (int t = begin + first; t < begin + last; ++t) {
      Aabb own;
      for (const int v : mesh.triangles[t]) own.include(Vec3(vertex(held_.x(), v)));
      if (!own.overlaps(box)) continue;
      const auto at = corners(views, t, b);
      if (covered(views, t, at)) {
        double area_of_all = 0;
        bool close_by = false;
        for (int i = 0; i < 3; ++i) {
          const SeenPiece& piece = views[at[i].view].view.pieces[at[i].piece];
          const double area = held_.area(t) / 3 * held_.cosine(t, piece.normal);
          area_of_all += area;
          close_by = close_by || piece.distance < reach;
          found[c].shares.push_back({at[i], area});
          if (piece.distance < reach) found[c].parts.parts.push_back({t, piece.triangle, area, piece.distance});
        }
        if (bonds && close_by) found[c].parts.whole.push_back({t, area_of_all});
        continue;
      }
      close.clear();
      near(mesh.triangles[t], nullptr, close);
      std::erase_if(close, [&](int other) {
        return mesh.vertex_object[mesh.triangles[other][0]] != b || !may_face(t, other);
      });
      if (!close.empty()) division.divide(t, b, reach, close, found[c].samples, found[c].parts);
    }
  });
}

bool Coverage::weighs(int a, int b, const IntegrationSides& sides) const {
  return pairs_.point(a, b).covered && sides.integrates(a, b);
}

std::vector<std::array<int, 2>> Coverage::near_objects(const IntegrationSides& sides) const {
  const int n = pairs_.objects();
  std::vector<Aabb> boxes(n);
  for_each(n, [&](int a) {
    for (int t = first_triangle_[a]; t < first_triangle_[a + 1]; ++t)
      for (const int v : surface_.mesh.triangles[t]) boxes[a].include(Vec3(vertex(held_.x(), v)));
  });
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
    reached.inflate(2 * pairs_.point(a, b).range);
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

void Coverage::weigh(const IntegrationSides& sides, const NearTriangles& near, std::vector<GroupView>& views) {
  samples_.clear();
  parts_.clear();
  std::vector<std::vector<Found>> all;
  for (const auto& [a, b] : near_objects(sides)) {
    weigh_pair(a, b, near, views, all.emplace_back());
    parts_.push_back({a, b, {}, {}, {}});
    for (const Found& found : all.back()) {
      parts_.back().parts.insert(parts_.back().parts.end(), found.parts.parts.begin(), found.parts.parts.end());
      parts_.back().rims.insert(parts_.back().rims.end(), found.parts.rims.begin(), found.parts.rims.end());
      parts_.back().whole.insert(parts_.back().whole.end(), found.parts.whole.begin(), found.parts.whole.end());
    }
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
