// Overlap of two surfaces at the start of a step: the part of a surface that lies opposite another
// object.
//
// A triangle overlaps as a whole if each of its corners sees a patch of the other surface that the
// triangle faces, and does not lie past the boundary of that patch (a crease or the boundary of a
// sheet). Such triangles give a third of their area to each corner, if they are small or the gap is
// uniform. Other triangles are subdivided into subtriangles (cells) and clipped along the boundary
// (polygon_clip.hpp), and their overlap is represented by interior quadrature points. Result: the
// adhering area is the area of overlap for any pair of meshes, and a surface that only comes near a
// boundary from the side does not count.
//
// Regions: where laws differ between regions of the surfaces (pair_table.hpp), overlaps are found
// region by region, unless one law holds for the whole triangle and the tributary areas of its
// corners.
//
// Deferred subdivision: triangles out of range at the start of the step exert no force then, and
// most of them none in the whole step. They are subdivided, with the geometry of the start, only
// when they may have come within range. Single cells of a triangle are deferred in this way as
// well.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "framework/contact/area_integral/nearby_lists.hpp"
#include "framework/contact/area_integral/overlap_facets.hpp"
#include "framework/contact/surface/surface_region.hpp"
#include "framework/contact/area_integral/vertex_quadrature.hpp"
#include "geometry/broad_phase/broad_phase.hpp"

namespace tack {

class TriangleSubdivision;

// Interior quadrature point of a triangle.
struct InteriorPoint {
  int triangle;
  Vec3 inside;      // barycentric coordinates
  int object;       // opposite object
  Vec3 normal;      // unit, of the opposite surface, towards the point
  double area;      // overlap of the cell, projected along that normal [m^2]
  int cell;         // cell of the triangle (triangle_subdivision.hpp)
  int region_pair;  // the opposite region (PairTable::region_pair)
};

class SurfaceOverlap {
 public:
  SurfaceOverlap(const ContactSurface& surface, const PairTable& pairs,
                 const IntegrationRules& rules, const LaggedSurface& lagged);

  // Chooses the secondary sides of the pairs that choose them by overlap.
  void choose_sides(const std::vector<GroupPatches>& groups, IntegrationSides& sides) const;
  // Sets the areas of the patches to overlap areas, for the pairs that integrate over their
  // overlap, and makes their interior points.
  void evaluate(const IntegrationSides& sides, const BroadPhase& broad_phase,
                std::vector<GroupPatches>& groups);

  // Subdivides the deferred triangles that may be within range at x. Returns the indices of their
  // interior points, ascending; other points keep their order.
  std::vector<int> subdivide_approached(const VecX& x);

  // Appends, ascending, the triangles of other objects that may come within range of a triangle:
  // for those that were subdivided or deferred, the list of evaluate() if it is still that of the
  // broad phase.
  void others_near(int triangle, const BroadPhase& broad_phase, std::vector<int>& out) const;

  // Sorted by object, opposite object, triangle, cell and region.
  const std::vector<InteriorPoint>& interior_points() const { return interior_points_; }
  // Overlap facets of each pair of objects that has any.
  const std::vector<OverlapFacets>& facets() const { return facets_; }
  // Returns whether any pair of objects integrates over its overlap.
  bool needed() const { return needed_; }
  // Returns the projected tributary area of a vertex from triangles whose overlap with an object is
  // unknown: those farther than twice the range at the start of the step. The overlap of all other
  // triangles already belongs to points of the start of the step.
  double unknown_area(int vertex_index, int object, const Vec3& normal) const;
  // Returns whether patches of object b at vertices of object a have overlap areas.
  bool uses_overlap(int a, int b, const IntegrationSides& sides) const;

