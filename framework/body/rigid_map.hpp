// Rigid map x -> turn x + shift.
#pragma once

#include "geometry/types.hpp"

namespace tack {

struct RigidMap {
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();  // m

  // Returns the rotation about a centre, followed by the translation `then` [m].
  static RigidMap about(const Vec3& centre, const Mat3& turn, const Vec3& then = Vec3::Zero()) {
    return {turn, centre - turn * centre + then};
  }
  Vec3 operator()(const Vec3& x) const { return turn * x + shift; }
  // Returns the composition: `first`, then this map.
  RigidMap operator*(const RigidMap& first) const {
    return {turn * first.turn, turn * first.shift + shift};
  }
  RigidMap inverse() const { return {turn.transpose(), -(turn.transpose() * shift)}; }
};

}  // namespace tack
