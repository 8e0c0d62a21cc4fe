// Connected components of the contact surface and their motion in a step.
//
// The relative displacement of two components is a lower bound of the displacement of any point of
// one against any point of the other: the distance between the AABBs of their displacements. If
// their sizes are similar, so that a hit may deform all of them, it is at least the distance
// between their mean displacements less the root mean square deviations of both. It is 0 for
// components that move together, or if one of them is carried along by the other.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "framework/world/world.hpp"
#include "geometry/broad_phase/aabb.hpp"

namespace tack {

struct MovingComponent {
  int object = 0;
  double width = 0;          // diameter of a particle [m]
  Aabb box;                  // AABB of the positions before the step [m]
  Aabb displacement;         // AABB of the displacements in the step [m]
  Vec3 mean = Vec3::Zero();  // mean displacement of its vertices [m]
  double deviation = 0;      // root mean square deviation from the mean [m]

  // Returns the longest side of its AABB; the diameter of a particle [m].
  double size() const { return (box.hi - box.lo).maxCoeff() + width; }
  // Returns the relative displacement [m]; size: of the smaller component [m].
  double displacement_against(const MovingComponent& other, double size) const {
    const Aabb &a = displacement, &b = other.displacement;
    const double box_distance = (b.lo - a.hi).cwiseMax(a.lo - b.hi).cwiseMax(0.0).norm(),
                 deviations = deviation + other.deviation;
    return std::max(deviations, std::max(this->size(), other.size()) / 2) > size
               ? box_distance
               : std::max(box_distance, (mean - other.mean).norm() - deviations);
  }
  // Returns the AABB of the motion in the step [m].
  Aabb swept() const {
    Aabb swept = box;
    swept.lo += displacement.lo.cwiseMin(0.0);
    swept.hi += displacement.hi.cwiseMax(0.0);
    return swept;
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
  // Returns the pairs of components that may touch, whose swept AABBs overlap, and whose relative
  // displacement exceeds `fraction` of the size of the smaller one, at least of `least` [m]. First
  // < second, ascending.
  std::vector<std::array<int, 2>> tunnelling_pairs(double fraction, double least) const;

  size_t count() const { return components_.size(); }
  const MovingComponent& operator[](int component) const { return components_[component]; }
  // Returns the component of a surface vertex; -1 for other vertices.
  int component_of(int vertex) const { return component_of_[vertex]; }

 private:
  bool anything_moves(double fraction, double least) const;

  const World& world_;
  std::vector<int> component_of_;  // per global vertex
  std::vector<MovingComponent> components_;
};

}  // namespace tack
