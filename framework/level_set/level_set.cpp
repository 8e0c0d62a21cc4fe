#include "framework/level_set/level_set.hpp"

#include "geometry/interrupt.hpp"

namespace tack {

std::array<Vec3, 8> corners(const Eigen::AlignedBox3d& box) {
  std::array<Vec3, 8> all;
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 3; ++k) all[i][k] = (i >> k & 1 ? box.max() : box.min())[k];
  return all;
}

void LevelSet::fields(Fields& f) { f.object("place", placement_, "scale, rotate, translate it"); }

void LevelSet::prepare(double) {}

Eigen::AlignedBox3d LevelSet::bounds() const {
  Eigen::AlignedBox3d own = own_bounds();
  if (own.isEmpty()) return own;
  if (!finite(own)) return everywhere();
  const Eigen::Affine3d transform = placement_.transform();
  Eigen::AlignedBox3d box;
  for (const Vec3& corner : corners(own)) box.extend(transform * corner);
  return box;
}

void LevelSet::evaluate(std::span<const Vec3> points, std::span<double> values) const {
  if (interrupt_requested) throw Interrupted();
  if (placement_.trivial()) return own_values(points, values);
  const Eigen::Affine3d back = placement_.transform().inverse();
  std::vector<Vec3> own;
  own.reserve(points.size());
  for (const Vec3& p : points) own.push_back(back * p);
  own_values(own, values);
  // With different factors, the smallest one gives a lower bound of the distance.
  const double factor = placement_.scale.cwiseAbs().minCoeff();
  if (factor != 1)
    for (double& value : values) value *= factor;
}

void DerivedLevelSet::fields(Fields& f) {
  f.component("of", of_, "the body that it modifies").required();
  LevelSet::fields(f);
}

}  // namespace tack
