// View of a point on a surface: the triangles of another surface, or of its own, that face the
// point and that the point faces, grouped into patches of similar normals. A point in a corner sees
// two or three patches; a point of a thin body sees neither its own far side nor anything through
// it.
//
// A triangle faces a point that is in front of it, by its outward normal (a sheet turns the side to
// it on which the point is). On the point's own object the point has to be well in front:
// neighbours on a slightly hollow surface are not opposite. The surfaces are those at the start of
// the step (lagged_surface.hpp).
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "framework/contact/lagged_surface.hpp"
#include "framework/contact/surface_region.hpp"

namespace tack {

// One piece, led by its nearest triangle.
struct SeenPiece {
  Vec3 normal;      // unit, of that triangle, towards the point
  double area;      // of the point, towards it [m^2]
  double distance;  // m
  double cell;      // area per vertex of what is seen, there [m^2]
  // How far the point lies beyond a crease or the boundary of the surface [m]; 0: above it.
  double beyond;
  int triangle;     // that one
};

struct FacingView {
  static constexpr int most = 3;
  int count = 0;
  std::array<SeenPiece, most> pieces;

  // Returns the first patch that a triangle with this normal towards the point belongs to; -1:
  // none.
  int piece_of(const Vec3& normal) const;
};

// The point that looks.
struct Viewpoint {
  Vec3 position;
  int object;    // that it is on
  double whole;  // area that it stands for [m^2]
  int vertex;    // global; -1: a point inside `triangle`
  int triangle;
};

class FacingViewer {
 public:
  FacingViewer(const CollisionMesh& mesh, const LaggedSurface& held) : mesh_(mesh), held_(held) {}

  // Restricts the view to a region, which ends at its interfaces; null: the whole surface.
  void look_at(const SurfaceRegion* region) { region_ = region; }

  Viewpoint vertex_view(int vertex_index) const;
  // One of position x inside a triangle, which stands for the given area.
  Viewpoint inner_view(int triangle, const Vec3& x, double area) const;

  // triangle(i), i in [0, n): those that may be near, of one object.
  template <class TriangleAt>
  FacingView look(const Viewpoint& from, int n, const TriangleAt& triangle) {
    seen_.clear();
    for (int i = 0; i < n; ++i) consider(from, triangle(i));
    return pieces();
  }
  // The same with only what is nearer than `reach` in view [m].
  FacingView look_within(const Viewpoint& from, const std::vector<int>& triangles, double reach) {
    seen_.clear();
    for (const int t : triangles) consider(from, t, reach * reach);
    return pieces();
  }
  // The piece of the view that a triangle belongs to; -1: none.
  int piece_of(const Viewpoint& from, const FacingView& view, int triangle) const;

 private:
  struct Seen {
    Vec3 normal;
    double area, squared, beyond;
    int triangle;
  };
  // Its normal towards the point; false if it does not face it.
  bool turn(const Viewpoint& from, int triangle, Vec3& normal, double& height) const;
  double area_towards(const Viewpoint& from, const Vec3& normal) const;
  bool well_in_front(const Viewpoint& from, int triangle, double height, double squared) const;
  // nearer: than that [m^2].
  void consider(const Viewpoint& from, int triangle,
                double nearer = std::numeric_limits<double>::infinity());
  FacingView pieces();

  const CollisionMesh& mesh_;
  const LaggedSurface& held_;
  const SurfaceRegion* region_ = nullptr;
  std::vector<Seen> seen_;
};

}  // namespace tack
