// What joins bodies exactly: sums of places that are zero throughout (joint_relations.hpp).
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct Joint {
  // Vertices and weights that add up to zero; zero at rest.
  using Relation = std::vector<std::pair<int, double>>;

  std::string name;
  std::vector<Relation> relations;
  std::vector<int> bodies;   // that it joins, its object first
  std::vector<int> places;   // vertices of its own, without mass, that may follow from others
  std::vector<int> anchors;  // vertices of its object at which it pulls; about the first one its torque is told
  std::function<double(const VecX& x)> play = {};  // how far off is what a stiff potential alone holds [m]
};

inline Vec3 off(const Joint::Relation& relation, const VecX& x) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [v, weight] : relation) sum += weight * vertex(x, v);
  return sum;
}

// By how much the worst of its relations is not zero, or what else holds gives way [m].
inline double joint_error(const Joint& joint, const VecX& x) {
  double most = joint.play ? joint.play(x) : 0;
  for (const Joint::Relation& relation : joint.relations) most = std::max(most, off(relation, x).norm());
  return most;
}

}  // namespace tack
