// What a rigid group may meet: the boxes of the objects that come near it. Most of a body's primitives are near none of
// them and need no search of their own.
#pragma once

#include <vector>

#include "geometry/broad_phase/aabb.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

class Rivals {
 public:
  // The mesh must outlive this.
  explicit Rivals(const CollisionMesh& mesh);

  // Vertices are in these boxes (by global id), and primitives of each object reach so far beyond them [m].
  void find(const std::vector<Aabb>& vertex_boxes, const std::vector<double>& reach);
  // Whether something that is not of the group `kin` (>= 0) may overlap the box.
  bool near(int kin, const Aabb& box) const {
    for (const int object : near_[kin])
      if (boxes_[object].overlaps(box)) return true;
    return false;
  }

 private:
  const CollisionMesh& mesh_;
  std::vector<int> kin_of_;  // of each object: that of all its surface vertices, or -1
  std::vector<Aabb> boxes_;  // of each object
  std::vector<std::vector<int>> near_;  // by group: other objects whose boxes overlap its own
};

}  // namespace tack
