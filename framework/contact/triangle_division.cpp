#include "framework/contact/triangle_division.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/broad_phase/aabb.hpp"

namespace tack {
namespace {

constexpr int finer = 3;       // divisions within one sample
constexpr int most_depth = 6;  // of samples: 4096 in a triangle

}  // namespace

void TriangleDivision::divide(int triangle, int object, double reach, const std::vector<int>& near,
                              std::vector<ContactSample>& out) {
  triangle_ = triangle;
  object_ = object;
  reach_ = reach;
  out_ = &out;
  size_ = std::sqrt(2 * held_.area(triangle));
  slack_ = 1e-3 * rim_slack * size_;
  // Samples are no larger than the reach: what they stand for has about one gap.
  sample_depth_ = std::clamp(static_cast<int>(std::ceil(std::log2(size_ / reach))), 1, most_depth);
  last_depth_ = sample_depth_ + finer;
  part({Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}, 0, near, nullptr);
}

Vec3 TriangleDivision::place(const Vec3& inside) const {
  return point_inside(held_.x(), mesh_.triangles[triangle_], inside);
}

TriangleDivision::Seen TriangleDivision::look(const Vec3& inside, const std::vector<int>& near) {
  const Viewpoint from = viewer_.inner_view(triangle_, place(inside), 1);
  const FacingView view = viewer_.look(from, static_cast<int>(near.size()), [&](int i) { return near[i]; });
  Seen seen;
  if (view.count == 0) return seen;
  const SeenPiece& piece = *std::max_element(view.pieces.begin(), view.pieces.begin() + view.count,
                                             [](const SeenPiece& a, const SeenPiece& b) { return a.area < b.area; });
  return {true, piece.beyond <= slack_ && piece.distance < reach_, piece.beyond, piece.normal};
}

TriangleDivision::Look TriangleDivision::look_from(const Corners& points, const std::vector<int>& near) {
  Look seen;
  for (int i = 0; i < 3; ++i) {
    seen.from[i] = look(points[i], near);
    seen.covered += seen.from[i].covered;
  }
  return seen;
}

std::vector<int> TriangleDivision::those_near(const Corners& c, const std::vector<int>& near) const {
  Aabb box;
  for (const Vec3& inside : c) box.include(place(inside));
  box.inflate(reach_);
  std::vector<int> kept;
  for (const int t : near) {
    Aabb other;
    for (const int v : mesh_.triangles[t]) other.include(Vec3(vertex(held_.x(), v)));
    if (box.overlaps(other)) kept.push_back(t);
  }
  return kept;
}

// Whether nothing between the three corners can be covered.
bool TriangleDivision::hopeless(const Look& seen, double size) const {
  return std::all_of(seen.from.begin(), seen.from.end(), [&](const Seen& s) {
    return s.any ? s.beyond > 2 * size : 2 * size < reach_;
  });
}

// One sample is made of all that is covered below its depth.
void TriangleDivision::part(const Corners& c, int depth, const std::vector<int>& near, Sum* sum) {
  if (depth != sample_depth_) {
    examine(c, depth, near, sum);
    return;
  }
  Sum own;
  examine(c, depth, near, &own);
  if (!(own.area > 0) || own.normal.isZero()) return;
  out_->push_back({triangle_, own.inside / own.area, object_, own.normal.normalized(), own.area});
}

void TriangleDivision::examine(const Corners& c, int depth, const std::vector<int>& near, Sum* sum) {
  const std::vector<int> close = those_near(c, near);
  if (close.empty()) return;
  const double size = size_ / (1 << depth);
  if (sum) {
    const Look seen = look_from(c, close);
    if (seen.covered == 3) return add(c, depth, seen, *sum);
    if (seen.covered == 0 && hopeless(seen, size)) return;
    if (depth == last_depth_) {
      // Corners may lie on the rim itself; points inside tell what part is covered.
      const Vec3 centre = (c[0] + c[1] + c[2]) / 3;
      const Corners inner = {(c[0] + centre) / 2, (c[1] + centre) / 2, (c[2] + centre) / 2};
      return add(inner, depth, look_from(inner, close), *sum);
    }
  }
  const Vec3 m0 = (c[0] + c[1]) / 2, m1 = (c[1] + c[2]) / 2, m2 = (c[2] + c[0]) / 2;
  for (const Corners& child : {Corners{c[0], m0, m2}, Corners{m0, c[1], m1}, Corners{m2, m1, c[2]}, Corners{m1, m2, m0}})
    part(child, depth + 1, close, sum);
}

// The part of the points that are covered is the part of the piece that is.
void TriangleDivision::add(const Corners& points, int depth, const Look& seen, Sum& sum) const {
  if (seen.covered == 0) return;
  Vec3 inside = Vec3::Zero(), normal = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (!seen.from[i].covered) continue;
    inside += points[i] / seen.covered;
    normal += seen.from[i].normal;
  }
  const double cosine = held_.cosine(triangle_, normal.normalized());
  const double area = held_.area(triangle_) / std::pow(4.0, depth) * seen.covered / 3 * cosine;
  sum.area += area;
  sum.inside += area * inside;
  sum.normal += area * normal;
}

}  // namespace tack
