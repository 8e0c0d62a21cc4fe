// The surfaces as a time step finds them, held for that step, so that its potential is one function: where
// the vertices are, and the unit normals and areas of the triangles. What is said of orientation does not
// change while bodies only translate, so nothing is gained or lost on a closed way.
//
// The area that a vertex stands for towards a surface of unit normal n is a third of the present area of each
// of its triangles, projected onto that surface,
//     w = sum_T A_T/3 max(0, -n_T . n),
// with |n_T . n| on sheets, which have two sides. So the side walls of a plate, or its back, do not count when
// its face meets another face, and a stated traction is one per area as it is now, not as it was at rest:
// that area is the same for both sides.
//
// A rod stands for its present length times its width as that surface sees it, w = sum_E width l_E/2 |t_E x n| with the
// unit tangents t_E, and at its ends for pi/4 width^2 |t_E . n| more; a particle for its cross-section, w = pi r^2. Thin
// is what a vertex has of the two.
#pragma once

#include "framework/contact/surface_topology.hpp"

namespace tack {

// Between a triangle and what it faces.
inline constexpr double least_cosine = 0.1;

// Height over distance, from which on a point is in front of a face of its own object: neighbours on a slightly hollow surface are no other side.
inline constexpr double own_front = 0.15;

// Relative: faces that meet in the closest point have that in common.
inline constexpr double same_distance = 1e-6;

class HeldSurface {
 public:
  // The mesh must outlive this.
  explicit HeldSurface(const ContactSurface& surface)
      : mesh_(surface.mesh), rod_width_(surface.rod_width), topology_(surface) {}

  void hold(const VecX& x);
  bool held() const { return x_.size() > 0; }

  const VecX& x() const { return x_; }  // 3n [m]
  const Vec3& normal(int triangle) const { return normals_[triangle]; }  // zero without area
  double area(int triangle) const { return areas_[triangle]; }           // m^2
  const SurfaceTopology& topology() const { return topology_; }
  double rod_width(int object) const { return rod_width_[object]; }  // m

  double whole(int vertex_index) const;  // a third of the area around it [m^2]
  double thin(int vertex_index) const;                 // of rods and particles, from where it is largest [m^2]
  double thin(int vertex_index, const Vec3& n) const;  // likewise, towards a surface of unit normal n [m^2]
  // The area per vertex in a mesh of such triangles [m^2]; at a vertex the mean of those that face a surface of normal n.
  double cell(int triangle) const { return 2 * areas_[triangle]; }
  double cell(int vertex_index, const Vec3& n) const;
  double cosine(int triangle, const Vec3& n) const;  // -n_T . n, or |n_T . n| on sheets

 private:
  const CollisionMesh& mesh_;
  const std::vector<double>& rod_width_;  // per object
  SurfaceTopology topology_;
  VecX x_;
  std::vector<Vec3> normals_;
  std::vector<double> areas_;
};

}  // namespace tack
