// The connected parts of what contact sees, and how they moved in a step: of each a box around where it was, and of the displacements of its
// vertices a box, their mean and how far they are from it. All of one part has moved against all of another one by at least what those boxes are
// apart: by nothing, if they move together, or if one of them is taken along where the other one hits it. Of parts of about the same size, which a hit deforms
// all over, but not as far as they move, most has moved by what the means are apart beyond these deviations.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "framework/world/world.hpp"
#include "geometry/broad_phase/aabb.hpp"

namespace tack {

struct MovingPart {
  int object = 0;
  double width = 0;  // of a particle: its diameter [m]
  Aabb place, way;   // before the step, and in it [m]
  Vec3 mean = Vec3::Zero();  // of the ways of its vertices [m]
  double deviation = 0;      // of them, root mean square [m]

  // The longest side; for a particle, its diameter [m].
  double size() const { return (place.hi - place.lo).maxCoeff() + width; }
  // How far one has moved against the other, as wholes; `size` is that of the smaller one [m].
  double way_against(const MovingPart& other, double size) const {
    const double all = (other.way.lo - way.hi).cwiseMax(way.lo - other.way.hi).cwiseMax(0.0).norm(), differ = deviation + other.deviation;
    return std::max(differ, std::max(this->size(), other.size()) / 2) > size ? all : std::max(all, (mean - other.mean).norm() - differ);
  }
  Aabb swept() const {
    Aabb box = place;
    box.lo += way.lo.cwiseMin(0.0);
    box.hi += way.hi.cwiseMax(0.0);
    return box;
  }
};

// Of two [m]; what has no size counts as `least` [m].
inline double smaller_size(const MovingPart& a, const MovingPart& b, double least) { return std::max(least, std::min(a.size(), b.size())); }

class MovingParts {
 public:
  // The world must have contact.
  explicit MovingParts(const World& world);

  // They have moved from x to y (3n).
  void move(const VecX& x, const VecX& y);
  // Pairs of parts, first < second, that may touch each other, are in each other's way and have, as wholes, moved against each other by more than
  // this fraction of the size of the smaller one; ascending.
  std::vector<std::array<int, 2>> passing(double fraction, double least) const;

  size_t count() const { return parts_.size(); }
  const MovingPart& operator[](int part) const { return parts_[part]; }
  int part_of(int vertex) const { return part_of_[vertex]; }  // of the surface; else -1

 private:
  bool anything_moves(double fraction, double least) const;

  const World& world_;
  std::vector<int> part_of_;  // per global vertex
  std::vector<MovingPart> parts_;
};

}  // namespace tack
