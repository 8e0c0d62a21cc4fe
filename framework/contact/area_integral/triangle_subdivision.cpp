#include "framework/contact/area_integral/triangle_subdivision.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "geometry/distance/point_triangle.hpp"
#include "geometry/distance/triangle_triangle.hpp"

namespace tack {
namespace {

constexpr int depth_within_cell = 3;                  // divisions within one cell
constexpr int depth_max = 6;                          // of cells: 4096 in a triangle
constexpr int clip_lines_max = 6;                     // boundary lines that clip one subtriangle
constexpr double distance_tolerance_relative = 1e-9;  // far above rounding
constexpr double on_line_ratio = 5e-10;               // per size of a triangle, far above rounding

using Corners = std::array<Vec3, 3>;
const Corners unit_triangle = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};

Corners midpoints_of(const Corners& c) { return {(c[0] + c[1]) / 2, (c[1] + c[2]) / 2, (c[2] + c[0]) / 2}; }

// Returns the four children of a triangle from values at its corners c and at the midpoints m of its
// sides.
template <class T>
std::array<std::array<T, 3>, 4> children_of(const std::array<T, 3>& c, const std::array<T, 3>& m) {
  return {{{c[0], m[0], m[2]}, {m[0], c[1], m[1]}, {m[2], m[1], c[2]}, {m[1], m[2], m[0]}}};
}

std::array<Corners, 4> children_of(const Corners& c) { return children_of(c, midpoints_of(c)); }

}  // namespace

double TriangleSubdivision::line_tolerance(double area) { return on_line_ratio * std::sqrt(2 * area); }

int TriangleSubdivision::depth_of(double area, double size) {
  return std::clamp(static_cast<int>(std::ceil(std::log2(std::sqrt(2 * area) / size))), 1, depth_max);
}

void TriangleSubdivision::begin(const Request& request, const SurfaceRegion* region, std::vector<InteriorPoint>& out, OverlapFacets& facets) {
  facets_ = &facets;
  triangle_ = request.triangle;
  object_ = request.object;
  region_ = region;
  finder_.restrict_to(region);
  range_ = request.range;
  range_twice_ = 2 * request.range;
  out_ = &out;
  size_ = std::sqrt(2 * lagged_.area(triangle_));
  on_line_ = line_tolerance(lagged_.area(triangle_));
  sample_depth_ = request.depth;
  last_depth_ = sample_depth_ + depth_within_cell;
}

void TriangleSubdivision::subdivide(const Request& request, const std::vector<int>& facing, const SurfaceRegion* region, std::span<const int> nearby,
                                    std::vector<InteriorPoint>& out, OverlapFacets& facets, std::vector<SkippedCell>& skipped) {
  begin(request, region, out, facets);
  nearby_ = nearby;
  skipped_ = &skipped;
  subdivide_to_cells(unit_triangle, 0, 0, facing);
}

void TriangleSubdivision::subdivide_cell(const Request& request, int cell, const std::vector<int>& facing, const SurfaceRegion* region, std::vector<InteriorPoint>& out,
                                         OverlapFacets& facets) {
  begin(request, region, out, facets);
  Corners c = unit_triangle;
  for (int below = request.depth - 1; below >= 0; --below) c = children_of(c)[cell >> 2 * below & 3];
  add_interior_point(c, cell, triangles_near(c, facing));
}

Vec3 TriangleSubdivision::position(const Vec3& inside) const {
  return point_inside(lagged_.x(), mesh_.triangles[triangle_], inside);
}

TriangleSubdivision::PointOverlap TriangleSubdivision::overlap_at(const Vec3& inside, const std::vector<int>& near) {
  const QueryPoint from = finder_.inside_triangle(triangle_, position(inside), 1);
  const VisiblePatches visible = finder_.find_within(from, near, range_twice_);
  PointOverlap overlap;
  if (visible.count == 0) return overlap;
  const VisiblePatch& patch = *std::max_element(visible.patches.begin(), visible.patches.begin() + visible.count,
                                                [](const VisiblePatch& a, const VisiblePatch& b) { return a.area < b.area; });
  return {true, patch.overshoot <= on_line_, patch.overshoot, patch.distance, patch.seed_triangle, patch.normal};
}

TriangleSubdivision::CornerOverlaps TriangleSubdivision::overlaps_at(const Corners& points, const std::vector<int>& near) {
  CornerOverlaps overlaps;
  for (int i = 0; i < 3; ++i) overlaps.at[i] = overlap_at(points[i], near);
  return overlaps;
}

