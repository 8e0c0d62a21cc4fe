// Bodies by what is inside: a function that is negative there, of the size of the distance to the surface or less. Parts of a
// scene's `level_set` shape; what combines or deforms others holds them. Lengths in metres.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "framework/config/registry.hpp"
#include "framework/shapes/place.hpp"

namespace tack {

class LevelSet : public Component {
 public:
  static constexpr const char* kind_name = "level_set";
  static constexpr const char* kind_doc = "A body given by signed distances: a primitive, or a combination of others.";

  void fields(Fields& f) override;  // `place`, last; derived classes begin with theirs

  // Puts in order what needs grids, with voxels of that size [m]; before the functions below. Throws InputError.
  virtual void prepare(double voxel);

  // What lies outside of it is outside of the body; infinite where the body is. Empty: nothing is inside.
  Eigen::AlignedBox3d bounds() const;

  // At each point: negative inside, nowhere steeper than 1. Throws Interrupted if that is asked for.
  void evaluate(std::span<const Vec3> points, std::span<double> values) const;

 protected:
  // The same before it was put in its place.
  virtual Eigen::AlignedBox3d own_bounds() const = 0;
  virtual void own_values(std::span<const Vec3> points, std::span<double> values) const = 0;

 private:
  PlaceConfig place_;
};

// What has another in it.
class DerivedLevelSet : public LevelSet {
 public:
  void fields(Fields& f) override;  // `of`
  void prepare(double voxel) override { of_->prepare(voxel); }

 protected:
  const LevelSet& child() const { return *of_; }

 private:
  std::unique_ptr<LevelSet> of_;
};

inline Eigen::AlignedBox3d everywhere() {
  return {Vec3::Constant(-std::numeric_limits<double>::infinity()), Vec3::Constant(std::numeric_limits<double>::infinity())};
}
inline bool finite(const Eigen::AlignedBox3d& box) { return box.isEmpty() || (box.min().allFinite() && box.max().allFinite()); }
// Wider by as much on every side.
inline Eigen::AlignedBox3d widened(const Eigen::AlignedBox3d& box, double by) {
  if (box.isEmpty()) return box;
  return {box.min().array() - by, box.max().array() + by};
}
// The corners of a finite box.
std::array<Vec3, 8> corners(const Eigen::AlignedBox3d& box);

}  // namespace tack
