// Signed distances on the voxels near a surface (OpenVDB's narrow band), and surfaces extracted
// from them. Lengths in metres; voxels are cubes. Distances are stored in single precision, in
// units of a voxel and relative to a point of the body, so that its size and position do not affect
// accuracy. The same input gives the same bits for any number of threads.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <span>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Evaluates lower bounds of signed distances, negative inside, at many points; called from several
// threads.
using DistanceFunction = std::function<void(std::span<const Vec3>, std::span<double>)>;

class DistanceGrid {
 public:
  // Returns the grid of a function with slope at most 1, positive outside the box. Throws
  // InputError if that takes more than max_band_voxels.
  static DistanceGrid of(const DistanceFunction& function, const Eigen::AlignedBox3d& box,
                         double voxel);
  // Returns the grid of the closed surface of a mesh, up to `band` [m] on both sides.
  static DistanceGrid of(const Mesh& mesh, double voxel, double band);

  // Returns the lowest distance in the band (negative: greatest depth); at least minus its width.
  double lowest() const;
  // Interpolates distances between voxels; beyond the band, they are the width of the band.
  void sample(std::span<const Vec3> points, std::span<double> distances) const;

  // Returns triangles with outward normals, with a vertex per voxel that the surface crosses; empty
  // if nothing is inside.
  Mesh surface() const;
  // Returns the voxel that contains a point.
  Eigen::AlignedBox3d voxel_of(const Vec3& point) const;

  static constexpr double max_band_voxels = 2e8;

  struct Impl;  // OpenVDB's grid

 private:
  DistanceGrid(std::shared_ptr<const Impl> impl, double voxel)
      : impl_(std::move(impl)), voxel_(voxel) {}

  std::shared_ptr<const Impl> impl_;
  double voxel_;
};

}  // namespace tack