std::vector<int> TriangleSubdivision::triangles_near(const Corners& c, const std::vector<int>& near) const {
  const Vec3 centre = position((c[0] + c[1] + c[2]) / 3);
  double radius = 0;
  for (const Vec3& inside : c) radius = std::max(radius, (position(inside) - centre).norm());
  const double distance_max = range_twice_ + radius;
  std::vector<int> kept;
  for (const int t : near) {
    const auto [t0, t1, t2] = corners(lagged_.x(), mesh_.triangles[t]);
    const Vec3 lo = t0.cwiseMin(t1).cwiseMin(t2), hi = t0.cwiseMax(t1).cwiseMax(t2);
    if ((lo - centre).cwiseMax(centre - hi).cwiseMax(0.0).squaredNorm() >= distance_max * distance_max) continue;
    if (point_triangle_distance(centre, t0, t1, t2) < distance_max * distance_max) kept.push_back(t);
  }
  return kept;
}

// Returns whether no part of a subtriangle of this size [m] can overlap.
bool TriangleSubdivision::cannot_overlap(const CornerOverlaps& overlaps, double size) const {
  return std::all_of(overlaps.at.begin(), overlaps.at.end(), [&](const PointOverlap& s) {
    return s.visible ? s.overshoot > 2 * size : 2 * size < range_twice_;
  });
}

// Returns by how much all nearby triangles are out of range of a cell [m]; 0 if one is within range.
double TriangleSubdivision::distance_beyond_range(const Corners& c) const {
  const Corners at = {position(c[0]), position(c[1]), position(c[2])};
  double nearest = nearby_.empty() ? range_ : range_twice_;
  for (size_t i = 0; i < nearby_.size() && nearest > range_; ++i)
    nearest = std::min(nearest, (1 - distance_tolerance_relative) * triangles_apart(at, corners(lagged_.x(), mesh_.triangles[nearby_[i]]), range_));
  return std::max(0.0, nearest - range_);
}

// Divides subtriangles down to cells.
void TriangleSubdivision::subdivide_to_cells(const Corners& c, int depth, int cell, const std::vector<int>& near) {
  const std::vector<int> close = triangles_near(c, near);
  if (close.empty()) return;
  if (depth == sample_depth_) {
    if (const double excess = distance_beyond_range(c); excess > 0) skipped_->push_back({cell, excess});
    else add_interior_point(c, cell, close);
    return;
  }
  const auto children = children_of(c);
  for (int i = 0; i < 4; ++i) subdivide_to_cells(children[i], depth + 1, 4 * cell + i, close);
}

// Makes one interior point of the overlap of a cell.
void TriangleSubdivision::add_interior_point(const Corners& c, int cell, const std::vector<int>& near) {
  Sum own;
  integrate(c, sample_depth_, overlaps_at(c, near), near, own);
  // A strip along the boundary that overlaps within the tolerance alone makes no point.
  const double strip = on_line_ * size_ / (1 << sample_depth_);
  if (!(own.area > 8 * strip) || !(own.normal.norm() > distance_tolerance_relative * own.area)) return;
  out_->push_back({triangle_, own.inside / own.area, object_, own.normal.normalized(), own.area, cell, region_ ? region_->region_pair() : -1});
  facets_->facets.push_back({triangle_, own.seed_triangle, own.area, own.distance / own.area});
}

void TriangleSubdivision::integrate(const Corners& c, int depth, const CornerOverlaps& overlaps, const std::vector<int>& near, Sum& sum) {
  if (overlaps.count() == 3) return add(c, depth, overlaps, sum);
  if (overlaps.count() == 0 && cannot_overlap(overlaps, size_ / (1 << depth))) return;
  if (depth == last_depth_) {
    if (clip(c, overlaps, near, sum)) return;
    // Corners may lie on the overlap boundary itself; points inside show which fraction overlaps.
    const Vec3 centre = (c[0] + c[1] + c[2]) / 3;
    const Corners inner = {(c[0] + centre) / 2, (c[1] + centre) / 2, (c[2] + centre) / 2};
    return add(inner, depth, overlaps_at(inner, near), sum);
  }
  const Corners midpoints = midpoints_of(c);
  const auto children = children_of(c, midpoints);
  const auto child_overlaps = children_of(overlaps.at, overlaps_at(midpoints, near).at);
  for (int i = 0; i < 4; ++i)
    if (const std::vector<int> close = triangles_near(children[i], near); !close.empty()) integrate(children[i], depth + 1, {child_overlaps[i]}, close, sum);
}

