// Attachment points of joints, on an object and on another object or space.
#pragma once

#include <string>

#include "framework/setup/interaction_builder.hpp"

namespace tack {

// Scene keys of all joints.
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

  // Returns the distance between the attachment points of a body: half of the size of the smaller
  // body [m].
  double spacing() const { return spacing_; }
  int object() const { return object_; }
  int other() const { return other_; }  // -1: space
  int of_object(const Vec3& at);        // returns a vertex that moves with the object
  int of_other(const Vec3& at);         // with the other object; fixed for space
  // Joins both at a position; returns the vertex there.
  int joined(const Vec3& at);
  Joint& joint() { return joint_; }
  // Adds the joint. With `contact`, the two objects stay in contact with each other.
  void finish();

 private:
  bool affine(int body) const;

  InteractionBuilder& builder_;
  const JointEnds& ends_;
  int object_, other_ = -1;
  double spacing_;
  Joint joint_;
};

// Returns two unit vectors that form a right-handed frame with a unit axis.
std::array<Vec3, 2> across(const Vec3& axis);

}  // namespace tack
