// Level sets: bodies as functions that are negative inside, with a magnitude of at most the
// distance to the surface. Components of the `level_set` shape of a scene; combinations and
// deformations contain others. Lengths in metres.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "framework/config/registry.hpp"
#include "framework/shapes/place.hpp"

namespace tack {

class LevelSet : public Component {
 public:
  static constexpr const char* kind_name = "level_set";
  static constexpr const char* kind_doc =
      "A body by its signed distances: one of a simple form, or made of others.";

  void fields(Fields& f) override;  // `place`, last; derived classes begin with theirs

  // Prepares grids, with voxels of the given size [m]. Call it before the functions below. Throws
  // InputError.
  virtual void prepare(double voxel);

  // Returns a box that contains the body; infinite for an infinite body, empty for an empty one.
  Eigen::AlignedBox3d bounds() const;

  // Evaluates the function at each point: negative inside, slope at most 1. Throws Interrupted on
  // request.
  void evaluate(std::span<const Vec3> points, std::span<double> values) const;

 protected:
  // Returns the box before placement.
  virtual Eigen::AlignedBox3d own_bounds() const = 0;
  virtual void own_values(std::span<const Vec3> points, std::span<double> values) const = 0;

 private:
  PlaceConfig place_;
};

// Base of level sets that contain another one.
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
// Returns the box enlarged equally on all sides.
inline Eigen::AlignedBox3d widened(const Eigen::AlignedBox3d& box, double by) {
  if (box.isEmpty()) return box;
  return {box.min().array() - by, box.max().array() + by};
}
// Returns the corners of a finite box.
std::array<Vec3, 8> corners(const Eigen::AlignedBox3d& box);

}  // namespace tack
