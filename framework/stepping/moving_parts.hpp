// The connected parts of what contact sees, and how they moved in a step: of each a box around where it was, and a box
// around the displacements of its vertices. All of one part has moved against all of another one by at least what these
// boxes are apart: by nothing, if they move together, or if one of them is taken along where the other one hits it.
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

  // The longest side; for a particle, its diameter [m].
  double size() const { return (place.hi - place.lo).maxCoeff() + width; }
  // How far any point of one has moved against any of the other, at least [m].
  double way_against(const MovingPart& other) const {
    return (other.way.lo - way.hi).cwiseMax(way.lo - other.way.hi).cwiseMax(0.0).norm();
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
