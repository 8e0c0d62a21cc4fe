// Subdivision of a triangle that overlaps in part. Subtriangles are divided until they overlap as a
// whole, do not overlap, or are small; small ones are clipped along the overlap boundary
// (polygon_clip.hpp). The overlap of each cell (subtriangle of a given depth) becomes one interior
// quadrature point (surface_overlap.hpp). Only surfaces within twice the range count. Cells whose
// surroundings are out of range are skipped.
#pragma once

#include <span>
#include <vector>

#include "framework/contact/area_integral/surface_overlap.hpp"
#include "framework/contact/surface/visible_patches.hpp"
#include "framework/contact/area_integral/polygon_clip.hpp"

namespace tack {

class TriangleSubdivision {
 public:
  TriangleSubdivision(const CollisionMesh& mesh, const LaggedSurface& lagged)
      : mesh_(mesh), lagged_(lagged), finder_(mesh, lagged) {}

  // A cell whose nearby triangles are all out of range.
  struct SkippedCell {
    int cell;
    double excess;  // smallest distance of a nearby triangle, less the range [m]
  };
  static constexpr int all = -1;  // all cells of a triangle
  // Returns the depth, the number of divisions into four, at which the cells of a triangle of this
  // area [m^2] have at most this size [m].
  static int depth_of(double area, double size);
  // Returns the distance from an overlap boundary within which points of a triangle of this area
  // [m^2] lie on it and count as overlapping, so that round-off decides nothing [m].
  static double line_tolerance(double area);
  struct Request {
    int triangle, object;
    double range;  // of the law [m]
    int depth;     // of cells
  };
  // Subdivides a triangle. facing: the triangles of the object, or of its region, that it may face.
  // region: null: the whole object. nearby: the triangles that interior points may act on; cells
  // out of their range are appended to `skipped`. Empty: no cell is skipped.
  void subdivide(const Request& request, const std::vector<int>& facing,
                 const SurfaceRegion* region, std::span<const int> nearby,
                 std::vector<InteriorPoint>& out, OverlapFacets& facets,
                 std::vector<SkippedCell>& skipped);
  // Makes the interior point of a cell that was skipped.
  void subdivide_cell(const Request& request, int cell, const std::vector<int>& facing,
                      const SurfaceRegion* region, std::vector<InteriorPoint>& out,
                      OverlapFacets& facets);

 private:
  using Corners = std::array<Vec3, 3>;  // barycentric coordinates
  struct PointOverlap {
    bool visible = false, overlaps = false;
    double overshoot = 0, distance = 0;
    int seed_triangle = -1;
    Vec3 normal = Vec3::Zero();
  };
  struct CornerOverlaps {
    std::array<PointOverlap, 3> at;
    int count() const { return at[0].overlaps + at[1].overlaps + at[2].overlaps; }
  };
  struct Sum {
    double area = 0, distance = 0;  // m^2, and distance times area [m^3]
    Vec3 inside = Vec3::Zero(), normal = Vec3::Zero();
    int seed_triangle = -1;
  };

  Vec3 position(const Vec3& inside) const;
  PointOverlap overlap_at(const Vec3& inside, const std::vector<int>& near);
  CornerOverlaps overlaps_at(const Corners& points, const std::vector<int>& near);
  void begin(const Request& request, const SurfaceRegion* region, std::vector<InteriorPoint>& out,
             OverlapFacets& facets);
  std::vector<int> triangles_near(const Corners& c, const std::vector<int>& near) const;
  double distance_beyond_range(const Corners& c) const;
  bool cannot_overlap(const CornerOverlaps& overlaps, double size) const;
  void subdivide_to_cells(const Corners& c, int depth, int cell, const std::vector<int>& near);
  void add_interior_point(const Corners& c, int cell, const std::vector<int>& near);
  void integrate(const Corners& c, int depth, const CornerOverlaps& overlaps,
                 const std::vector<int>& near, Sum& sum);
  bool clip(const Corners& c, const CornerOverlaps& overlaps, const std::vector<int>& near,
            Sum& sum);
  void add(const Corners& points, int depth, const CornerOverlaps& overlaps, Sum& sum) const;
  void add(double area, const Vec3& inside, const PointOverlap& overlap, Sum& sum) const;
  void add_boundary_edges(const ClipPolygon& face);

  const CollisionMesh& mesh_;
  const LaggedSurface& lagged_;
  PatchFinder finder_;
  const SurfaceRegion* region_ = nullptr;
  int triangle_ = 0, object_ = 0, sample_depth_ = 0, last_depth_ = 0;
  double range_ = 0, range_twice_ = 0, size_ = 0, on_line_ = 0;  // m
  std::vector<InteriorPoint>* out_ = nullptr;
  OverlapFacets* facets_ = nullptr;
  std::span<const int> nearby_;
  std::vector<SkippedCell>* skipped_ = nullptr;
  std::vector<ClipLine> lines_;
};

}  // namespace tack
