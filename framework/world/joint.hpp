// Joint: weighted sums of positions that are zero at all times (joint_relations.hpp).
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
  std::vector<int> bodies;        // joined bodies, the object of the joint first
  std::vector<int> own_vertices;  // massless vertices of the joint, which may become dependent
  // Vertices of its object at which the joint acts; its torque is reported about the first.
  std::vector<int> attachment_points;
  // Returns the error of the relations that a stiff potential enforces [m]; may be empty.
  std::function<double(const VecX& x)> play = {};
};

// Returns the error of a relation at x [m].
inline Vec3 relation_error(const Joint::Relation& relation, const VecX& x) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [v, weight] : relation) sum += weight * vertex(x, v);
  return sum;
}

// Returns the largest error of the relations of a joint at x [m].
inline double joint_error(const Joint& joint, const VecX& x) {
  double largest = joint.play ? joint.play(x) : 0;
  for (const Joint::Relation& relation : joint.relations)
    largest = std::max(largest, relation_error(relation, x).norm());
  return largest;
}

}  // namespace tack