 private:
  struct Corner {
    int group, patch;  // indices of the group, and of the patch that the triangle faces most
  };
  // A deferred triangle, or a cell of it, with the triangles of an object within twice the range,
  // all of which are out of range. Triangles beyond twice the range exceed the range by at least
  // the range.
  struct DeferredCell {
    int triangle, object;
    int depth, cell;       // triangle_subdivision.hpp
    int begin, end;        // into nearby_triangles_
    double excess;         // distance beyond the range [m]
    int region_pair = -1;  // the opposite region, if it is a cell
  };
  // The deferred triangles of object a towards object b.
  struct DeferredPair {
    int a, b, begin, end;  // into deferred_
    double excess;         // smallest distance beyond the range [m]
  };
  // Triangles of one object within twice the range of a triangle.
  struct NearbyTriangles {
    std::vector<int> triangles;
    double nearest;  // m
    bool parallel;   // whether all triangles that it may face are parallel to it
    bool faced;      // whether it may face any of them
  };
  // The triangles of an object that a triangle faces, restricted to a region with one law; without
  // a region all that it faces.
  struct FacedRegion {
    std::optional<SurfaceRegion> region;
    std::vector<int> triangles;
    const SurfaceRegion* region_or_null() const { return region ? &*region : nullptr; }
    int region_pair() const { return region ? region->region_pair() : -1; }
  };
  // Triangles of object a whose overlap with object b is known.
  struct KnownPair {
    int a, b;
    std::vector<int> triangles;  // ascending
  };
  struct Result;
  struct OppositeObject;
  struct TriangleChunk;
  class Displacements;
  std::array<Corner, 3> corners(const PatchesByVertex& groups, int triangle, int object) const;
  bool overlaps_fully(const PatchesByVertex& groups, int triangle,
                      const std::array<Corner, 3>& corners) const;
  bool ends_there(const PatchesByVertex& groups, const Corner& corner, double overshoot_max) const;
  bool has_uniform_gap(int triangle, const std::array<Corner, 3>& at, const PatchesByVertex& groups,
                       double range) const;
  bool has_one_law(const PatchesByVertex& groups, int triangle, int object,
                   const std::array<Corner, 3>& at) const;
  bool may_face(int triangle, int other) const;
  // Returns the ordered pairs of objects that use overlap areas and may be near, ascending.
  std::vector<std::array<int, 2>> near_objects(const IntegrationSides& sides,
                                               const std::vector<Aabb>& boxes) const;
  std::vector<Aabb> object_boxes() const;
  NearbyLists evaluate_chunk(const TriangleChunk& chunk, const BroadPhase& broad_phase,
                             const PatchesByVertex& groups) const;
  NearbyTriangles find_nearby(int triangle, int object, const std::vector<int>& near) const;
  void subdivide_or_defer(int triangle, int object, const NearbyTriangles& nearby,
                          TriangleSubdivision& subdivision, Result& found) const;
  std::vector<int> facing(int triangle, std::span<const int> others) const;
  std::vector<FacedRegion> faced_regions(int triangle, int object,
                                         std::span<const int> others) const;
  std::vector<int> subdivide(const std::vector<int>& indices_of_cells);
  void add_deferred(int a, int b, std::span<const DeferredCell> some,
                    const std::vector<int>& nearby);
  std::vector<int> insert(std::vector<InteriorPoint>& added);
  void add_full_triangle(int triangle, double range_twice, bool bonds,
                         const std::array<Corner, 3>& at, const PatchesByVertex& groups,
                         Result& found) const;

  const ContactSurface& surface_;
  const PairTable& pairs_;
  const IntegrationRules& rules_;
  const LaggedSurface& lagged_;
  std::vector<int> first_triangle_;  // of each object, and the end
  bool needed_;
  std::vector<InteriorPoint> interior_points_;
  std::vector<OverlapFacets> facets_;
  std::vector<KnownPair> known_;  // by pair
  std::vector<DeferredPair> deferred_pairs_;
  std::vector<DeferredCell> deferred_;
  std::vector<int> nearby_triangles_;  // of the deferred cells
  NearbyLists nearby_lists_;           // of triangles that were subdivided or deferred
  int builds_of_lists_ = -1;           // BroadPhase::builds() of the lists
};

}  // namespace tack
