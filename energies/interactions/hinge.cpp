// Hinges: two points of an axis, and the forces and limits about it.
#include <fmt/format.h>

#include "energies/interactions/joint_mechanics.hpp"
#include "energies/interactions/joint_points.hpp"
#include "energies/interactions/joint_strength.hpp"

namespace tack {
namespace {

inline constexpr Unit angular_damping{"N m s", "damping of turns"};
inline constexpr JointUnits of_hinges{units::angle, units::angular_velocity, units::moment, angular_damping, "angle", "torque",
                                      0.01, 0.01, 0.0175};  // rad, rad/s, rad

class Hinge : public Interaction {
 public:
  void fields(Fields& f) override {
    Interaction::fields(f);
    ends_.fields(f);
    f.vector("axis", axis_, units::none, "rotation axis; angles are right-handed").required();
    mechanics_.fields(f);
  }
  std::vector<std::string> objects() const override { return ends_.objects(); }

  void build(InteractionBuilder& builder) const override {
    if (axis_.norm() == 0) throw InputError(fmt::format("hinge '{}' has an axis without a direction; give it one", builder.name()));
    const Vec3 axis = axis_.normalized();
    JointPoints points(builder, ends_);
    const Vec3 arm = ends_.at + points.spacing() * across(axis)[0];
    const int a = points.joined(ends_.at), b = points.joined(ends_.at + points.spacing() * axis);
    const int from = points.of_other(arm), turned = points.of_object(arm);
    const double effort = joint_strength(builder.world(), points.object(), points.other());
    points.finish();
    mechanics_.build(builder, {a, b, from, turned}, effort);
  }

 private:
  JointEnds ends_;
  Vec3 axis_ = Vec3::Zero();
  MechanicsKeys<HingeAngle, of_hinges> mechanics_;
};

using JointAngle = CoordinateProbe<HingeAngle, of_hinges>;
using MotorTorque = DriveProbe<HingeAngle, of_hinges>;

TACK_REGISTER(Interaction, Hinge, "hinge", "Hinge joint: an affine body rotates only about an axis of another object or of space. Exact; optional "
                                           "limits, friction and motors.", "");
TACK_REGISTER(Probe, JointAngle, "joint_angle", "Rotation angle of a hinge, whole turns included [rad].", "");
TACK_REGISTER(Probe, MotorTorque, "motor_torque", "Moment of the velocity motor and the position motor of a hinge about its axis [N m].", "");

}  // namespace
}  // namespace tack
