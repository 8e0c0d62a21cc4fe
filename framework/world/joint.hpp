// A joint: sums of positions that are zero throughout (joint_relations.hpp).
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct Joint {
  // Vertices and weights that add up to zero. The weighted sum is zero at rest.
  using Relation = std::vector<std::pair<int, double>>;

  std::string name;
  std::vector<Relation> relations;
  std::vector<int> bodies;   // joined bodies, its object first
  std::vector<int> places;   // its own massless vertices, which may become dependent
  // Vertices of its object at which it acts; its torque is reported about the first.
  std::vector<int> anchors;
  // Error of relations that only a stiff potential keeps [m].
  std::function<double(const VecX& x)> play = {};
};

inline Vec3 off(const Joint::Relation& relation, const VecX& x) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [v, weight] : relation) sum += weight * vertex(x, v);
  return sum;
}

// Returns the largest error of its relations, or of its stiff potentials [m].
inline double joint_error(const Joint& joint, const VecX& x) {
  double most = joint.play ? joint.play(x) : 0;
  for (const Joint::Relation& relation : joint.relations)
    most = std::max(most, off(relation, x).norm());
  return most;
}

}  // namespace tack
