#include "framework/shapes/mesh_placement.hpp"

namespace tack {

void MeshPlacement::fields(Fields& f) {
  f.check("scale", [this]() -> std::string { return scale.cwiseAbs().minCoeff() > 0 ? "" : "no factor may be zero"; });
  f.check("axis", [this]() -> std::string { return angle == 0 || axis.norm() > 0 ? "" : "must not be zero"; });
  f.vector("scale", scale, units::none, "factors about the origin, applied first");
  f.vector("axis", axis, units::none, "rotation axis through the origin");
  f.number("angle", angle, units::angle, "right-handed rotation about the axis, applied second");
  f.vector("translate", translate, units::length, "offset, applied last");
}

void MeshPlacement::apply(Mesh& mesh) const {
  if (scale != Vec3::Ones()) tack::scale(mesh, scale);
  if (angle != 0) rotate(mesh, axis, angle);
  if (translate != Vec3::Zero()) tack::translate(mesh, translate);
}

Eigen::Affine3d MeshPlacement::transform() const {
  Eigen::Affine3d all(Eigen::Translation3d{translate});
  if (angle != 0) all.rotate(Eigen::AngleAxisd(angle, axis.normalized()));
  return all.scale(scale);
}

}  // namespace tack
