#include "framework/contact/triangle_division.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/distance/point_triangle.hpp"
#include "geometry/distance/triangle_triangle.hpp"

namespace tack {
namespace {

constexpr int finer = 3;       // divisions within one sample
constexpr int most_depth = 6;  // of samples: 4096 in a triangle
constexpr int most_lines = 6;  // of rims that cut one piece
constexpr double accuracy = 1e-9;  // relative: far above rounding

using Corners = std::array<Vec3, 3>;
const Corners whole = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};

Corners middles_of(const Corners& c) { return {(c[0] + c[1]) / 2, (c[1] + c[2]) / 2, (c[2] + c[0]) / 2}; }

// Returns the four children of a triangle from its corners c, or the views from them, and those of
// the midpoints m of its sides.
template <class T>
std::array<std::array<T, 3>, 4> children_of(const std::array<T, 3>& c, const std::array<T, 3>& m) {
  return {{{c[0], m[0], m[2]}, {m[0], c[1], m[1]}, {m[2], m[1], c[2]}, {m[1], m[2], m[0]}}};
}

std::array<Corners, 4> children_of(const Corners& c) { return children_of(c, middles_of(c)); }

}  // namespace

int TriangleDivision::depth_of(double area, double size) {
  return std::clamp(static_cast<int>(std::ceil(std::log2(std::sqrt(2 * area) / size))), 1, most_depth);
}

void TriangleDivision::begin(const What& what, const SurfaceRegion* seen, std::vector<ContactSample>& out, OverlapFacets& parts) {
  parts_ = &parts;
  triangle_ = what.triangle;
  object_ = what.object;
  seen_ = seen;
  viewer_.look_at(seen);
  range_ = what.range;
  reach_ = 2 * what.range;
  out_ = &out;
  size_ = std::sqrt(2 * held_.area(triangle_));
  slack_ = 1e-9 * size_;
  sample_depth_ = what.depth;
  last_depth_ = sample_depth_ + finer;
}

void TriangleDivision::divide(const What& what, const std::vector<int>& facing, const SurfaceRegion* seen, std::span<const int> around,
                              std::vector<ContactSample>& out, OverlapFacets& parts, std::vector<Left>& left) {
  begin(what, seen, out, parts);
  around_ = around;
  left_ = &left;
  part(whole, 0, 0, facing);
}

