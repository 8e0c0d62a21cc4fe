#include "framework/level_set/level_set_shape.hpp"

#include <fmt/format.h>

#include "framework/config/field.hpp"
#include "geometry/errors.hpp"
#include "geometry/level_set/zero_surface.hpp"

namespace tack {

void LevelSetShape::fields(Fields& f) {
  f.component("of", of_, "the body").required();
  f.number("voxel", voxel_, units::length, "edge length of the voxels and, about, of the triangles; features thinner "
                                           "than two voxels may be lost").required().positive();
}

Mesh LevelSetShape::make() const {
  of_->prepare(voxel_);
  const Eigen::AlignedBox3d box = of_->bounds();
  if (box.isEmpty()) throw InputError("level set: nothing is inside");
  if (!finite(box)) throw InputError("level set: has no bounds; intersect it with something that has");
  Mesh mesh = zero_surface([this](auto points, auto values) { of_->evaluate(points, values); }, box, voxel_);
  if (mesh.triangles.empty())
    throw InputError(fmt::format("level set: nothing of it is as large as a voxel of {} m; take smaller ones", voxel_));
  return mesh;
}

TACK_REGISTER(ShapeSource, LevelSetShape, "level_set", "The surface of a body given by signed distances.", "");

}  // namespace tack
