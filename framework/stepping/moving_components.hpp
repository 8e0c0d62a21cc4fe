// Connected components of the contact surface and their motion in a step.
//
// The relative displacement of two components is a lower bound of the displacement of any point of
// one against any point of the other: the distance between the AABBs of their displacements. If
// their sizes are similar, so that a hit may deform all of them, it is the distance between their
// mean displacements less the root mean square deviations of both, if that is larger. It is 0 for
// components that move together, or where one is carried along by the other.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "framework/world/world.hpp"
#include "geometry/broad_phase/aabb.hpp"

namespace tack {

struct MovingComponent {
  int object = 0;
  double width = 0;  // diameter of a particle [m]
  Aabb place, way;   // positions before the step; displacements in it [m]
  Vec3 mean = Vec3::Zero();  // mean displacement of its vertices [m]
  double deviation = 0;      // root mean square deviation from the mean [m]

  // Returns the longest side of its AABB; the diameter of a particle [m].
  double size() const { return (place.hi - place.lo).maxCoeff() + width; }
  // Returns the relative displacement [m]; size: of the smaller component [m].
  double displacement_against(const MovingComponent& other, double size) const {
    const double all = (other.way.lo - way.hi).cwiseMax(way.lo - other.way.hi).cwiseMax(0.0).norm(),
                 differ = deviation + other.deviation;
    return std::max(differ, std::max(this->size(), other.size()) / 2) > size
               ? all
               : std::max(all, (mean - other.mean).norm() - differ);
  }
  Aabb swept() const {
    Aabb box = place;
    box.lo += way.lo.cwiseMin(0.0);
    box.hi += way.hi.cwiseMax(0.0);
    return box;
  }
};

// Returns the smaller size of two components, but at least `least` [m].
inline double smaller_size(const MovingComponent& a, const MovingComponent& b, double least) {
  return std::max(least, std::min(a.size(), b.size()));
}

class MovingComponents {
 public:
  // The world must have contact.
  explicit MovingComponents(const World& world);

  // Sets the motion from x to y (3n).
  void move(const VecX& x, const VecX& y);
  // Returns pairs of components, first < second, ascending, that may touch, whose swept AABBs
  // overlap, and whose relative displacement exceeds `fraction` of the size of the smaller one.
  std::vector<std::array<int, 2>> tunnelling_pairs(double fraction, double least) const;

  size_t count() const { return parts_.size(); }
  const MovingComponent& operator[](int part) const { return parts_[part]; }
  // The component of a surface vertex; -1 for other vertices.
  int part_of(int vertex) const { return part_of_[vertex]; }

 private:
  bool anything_moves(double fraction, double least) const;

  const World& world_;
  std::vector<int> part_of_;  // per global vertex
  std::vector<MovingComponent> parts_;
};

}  // namespace tack
