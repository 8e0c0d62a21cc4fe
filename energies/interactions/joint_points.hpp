// Points at which joints join an object and another one, or space.
#pragma once

#include <string>

#include "framework/setup/interaction_builder.hpp"

namespace tack {

// The keys that all joints have.
struct JointEnds {
  std::string object, to;
  Vec3 at = Vec3::Zero();  // m
  bool contact = false;
  void fields(Fields& f);
  std::vector<std::string> objects() const;
};

class JointPoints {
 public:
  JointPoints(InteractionBuilder& builder, const JointEnds& ends);

  // How far from each other points of a body are by which it is held: half of its size, of the smaller one of the two [m].
  double reach() const { return reach_; }
  int object() const { return object_; }
  int other() const { return other_; }  // -1: space
  int of_object(const Vec3& at);        // a vertex that the object carries
  int of_other(const Vec3& at);         // one that the other carries, or that stays
  // One place of both; the vertex that is there.
  int joined(const Vec3& at);
  Joint& joint() { return joint_; }
  // Adds the joint; `contact`: whether the two stay in contact.
  void finish();

 private:
  bool affine(int body) const;

  InteractionBuilder& builder_;
  const JointEnds& ends_;
  int object_, other_ = -1;
  double reach_;
  Joint joint_;
};

// Two directions at right angles to an axis of length one, and to each other: a right-handed frame with it.
std::array<Vec3, 2> across(const Vec3& axis);

}  // namespace tack
