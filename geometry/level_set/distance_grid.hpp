// Distances on the voxels near a surface (OpenVDB's narrow band), and surfaces from them. Lengths
// in metres; a voxel is a cube. Numbers are kept in single precision in units of a voxel and from a
// point of the body, so that its scale and position do not matter. Same input, same bits, whatever
// the number of threads.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <memory>
#include <span>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Signed distances or less, negative inside, at many points at once; called from several threads.
using DistanceFunction = std::function<void(std::span<const Vec3>, std::span<double>)>;

class DistanceGrid {
 public:
  // Returns the grid of a function with slope at most 1, positive outside the box. Throws
  // InputError if that takes more than max_band_voxels.
  static DistanceGrid of(const DistanceFunction& function, const Eigen::AlignedBox3d& box,
                         double voxel);
  // Returns the grid of the closed surface of a mesh, up to `band` [m] on both sides.
  static DistanceGrid of(const Mesh& mesh, double voxel, double band);

  // How deep it is where it is deepest, below zero; no less than minus the band's width.
  double lowest() const;
  // Interpolated between voxels; the band's width where a point is farther.
  void sample(std::span<const Vec3> points, std::span<double> distances) const;

  // Returns triangles with outward normals, with a vertex per voxel that the surface crosses; empty
  // if nothing is inside.
  Mesh surface() const;
  // The voxel that a point lies in.
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
