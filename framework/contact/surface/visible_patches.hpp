// Visible patches: the triangles of a surface that face a point, and that the surface at the point
// faces, grouped into patches of similar normals. A point in a corner sees two or three patches. A
// point of a thin body sees neither the far side of its own body nor anything behind it.
//
// A triangle is front-facing if the point lies on the side of its outward normal; a sheet has two
// sides, and turns to the point. On the point's own object, the height over the triangle must also
// be a minimum fraction of the distance: neighbours on a slightly hollow surface are not opposite.
// Positions are those at the start of the step (lagged_surface.hpp).
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "framework/contact/surface/lagged_surface.hpp"
#include "framework/contact/surface/surface_region.hpp"

namespace tack {

// A patch of triangles. Its seed triangle is the nearest one.
struct VisiblePatch {
  Vec3 normal;             // unit, of the seed triangle, towards the point
  double area;             // projected area of the point towards the seed triangle [m^2]
  double distance;         // from the point to the seed triangle [m]
  double area_per_vertex;  // of the mesh at the seed triangle [m^2]
  // Distance of the point past a crease or the boundary of the patch, in its plane [m]; 0: none.
  double overshoot;
  int seed_triangle;
};

struct VisiblePatches {
  static constexpr int count_max = 3;
  int count = 0;
  std::array<VisiblePatch, count_max> patches;

  // Returns the index of the first patch of triangles with this normal towards the point; -1: none.
  int patch_of(const Vec3& normal) const;
};

// The point for which patches are found.
struct QueryPoint {
  Vec3 position;
  int object;   // of the point
  double area;  // tributary area [m^2]
  int vertex;   // global; -1: a point inside `triangle`
  int triangle;
};

class PatchFinder {
 public:
  PatchFinder(const CollisionMesh& mesh, const LaggedSurface& lagged)
      : mesh_(mesh), lagged_(lagged) {}

  // Restricts visibility to a region, which ends at its interfaces; null: the whole surface.
  void restrict_to(const SurfaceRegion* region) { region_ = region; }

  QueryPoint at_vertex(int vertex_index) const;
  // Returns the point x [m] inside a triangle, with a tributary area [m^2].
  QueryPoint inside_triangle(int triangle, const Vec3& x, double area) const;

  // Returns the patches of triangles of one object: triangle(i) for i in [0, n).
  template <class TriangleAt>
  VisiblePatches find(const QueryPoint& from, int n, const TriangleAt& triangle) {
    facing_.clear();
    for (int i = 0; i < n; ++i) add_if_facing(from, triangle(i));
    return group_by_normal();
  }
  // Returns the patches of the triangles that are nearer than distance_max [m].
  VisiblePatches find_within(const QueryPoint& from, const std::vector<int>& triangles,
                             double distance_max) {
    facing_.clear();
    for (const int t : triangles) add_if_facing(from, t, distance_max * distance_max);
    return group_by_normal();
  }
  // Returns the index of the patch that a triangle belongs to; -1: none.
  int patch_of(const QueryPoint& from, const VisiblePatches& visible, int triangle) const;

 private:
  struct FacingTriangle {
    Vec3 normal;
    double area, squared;
    double in_plane;  // distance from the point in the plane of the triangle [m]
    bool continues;   // whether the surface goes on beyond the closest point
    int triangle;
  };
  // Sets the normal of a triangle towards the point, and the height of the point over it [m].
  // Returns false if the triangle does not face the point.
  bool normal_towards(const QueryPoint& from, int triangle, Vec3& normal, double& height) const;
  double area_towards(const QueryPoint& from, const Vec3& normal) const;
  bool well_in_front(const QueryPoint& from, int triangle, double height, double squared) const;
  // Adds a triangle that faces the point within a squared distance [m^2].
  void add_if_facing(const QueryPoint& from, int triangle,
                     double squared_max = std::numeric_limits<double>::infinity());
  VisiblePatches group_by_normal();

  const CollisionMesh& mesh_;
  const LaggedSurface& lagged_;
  const SurfaceRegion* region_ = nullptr;
  std::vector<FacingTriangle> facing_;
};

}  // namespace tack
