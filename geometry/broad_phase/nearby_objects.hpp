// Nearby objects of a rigid group: the objects whose AABBs overlap a box of the group. Most
// primitives of a body overlap none of these AABBs and need no search of their own. The AABBs are
// in a tree, so that a search takes the logarithm of their number.
#pragma once

#include <vector>

#include "geometry/broad_phase/bvh.hpp"
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
  bool near(int rigid_group, const Aabb& box) const;

 private:
  const CollisionMesh& mesh_;
  std::vector<int> number_;        // per object that has surface vertices: its index below
  std::vector<int> rigid_groups_;  // the rigid group of all surface vertices of an object, or -1
  Bvh boxes_;                      // of the objects
};

}  // namespace tack
