#include <fmt/format.h>

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

// Mirrors at the plane through the origin with this normal. Triangles keep their sides, tets their
// volumes.
void mirror(Mesh& mesh, const Vec3& normal) {
  scale(mesh, Vec3::Constant(-1));
  for (Vec3& x : mesh.vertices) x = 2 * normal.dot(x) / normal.squaredNorm() * normal - x;
}

class Transform : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string&, Notes& notes) const override {
    Mesh result = mesh;
    translate(result, -about_);
    if (mirror_) mirror(result, *mirror_);
    if (angle_ != 0) rotate(result, axis_, angle_);
    translate(result, about_ + translate_);
    const Eigen::AlignedBox3d box = bounding_box(result);
    notes.push_back(fmt::format("now from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m", box.min().x(), box.min().y(), box.min().z(),
                                box.max().x(), box.max().y(), box.max().z()));
    return result;
  }

 protected:
  void parameters(Fields& f) override {
    f.optional_vector("mirror", mirror_, units::none, "normal of the mirror plane through `about`, applied first");
    f.vector("axis", axis_, units::none, "rotation axis through `about`");
    f.number("angle", angle_, units::angle, "right-handed rotation about the axis, applied second");
    f.vector("about", about_, units::length, "fixed point of mirroring and rotation");
    f.vector("translate", translate_, units::length, "offset, applied last");
    f.check("mirror", [this] { return mirror_ && mirror_->norm() == 0 ? "must not be zero" : ""; });
    f.check("axis", [this] { return angle_ == 0 || axis_.norm() > 0 ? "" : "must not be zero"; });
    f.check("translate", [this] {
      return mirror_ || angle_ != 0 || translate_ != Vec3::Zero() ? "" : "nothing is to be done; give mirror, angle (with axis) or translate";
    });
  }

 private:
  std::optional<Vec3> mirror_;
  Vec3 axis_ = Vec3::UnitY();
  double angle_ = 0;                                       // rad
  Vec3 about_ = Vec3::Zero(), translate_ = Vec3::Zero();  // m
};
TACK_REGISTER(MeshOperation, Transform, "transform", "A mesh mirrored, rotated and translated.", "");

}  // namespace
}  // namespace tack
