// Level set: a body as a function that is negative inside. Its absolute value is a lower bound of
// the distance to the surface. Level sets make up a scene's `level_set` shape; those that combine
// or deform others own them. Lengths in metres.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "framework/config/registry.hpp"
#include "framework/shapes/mesh_placement.hpp"

namespace tack {

class LevelSet : public Component {
 public:
  static constexpr const char* kind_name = "level_set";
  static constexpr const char* kind_doc =
      "A body given by signed distances: a primitive, or a combination of others.";

  void fields(Fields& f) override;  // `place`, last; derived classes begin with theirs

  // Prepares level sets that need grids, with voxels of that size [m]; call before the functions
  // below. Throws InputError.
  virtual void prepare(double voxel);

  // Returns a box that contains the body; infinite if the body is. Empty: nothing is inside.
  Eigen::AlignedBox3d bounds() const;

  // Evaluates at each point: negative inside, nowhere steeper than 1. Throws Interrupted on
  // request.
  void evaluate(std::span<const Vec3> points, std::span<double> values) const;

 protected:
  // Bounds and values before placement.
  virtual Eigen::AlignedBox3d own_bounds() const = 0;
  virtual void own_values(std::span<const Vec3> points, std::span<double> values) const = 0;

 private:
  MeshPlacement placement_;
};

// Level set that modifies another one, which it owns.
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
  return {Vec3::Constant(-std::numeric_limits<double>::infinity()),
          Vec3::Constant(std::numeric_limits<double>::infinity())};
}
inline bool finite(const Eigen::AlignedBox3d& box) {
  return box.isEmpty() || (box.min().allFinite() && box.max().allFinite());
}
// Returns the box enlarged by `by` on every side.
inline Eigen::AlignedBox3d widened(const Eigen::AlignedBox3d& box, double by) {
  if (box.isEmpty()) return box;
  return {box.min().array() - by, box.max().array() + by};
}
// Returns the corners of a finite box.
std::array<Vec3, 8> corners(const Eigen::AlignedBox3d& box);

}  // namespace tack
