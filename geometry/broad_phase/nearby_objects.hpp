// Nearby objects of a rigid group: the objects whose AABBs overlap the AABB of the group. Most
// primitives of a body overlap none of these AABBs and need no search of their own.
#pragma once

#include <vector>

#include "geometry/broad_phase/aabb.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

class NearbyObjects {
 public:
  // The mesh must outlive this object.
  explicit NearbyObjects(const CollisionMesh& mesh);

  // Sets the AABBs: the union of vertex_boxes (per global vertex), inflated by the radius of each
  // object [m].
  void find(const std::vector<Aabb>& vertex_boxes, const std::vector<double>& radius);
  // Returns whether an object outside the rigid group (>= 0) may overlap the box.
  bool near(int rigid_group, const Aabb& box) const {
    for (const int object : near_[rigid_group])
      if (boxes_[object].overlaps(box)) return true;
    return false;
  }

 private:
  const CollisionMesh& mesh_;
  std::vector<int> group_of_object_;  // the rigid group of all its surface vertices, or -1
  std::vector<Aabb> boxes_;           // per object
  // Per rigid group: objects outside it whose AABBs overlap its own.
  std::vector<std::vector<int>> near_;
};

}  // namespace tack
