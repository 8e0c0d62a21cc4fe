// Motion by a drive of a protocol: x = reference + u(t) n, or a rotation by u(t) about an axis.
#include <Eigen/Geometry>

#include "framework/motion/motion.hpp"
#include "framework/protocol/drives.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class DrivenMotion : public Motion {
 public:
  void fields(Fields& f) override {
    f.text("drive", drive_, "drive of a protocol that moves the vertices").required().line();
    f.optional_vector("direction", direction_, units::none, "direction of a displacement; its length does not count");
    f.optional_vector("axis", axis_, units::none, "direction of the axis of a rotation, which is right-handed about it");
    f.vector("centre", centre_, units::length, "a point of the axis");
    f.check("direction", [this]() -> std::string {
      if (direction_.has_value() == axis_.has_value()) return "give either direction, for a displacement, or axis, for a rotation";
      return (direction_ ? *direction_ : *axis_).norm() > 0 ? "" : "must not be zero";
    });
    Motion::fields(f);
  }
  std::string drive() const override { return drive_; }
  FollowerKind drive_kind() const override { return axis_ ? FollowerKind::angle : FollowerKind::displacement; }
  void follow(const Drive& drive) override { followed_ = &drive; }
  void set_positions(std::span<const int> vertices, const VecX&, const VecX& reference, double t, VecX& x) const override {
    const double u = followed_ ? followed_->at(t) : 0;
    if (direction_) {
      const Vec3 d = u * direction_->normalized();
      for (const int v : vertices) vertex(x, v) = vertex(reference, v) + d;
      return;
    }
    const Mat3 r = Eigen::AngleAxisd(u, axis_->normalized()).toRotationMatrix();
    for (const int v : vertices) vertex(x, v) = centre_ + r * (vertex(reference, v) - centre_);
  }
  bool unbounded() const override { return true; }

 private:
  std::string drive_;
  std::optional<Vec3> direction_, axis_;
  Vec3 centre_ = Vec3::Zero();       // m
  const Drive* followed_ = nullptr;  // null in the scene, before a world is made
};

TACK_REGISTER(Motion, DrivenMotion, "driven", "Moves vertices as the stages of a protocol say: along a direction, or about an axis.", "");

}  // namespace
}  // namespace tack