void TriangleDivision::divide_cell(const What& what, int cell, const std::vector<int>& facing, const SurfaceRegion* seen, std::vector<ContactSample>& out,
                                   OverlapFacets& parts) {
  begin(what, seen, out, parts);
  Corners c = whole;
  for (int below = what.depth - 1; below >= 0; --below) c = children_of(c)[cell >> 2 * below & 3];
  gather(c, cell, those_near(c, facing));
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
  for (int i = 0; i < 3; ++i) seen.from[i] = look(points[i], near);
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

// Returns whether nothing between the three corners can overlap.
bool TriangleDivision::hopeless(const Look& seen, double size) const {
  return std::all_of(seen.from.begin(), seen.from.end(), [&](const Seen& s) {
    return s.any ? s.beyond > 2 * size : 2 * size < reach_;
  });
}

// By how much all around a cell is; 0 if something is within it.
double TriangleDivision::out_of_range(const Corners& c) const {
  const Corners at = {place(c[0]), place(c[1]), place(c[2])};
  double nearest = around_.empty() ? range_ : reach_;
  for (size_t i = 0; i < around_.size() && nearest > range_; ++i)
    nearest = std::min(nearest, (1 - accuracy) * triangles_apart(at, corners(held_.x(), mesh_.triangles[around_[i]]), range_));
  return std::max(0.0, nearest - range_);
}

// Down to cells.
void TriangleDivision::part(const Corners& c, int depth, int cell, const std::vector<int>& near) {
  const std::vector<int> close = those_near(c, near);
  if (close.empty()) return;
  if (depth == sample_depth_) {
    if (const double away = out_of_range(c); away > 0) left_->push_back({cell, away});
    else gather(c, cell, close);
    return;
  }
  const auto children = children_of(c);
  for (int i = 0; i < 4; ++i) part(children[i], depth + 1, 4 * cell + i, close);
}

// One sample is made of all that is covered in its cell.
void TriangleDivision::gather(const Corners& c, int cell, const std::vector<int>& near) {
  Sum own;
  examine(c, sample_depth_, look_from(c, near), near, own);
  // The strip along a rim that only the slack covers is no sample.
  const double strip = slack_ * size_ / (1 << sample_depth_);
  if (!(own.area > 4 * strip) || !(own.normal.norm() > accuracy * own.area)) return;
  out_->push_back({triangle_, own.inside / own.area, object_, own.normal.normalized(), own.area, cell, seen_ ? seen_->region_pair() : -1});
  parts_->parts.push_back({triangle_, own.leader, own.area, own.distance / own.area});
}

void TriangleDivision::examine(const Corners& c, int depth, const Look& seen, const std::vector<int>& near, Sum& sum) {
  if (seen.covered() == 3) return add(c, depth, seen, sum);
  if (seen.covered() == 0 && hopeless(seen, size_ / (1 << depth))) return;
  if (depth == last_depth_) {
    if (cut(c, seen, near, sum)) return;
    // Corners may lie on the rim itself; points inside tell what part is covered.
    const Vec3 centre = (c[0] + c[1] + c[2]) / 3;
    const Corners inner = {(c[0] + centre) / 2, (c[1] + centre) / 2, (c[2] + centre) / 2};
    return add(inner, depth, look_from(inner, near), sum);
  }
  const Corners middles = middles_of(c);
  const auto children = children_of(c, middles);
  const auto views = children_of(seen.from, look_from(middles, near).from);
  for (int i = 0; i < 4; ++i)
    if (const std::vector<int> close = those_near(children[i], near); !close.empty()) examine(children[i], depth + 1, {views[i]}, close, sum);
}

// False if the rim there is none that lines can say: where what lies opposite ends at the reach.
bool TriangleDivision::cut(const Corners& c, const Look& seen, const std::vector<int>& near, Sum& sum) {
  lines_.clear();
  for (int i = 0; i < 3; ++i) {
    if (!seen.from[i].any) return false;
    if (!seen.from[i].covered) add_clip_lines(mesh_, held_, seen_, seen.from[i].triangle, place(c[i]), lines_);
  }
  if (lines_.empty() || lines_.size() > most_lines) return false;
  // So that corners on the rim are within, and a rim along the edge of a piece is found.
  for (ClipLine& line : lines_) line.at += slack_ / 2 * line.outward;
  for (const ClipPolygon& face : clip_by_lines(held_.x(), mesh_.triangles[triangle_], c, lines_)) {
    const Vec3 first = place(face[0].inside);
    double area = 0;
    Vec3 middle = Vec3::Zero(), mean = Vec3::Zero();
    for (const ClipCorner& corner : face) mean += corner.inside / static_cast<double>(face.size());
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
void TriangleDivision::add_rims(const ClipPolygon& face) {
  for (size_t i = 0; i < face.size(); ++i) {
    if (face[i].line < 0) continue;
    const ClipLine& line = lines_[face[i].line];
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
  if (seen.covered() == 0) return;
  Seen mean;
  Vec3 inside = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (!seen.from[i].covered) continue;
    inside += points[i] / seen.covered();
    mean.normal += seen.from[i].normal;
    mean.distance += seen.from[i].distance / seen.covered();
    mean.triangle = seen.from[i].triangle;
  }
  const double cosine = held_.cosine(triangle_, mean.normal.normalized());
  add(held_.area(triangle_) / std::pow(4.0, depth) * seen.covered() / 3 * cosine, inside, mean, sum);
}

}  // namespace tack
