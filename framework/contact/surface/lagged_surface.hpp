// Lagged surface: vertex positions, unit normals n_T and areas A_T of the triangles at the start of
// the time step, constant through the step, so that the potential of the step is one function.
// Orientation does not change while bodies only translate, so that no energy is gained or lost on a
// closed path.
//
// The tributary area of a vertex towards a surface of unit normal n is the projection of a third of
// the present area of each of its triangles,
//     w = sum_T A_T/3 max(0, -n_T . n),
// with |n_T . n| on sheets, which have two sides. So side walls of a plate, or its back, do not
// count when its face meets another face, and a stated traction is one per present area, not per
// rest area; that area is equal for both sides.
//
// Codimensional elements: a rod has its present length times its width as seen from that surface,
//     w = sum_E width l_E/2 |t_E x n|   with unit tangents t_E,
// and pi/4 width^2 |t_E . n| more at each end; a particle has its cross-section, w = pi r^2.
#pragma once

#include "framework/contact/surface/surface_topology.hpp"

namespace tack {

// Least cosine between a triangle and the surface that it faces.
inline constexpr double facing_cosine_min = 0.1;

// Least height over distance for which a point is in front of a triangle of its own object:
// neighbours on a slightly hollow surface are not opposite.
inline constexpr double self_height_per_distance_min = 0.15;

// Relative tolerance of equal distances: of triangles that meet in the closest point.
inline constexpr double distance_tolerance = 1e-6;

class LaggedSurface {
 public:
  // The mesh must outlive this.
  explicit LaggedSurface(const ContactSurface& surface)
      : mesh_(surface.mesh), rod_width_(surface.rod_width), topology_(surface) {}

  // Sets positions, normals and areas to those at x (3n) [m].
  void update(const VecX& x);
  bool is_set() const { return x_.size() > 0; }
  void clear() { x_.resize(0); }

  const VecX& x() const { return x_; }                                   // 3n [m]
  const Vec3& normal(int triangle) const { return normals_[triangle]; }  // zero without area
  double area(int triangle) const { return areas_[triangle]; }           // m^2
  const SurfaceTopology& topology() const { return topology_; }
  double rod_width(int object) const { return rod_width_[object]; }  // m

  // Tributary area: a third of the area of the incident triangles [m^2].
  double tributary_area(int vertex_index) const;
  // Tributary area of rods and particles [m^2]: its largest projection, and the projection onto a
  // surface of unit normal n.
  double codimensional_area(int vertex_index) const;
  double codimensional_area(int vertex_index, const Vec3& n) const;
  // Area per vertex of a mesh of triangles like this one [m^2]; of a vertex: the mean over incident
  // triangles that face a surface of normal n.
  double area_per_vertex(int triangle) const { return 2 * areas_[triangle]; }
  double area_per_vertex(int vertex_index, const Vec3& n) const;
  // Returns -n_T . n, or |n_T . n| on sheets.
  double cosine(int triangle, const Vec3& n) const;

 private:
  const CollisionMesh& mesh_;
  const std::vector<double>& rod_width_;  // per object
  SurfaceTopology topology_;
  VecX x_;
  std::vector<Vec3> normals_;
  std::vector<double> areas_;
};

}  // namespace tack