// Adds the overlap of a clipped subtriangle. Returns false if its overlap boundary is no set of lines:
// where the opposite surface ends at twice the range.
bool TriangleSubdivision::clip(const Corners& c, const CornerOverlaps& overlaps, const std::vector<int>& near, Sum& sum) {
  lines_.clear();
  for (int i = 0; i < 3; ++i) {
    if (!overlaps.at[i].visible) return false;
    if (!overlaps.at[i].overlaps) add_clip_lines(mesh_, lagged_, region_, overlaps.at[i].seed_triangle, position(c[i]), lines_);
  }
  if (lines_.empty() || lines_.size() > clip_lines_max) return false;
  // Ties: corners on the boundary lie inside. Of two triangles that meet in a line of the boundary, the
  // inner one overlaps as a whole, and the outer one has a strip, whose outer edge is the boundary.
  for (ClipLine& line : lines_) line.at += on_line_ * line.outward;
  for (const ClipPolygon& polygon : clip_by_lines(lagged_.x(), mesh_.triangles[triangle_], c, lines_)) {
    const Vec3 first = position(polygon[0].inside);
    double area = 0;
    Vec3 middle = Vec3::Zero(), mean = Vec3::Zero();
    for (const ClipCorner& corner : polygon) mean += corner.inside / static_cast<double>(polygon.size());
    for (size_t i = 1; i + 1 < polygon.size(); ++i) {
      const double area_of_part = (position(polygon[i].inside) - first).cross(position(polygon[i + 1].inside) - first).norm() / 2;
      area += area_of_part;
      middle += area_of_part / 3 * (polygon[0].inside + polygon[i].inside + polygon[i + 1].inside);
    }
    const Vec3 inside = area > 4 * on_line_ * on_line_ ? Vec3(middle / area) : mean;
    const PointOverlap centre_overlap = overlap_at(inside, near);
    if (!centre_overlap.overlaps) continue;
    add(area * lagged_.cosine(triangle_, centre_overlap.normal), inside, centre_overlap, sum);
    add_boundary_edges(polygon);
  }
  return true;
}

// Adds the boundary edges of a polygon. Polygons on both sides of a line cancel each other's edges.
void TriangleSubdivision::add_boundary_edges(const ClipPolygon& polygon) {
  for (size_t i = 0; i < polygon.size(); ++i) {
    if (polygon[i].line < 0) continue;
    const ClipLine& line = lines_[polygon[i].line];
    const Vec3 &a = polygon[i].inside, &b = polygon[(i + 1) % polygon.size()].inside;
    const Vec3 along = position(b) - position(a);
    const double length = along.cross(lagged_.normal(line.triangle)).norm();
    facets_->boundary_edges.push_back({triangle_, (a + b) / 2, line.triangle, line.side, polygon[i].outside ? -length : length});
  }
}

void TriangleSubdivision::add(double area, const Vec3& inside, const PointOverlap& overlap, Sum& sum) const {
  sum.area += area;
  sum.distance += area * overlap.distance;
  sum.inside += area * inside;
  sum.normal += area * overlap.normal;
  if (sum.seed_triangle < 0) sum.seed_triangle = overlap.seed_triangle;
}

// Adds a subtriangle: the fraction of its points that overlap is the fraction of its area.
void TriangleSubdivision::add(const Corners& points, int depth, const CornerOverlaps& overlaps, Sum& sum) const {
  if (overlaps.count() == 0) return;
  PointOverlap mean;
  Vec3 inside = Vec3::Zero();
  for (int i = 0; i < 3; ++i) {
    if (!overlaps.at[i].overlaps) continue;
    inside += points[i] / overlaps.count();
    mean.normal += overlaps.at[i].normal;
    mean.distance += overlaps.at[i].distance / overlaps.count();
    mean.seed_triangle = overlaps.at[i].seed_triangle;
  }
  const double cosine = lagged_.cosine(triangle_, mean.normal.normalized());
  add(lagged_.area(triangle_) / std::pow(4.0, depth) * overlaps.count() / 3 * cosine, inside, mean, sum);
}

}  // namespace tack
