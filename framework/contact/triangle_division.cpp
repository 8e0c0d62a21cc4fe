#include "framework/contact/triangle_division.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

constexpr int finer = 3;       // divisions within one sample
constexpr int most_depth = 6;  // of samples: 4096 in a triangle
constexpr int most_lines = 6;  // of rims that cut one piece

}  // namespace

void TriangleDivision::divide(int triangle, int object, double reach, const std::vector<int>& near,
                              std::vector<ContactSample>& out, CoveredParts& parts) {
  parts_ = &parts;
  triangle_ = triangle;
  object_ = object;
  reach_ = reach;
  out_ = &out;
  size_ = std::sqrt(2 * held_.area(triangle));
  slack_ = 1e-9 * size_;
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
  const FacingView view = viewer_.look_within(from, near, reach_);
  Seen seen;
  if (view.count == 0) return seen;
  const SeenPiece& piece = *std::max_element(view.pieces.begin(), view.pieces.begin() + view.count,
                                             [](const SeenPiece& a, const SeenPiece& b) { return a.area < b.area; });
  return {true, piece.beyond <= slack_, piece.beyond, piece.distance, piece.triangle, piece.normal};
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
  const Vec3 centre = place((c[0] + c[1] + c[2]) / 3);
  double radius = 0;
  for (const Vec3& inside : c) radius = std::max(radius, (place(inside) - centre).norm());
  const double reach = reach_ + radius;
  std::vector<int> kept;
  for (const int t : near) {
    const auto [t0, t1, t2] = corners(held_.x(), mesh_.triangles[t]);
    const Vec3 lo = t0.cwiseMin(t1).cwiseMin(t2), hi = t0.cwiseMax(t1).cwiseMax(t2);
    if ((lo - centre).cwiseMax(centre - hi).cwiseMax(0.0).squaredNorm() >= reach * reach) continue;
    if (point_triangle_distance(centre, t0, t1, t2) < reach * reach) kept.push_back(t);
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
  if (!(own.area > 0) || !(own.normal.norm() > 1e-9 * own.area)) return;
  out_->push_back({triangle_, own.inside / own.area, object_, own.normal.normalized(), own.area});
  parts_->parts.push_back({triangle_, own.leader, own.area, own.distance / own.area});
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
      if (cut(c, seen, close, *sum)) return;
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

// False if the rim there is none that lines can say: where what lies opposite ends at the reach.
bool TriangleDivision::cut(const Corners& c, const Look& seen, const std::vector<int>& near, Sum& sum) {
  lines_.clear();
  for (int i = 0; i < 3; ++i) {
    if (!seen.from[i].any) return false;
    if (!seen.from[i].covered) add_rim_lines(mesh_, held_, seen.from[i].triangle, place(c[i]), lines_);
  }
  if (lines_.empty() || lines_.size() > most_lines) return false;
  // So that corners on the rim are within, and a rim along the edge of a piece is found.
  for (RimLine& line : lines_) line.at += slack_ / 2 * line.outward;
  for (const CutFace& face : cut_by_rims(held_.x(), mesh_.triangles[triangle_], c, lines_)) {
    const Vec3 first = place(face[0].inside);
    double area = 0;
    Vec3 middle = Vec3::Zero(), mean = Vec3::Zero();
    for (const CutCorner& corner : face) mean += corner.inside / static_cast<double>(face.size());
    for (size_t i = 1; i + 1 < face.size(); ++i) {
      const double part = (place(face[i].inside) - first).cross(place(face[i + 1].inside) - first).norm() / 2;
      area += part;
      middle += part / 3 * (face[0].inside + face[i].inside + face[i + 1].inside);
    }
    const Vec3 inside = area > slack_ * slack_ ? Vec3(middle / area) : mean;
    const Seen from = look(inside, near);
    if (!from.covered) continue;
    add(area * held_.cosine(triangle_, from.normal), inside, from, sum);
    add_rims(face);
  }
  return true;
}

// Faces on both sides of a line take each other's share of it away.
void TriangleDivision::add_rims(const CutFace& face) {
  for (size_t i = 0; i < face.size(); ++i) {
    if (face[i].line < 0) continue;
    const RimLine& line = lines_[face[i].line];
    const Vec3 &a = face[i].inside, &b = face[(i + 1) % face.size()].inside;
    const Vec3 way = place(b) - place(a);
    const double length = way.cross(held_.normal(line.triangle)).norm();
    parts_->rims.push_back({triangle_, (a + b) / 2, line.triangle, line.side, face[i].beyond ? -length : length});
  }
}

void TriangleDivision::add(double area, const Vec3& inside, const Seen& seen, Sum& sum) const {
  sum.area += area;
  sum.distance += area * seen.distance;
  sum.inside += area * inside;
  sum.normal += area * seen.normal;
  if (sum.leader < 0) sum.leader = seen.triangle;
}

// The part of the points that are covered is the part of the piece that is.
void TriangleDivision::add(const Corners& points, int depth, const Look& seen, Sum& sum) const {
  if (seen.covered == 0) return;
  Seen mean;
  Vec3 inside = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (!seen.from[i].covered) continue;
    inside += points[i] / seen.covered;
    mean.normal += seen.from[i].normal;
    mean.distance += seen.from[i].distance / seen.covered;
    mean.triangle = seen.from[i].triangle;
  }
  const double cosine = held_.cosine(triangle_, mean.normal.normalized());
  add(held_.area(triangle_) / std::pow(4.0, depth) * seen.covered / 3 * cosine, inside, mean, sum);
}

}  // namespace tack
