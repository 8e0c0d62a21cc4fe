// The area that a surface vertex stands for when it faces another surface in a given direction: a
// third of the rest area of each incident triangle, projected onto that direction,
//     w = sum_T A_T/3 max(0, -n_T . u),    u: unit vector from the other surface's closest point,
// with |n_T . u| on open sheets, which have two sides. Side walls of a plate, or its back, do not
// count when its face meets another face; without this, the pressure along edges would be too large.
// A small part of the whole area is always kept, so that every vertex repels.
#pragma once

#include <vector>

#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

class FacingArea {
 public:
  // closed: per object, whether its surface encloses a volume. whole_area: per global vertex, for
  // vertices of no triangle (rods, particles) and the part that is always kept [m^2].
  FacingArea(const CollisionMesh& mesh, std::vector<char> closed, std::vector<double> whole_area,
             const VecX& rest);

  // u need not be normalised; the normals are those of x.
  double operator()(const VecX& x, int vertex_index, const Vec3& u) const;
  double whole(int vertex_index) const { return whole_area_[vertex_index]; }

 private:
  std::vector<Triangle> triangles_;
  std::vector<double> third_of_area_;  // per triangle, at rest [m^2]
  std::vector<int> start_, incident_;  // triangles at each global vertex
  std::vector<char> two_sided_;        // per global vertex
  std::vector<double> whole_area_;
};

}  // namespace tack
