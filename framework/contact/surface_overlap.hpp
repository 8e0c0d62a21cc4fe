// Overlap of two surfaces at the start of a step: the part of a surface that lies opposite another
// object.
//
// A triangle overlaps as a whole if each of its corners sees a patch of the other surface that the
// triangle faces, and does not lie past that patch's boundary (a crease or the boundary of a
// sheet). Such triangles give a third of their area to each corner, if they are small or the gap is
// uniform. Other triangles are subdivided and clipped along the boundary (polygon_clip.hpp), and
// their overlap is represented by interior quadrature points (samples). Result: the adhering area
// is the area of overlap for any pair of meshes, and a surface that only comes near a boundary from
// the side does not count.
//
// Regions: where laws differ between regions of the surfaces (pair_table.hpp), overlaps are taken
// region by region, unless one law holds for the whole triangle and the tributary areas of its
// corners.
//
// Deferred subdivision: triangles out of range at the start of the step exert no force then, and
// most of them none in the whole step. They are subdivided, with the geometry of the start, only
// when they may have come within range; so is each of their cells that one sample represents.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "framework/contact/overlap_facets.hpp"
#include "framework/contact/surface_region.hpp"
#include "framework/contact/point_pieces.hpp"
#include "geometry/broad_phase/broad_phase.hpp"

namespace tack {

class TriangleDivision;

// A quadrature point inside a triangle.
struct ContactSample {
  int triangle;
  Vec3 inside;      // its barycentric coordinates
  int object;       // opposite
  Vec3 normal;      // unit, of the opposite surface, towards the point
  double area;      // projected along that normal [m^2]
  int cell;         // the cell of the triangle that it represents
  int region_pair;  // the opposite region (PairTable::region_pair)
};

class SurfaceOverlap {
 public:
  SurfaceOverlap(const ContactSurface& surface, const PairTable& pairs, const LaggedSurface& held);

  // Sums up overlap area and points of each side, for the pairs that choose their side by it.
  void capture(const std::vector<GroupView>& views, IntegrationSides& sides) const;
  // Sets the areas of the views to overlap areas, for the pairs that want it, and makes their
  // samples.
  void weigh(const IntegrationSides& sides, const BroadPhase& broad_phase,
             std::vector<GroupView>& views);

  // Subdivides the deferred triangles that may be within range at x. Returns the indices of their
  // samples, ascending; other samples keep their order.
  std::vector<int> approach(const VecX& x);

  // Sorted by object, opposite object, triangle, cell and region.
  const std::vector<ContactSample>& samples() const { return samples_; }
  // Overlap facets of each pair of objects that has any.
  const std::vector<OverlapFacets>& parts() const { return parts_; }
  // Returns whether any pair of objects wants overlap areas.
  bool wanted() const { return wanted_; }
  // Returns the projected tributary area of a vertex from triangles whose overlap with an object is
  // not known: those farther than twice the range at the start of the step. Overlap of the other
  // triangles belongs to points of the start of the step already.
  double unknown_area(int vertex_index, int object, const Vec3& normal) const;
  // Returns whether views of object b by vertices of object a have overlap areas.
  bool weighs(int a, int b, const IntegrationSides& sides) const;

 private:
  struct Corner {
    int view, piece;  // the patch that the triangle faces most
  };
  // A deferred triangle, or a cell of it, with the triangles of an object within twice the range,
  // all of which are out of range. Triangles beyond twice the range stay out of it by the range at
  // least.
  struct Waiting {
    int triangle, object;
    int depth, cell;       // triangle_division.hpp
    int begin, end;        // into around_
    double away;           // distance beyond the range [m]
    int region_pair = -1;  // the opposite region, if it is a cell
  };
  // The deferred triangles of object a towards object b.
  struct WaitingPair {
    int a, b, begin, end;  // into waiting_
    double away;           // smallest distance beyond the range [m]
  };
  // Triangles of one object within twice the range of a triangle.
  struct Around {
    std::vector<int> triangles;
    double nearest;  // m
    bool parallel;   // whether all that it may face are parallel to it
    bool faced;      // whether it may face any
  };
  // The triangles of an object that a triangle faces, and the region between which the same laws
  // hold; no region: all that it faces.
  struct FacedRegion {
    std::optional<SurfaceRegion> region;
    std::vector<int> triangles;
    const SurfaceRegion* seen() const { return region ? &*region : nullptr; }
    int region_pair() const { return region ? region->region_pair() : -1; }
  };
  // Triangles of object a whose overlap with object b is known.
  struct KnownPair {
    int a, b;
    std::vector<int> triangles;  // ascending
  };
  struct Found;
  struct Opposite;
  struct Chunk;
  class Moves;
  std::array<Corner, 3> corners(const std::vector<GroupView>& views, int triangle,
                                int object) const;
  bool covered(const std::vector<GroupView>& views, int triangle,
               const std::array<Corner, 3>& corners) const;
  bool even_gap(int triangle, const std::array<Corner, 3>& at, const std::vector<GroupView>& views,
                double range) const;
  bool one_law(const std::vector<GroupView>& views, int triangle, int object,
               const std::array<Corner, 3>& at) const;
  bool may_face(int triangle, int other) const;
  // Returns ordered pairs of objects that want weights, integrate and may be near, ascending.
  std::vector<std::array<int, 2>> near_objects(const IntegrationSides& sides,
                                               const std::vector<Aabb>& boxes) const;
  std::vector<Aabb> object_boxes() const;
  void weigh_chunk(const Chunk& chunk, const BroadPhase& broad_phase,
                   const std::vector<GroupView>& views) const;
  Around find_around(int triangle, int object, const std::vector<int>& near) const;
  void divide_or_wait(int triangle, int object, const Around& around, TriangleDivision& division,
                      Found& found) const;
  std::vector<int> facing(int triangle, std::span<const int> others) const;
  std::vector<FacedRegion> faced_regions(int triangle, int object,
                                         std::span<const int> others) const;
  std::vector<int> divide(const std::vector<int>& numbers);
  void add_waiting(int a, int b, std::span<const Waiting> some, const std::vector<int>& around);
  std::vector<int> insert(std::vector<ContactSample>& added);
  void take_covered(int triangle, double reach, bool bonds, const std::array<Corner, 3>& at,
                    const std::vector<GroupView>& views, Found& found) const;

  const ContactSurface& surface_;
  const PairTable& pairs_;
  const LaggedSurface& held_;
  std::vector<int> first_triangle_;  // of each object, and the end
  bool wanted_;
  std::vector<ContactSample> samples_;
  std::vector<OverlapFacets> parts_;
  std::vector<KnownPair> known_;  // by pair
  std::vector<WaitingPair> waiting_pairs_;
  std::vector<Waiting> waiting_;
  std::vector<int> around_;  // triangles
};

}  // namespace tack
