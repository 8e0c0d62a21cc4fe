// Mesh placement: scaling, then rotation, then translation.
#pragma once

#include "framework/config/field.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

struct MeshPlacement {
  Vec3 scale = Vec3::Ones();
  Vec3 axis = Vec3::UnitY();
  double angle = 0;               // rad
  Vec3 translate = Vec3::Zero();  // m
  void fields(Fields& f);

  void apply(Mesh& mesh) const;  // throws InputError for a zero axis or factor

  bool trivial() const { return scale == Vec3::Ones() && angle == 0 && translate == Vec3::Zero(); }
  Eigen::Affine3d transform() const;  // the placement as a map of points
};

}  // namespace tack
