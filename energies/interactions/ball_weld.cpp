// Ball joints and welds: a ball joint joins one point and leaves all rotations free, a weld joins four points.
#include "energies/interactions/joint_points.hpp"

namespace tack {
namespace {

class PointJoint : public Interaction {
 public:
  void fields(Fields& f) override {
    Interaction::fields(f);
    ends_.fields(f);
  }
  std::vector<std::string> objects() const override { return ends_.objects(); }

 protected:
  JointEnds ends_;
};

class Ball : public PointJoint {
 public:
  void build(InteractionBuilder& builder) const override {
    JointPoints points(builder, ends_);
    points.joined(ends_.at);
    points.finish();
  }
};

class Weld : public PointJoint {
 public:
  void build(InteractionBuilder& builder) const override {
    JointPoints points(builder, ends_);
    points.joined(ends_.at);
    for (int i = 0; i < 3; ++i) points.joined(ends_.at + points.spacing() * Vec3::Unit(i));
    points.finish();
  }
};

TACK_REGISTER(Interaction, Ball, "ball", "Ball joint: a point of an affine body coincides with a point of another object or of space; all rotations "
                                         "are free. Exact.", "");
TACK_REGISTER(Interaction, Weld, "weld", "Weld: an affine body is rigidly joined to another object or to space. Exact.", "");

}  // namespace
}  // namespace tack
