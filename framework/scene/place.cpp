#include "framework/scene/place.hpp"

namespace tack {

void PlaceConfig::fields(Fields& f) {
  f.vector("scale", scale, units::none, "factors about the origin, applied first");
  f.vector("axis", axis, units::none, "rotation axis through the origin");
  f.number("angle", angle, units::angle, "right-handed rotation about the axis, applied second");
  f.vector("translate", translate, units::length, "offset, applied last");
}

void PlaceConfig::apply(Mesh& mesh) const {
  if (scale != Vec3::Ones()) tack::scale(mesh, scale);
  if (angle != 0) rotate(mesh, axis, angle);
  if (translate != Vec3::Zero()) tack::translate(mesh, translate);
}

}  // namespace tack
