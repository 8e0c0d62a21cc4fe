#include "geometry/level_set/distance_grid.hpp"

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tools/VolumeToMesh.h>
#include <tbb/parallel_for.h>

#include "geometry/errors.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {

struct DistanceGrid::Impl {
  openvdb::FloatGrid::Ptr grid;  // in voxels, its transform the identity
  Vec3 base;                     // origin of the grid relative to that of space [voxels]
};

namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

constexpr int leaf = 8, surface_band = 3;  // voxels

// Shift of the grid's nodes. Without it, bodies of round sizes about the origin would have nodes on their surface, and degenerate triangles there.
const Vec3 shift(0.137, 0.271, 0.391);  // voxels

// Returns the origin of the grid [voxels], for bodies far from the origin of space: indices of voxels are ints, and positions in the grid have
// single precision.
Vec3 base_of(const Eigen::AlignedBox3d& box, double voxel) {
  constexpr double near = 1e5, multiple = 1 << 20;  // voxels; a multiple of all cube sizes, so that cubes are placed as about the origin
  const Vec3 centre = box.center() / voxel;
  const double far = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  constexpr double resolved = 1e-6;  // of a voxel
  if (!(far * std::numeric_limits<double>::epsilon() < resolved * voxel))
    throw InputError(fmt::format("a level set at {:.3g} m from the origin, where positions have a resolution of {:.1g} m, has voxels of {:.3g} m; "
                                 "move it nearer (place.translate), or take larger ones", far, far * std::numeric_limits<double>::epsilon(), voxel));
  if (far < near * voxel) return Vec3::Zero();
  return (centre / multiple).array().round() * multiple;
}

Vec3 node(const Coord& c, const Vec3& base, double voxel) { return voxel * (Vec3(c.x(), c.y(), c.z()) + base + shift); }

// Returns the cubes of `size` voxels, by their lowest voxel, that may be near the surface.
std::vector<Coord> near_surface(const DistanceFunction& function, const std::vector<Coord>& cubes, int size, const Vec3& base, double voxel) {
  std::vector<char> near(cubes.size());
  const double distance = (std::sqrt(3) / 2 * size + surface_band + 1) * voxel;
  tbb::parallel_for(tbb::blocked_range<size_t>(0, cubes.size(), 256), [&](const auto& range) {
    std::vector<Vec3> centres;
    for (size_t i = range.begin(); i < range.end(); ++i)
      centres.push_back(node(cubes[i], base, voxel).array() + 0.5 * (size - 1) * voxel);
    std::vector<double> values(centres.size());
    function(centres, values);
    for (size_t i = 0; i < values.size(); ++i) near[range.begin() + i] = std::abs(values[i]) <= distance;
  });
  std::vector<Coord> kept;
  for (size_t i = 0; i < cubes.size(); ++i)
    if (near[i]) kept.push_back(cubes[i]);
  return kept;
}

std::vector<Coord> divided(const std::vector<Coord>& cubes, int half) {
  std::vector<Coord> parts;
  parts.reserve(8 * cubes.size());
  for (const Coord& c : cubes)
    for (int k = 0; k < 8; ++k) parts.push_back(c.offsetBy((k >> 2) * half, (k >> 1 & 1) * half, (k & 1) * half));
  return parts;
}

// Returns the leaves near the surface, by division of cubes of half the size of the box.
std::vector<Coord> surface_leaves(const DistanceFunction& function, const Eigen::AlignedBox3d& box, const Vec3& base, double voxel) {
  const Eigen::Array3d low = (box.min() / voxel - base).array().floor() - surface_band - 1;
  const Eigen::Array3d high = (box.max() / voxel - base).array().ceil() + surface_band + 1;
  if (!((high - low).maxCoeff() < 1e6))
    throw InputError(fmt::format("a box of {} m has more than a million voxels of {} m along an edge; take larger ones",
                                 box.sizes().maxCoeff(), voxel));
  int size = leaf;
  while (size < (high - low).maxCoeff() / 4) size *= 2;
  const auto first = [&](int axis) { return static_cast<int>(std::floor(low[axis] / size)) * size; };
  std::vector<Coord> cubes;
  for (int i = first(0); i <= high[0]; i += size)
    for (int j = first(1); j <= high[1]; j += size)
      for (int k = first(2); k <= high[2]; k += size) cubes.emplace_back(i, j, k);
  for (cubes = near_surface(function, cubes, size, base, voxel); size > leaf; cubes = near_surface(function, cubes, size, base, voxel)) {
    size /= 2;
    if (8.0 * static_cast<double>(cubes.size()) * std::pow(leaf, 3) > 8 * DistanceGrid::max_band_voxels)
      throw InputError(fmt::format("a surface in a box of {} m takes more than {:.0e} voxels of {} m; take larger ones",
                                   box.sizes().maxCoeff(), DistanceGrid::max_band_voxels, voxel));
    cubes = divided(cubes, size);
  }
  return cubes;
}

}  // namespace

DistanceGrid DistanceGrid::of(const DistanceFunction& function, const Eigen::AlignedBox3d& box, double voxel) {
  const Vec3 base = base_of(box, voxel);
  const std::vector<Coord> leaves = surface_leaves(function, box, base, voxel);
  using Leaf = FloatGrid::TreeType::LeafNodeType;
  constexpr float band = surface_band;
  std::vector<std::unique_ptr<Leaf>> filled(leaves.size());
  tbb::parallel_for(size_t{0}, leaves.size(), [&](size_t i) {
    std::array<Vec3, leaf * leaf * leaf> points;
    std::array<double, leaf * leaf * leaf> values;
    auto made = std::make_unique<Leaf>(leaves[i], band);
    for (openvdb::Index n = 0; n < points.size(); ++n) points[n] = node(made->offsetToGlobalCoord(n), base, voxel);
    function(points, values);
    bool crosses = false;
    for (openvdb::Index n = 0; n < points.size(); ++n) {
      const auto value = static_cast<float>(values[n] / voxel);
      const bool within = std::abs(value) < band;
      crosses |= within;
      made->setValueOnly(n, std::clamp(value, -band, band));
      made->setActiveState(n, within);
    }
    if (crosses) filled[i] = std::move(made);
  });
  const auto grid = FloatGrid::create(band);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  for (auto& made : filled)
    if (made) grid->tree().addLeaf(made.release());
  openvdb::tools::signedFloodFill(grid->tree());
  return {std::make_shared<Impl>(Impl{grid, base}), voxel};
}

DistanceGrid DistanceGrid::of(const Mesh& mesh, double voxel, double band) {
  const Surface surface = extract_surface(mesh);
  const Vec3 base = base_of(bounding_box(mesh), voxel);
  std::vector<openvdb::Vec3s> points;
  for (const Vec3& v : mesh.vertices) points.emplace_back(Eigen::Vector3f((v / voxel - base - shift).cast<float>()).data());
  std::vector<openvdb::Vec3I> triangles;
  for (const Triangle& t : surface.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
  const auto grid = openvdb::tools::meshToLevelSet<FloatGrid>(*transform, points, triangles, static_cast<float>(band / voxel));
  return {std::make_shared<Impl>(Impl{grid, base}), voxel};
}

double DistanceGrid::lowest() const {
  float least = impl_->grid->background();
  for (auto value = impl_->grid->cbeginValueAll(); value; ++value) least = std::min(least, *value);
  return voxel_ * least;
}

void DistanceGrid::sample(std::span<const Vec3> points, std::span<double> distances) const {
  const auto accessor = impl_->grid->getConstAccessor();
  for (size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i] / voxel_ - impl_->base - shift;
    distances[i] = voxel_ * openvdb::tools::BoxSampler::sample(accessor, openvdb::Vec3d(p.x(), p.y(), p.z()));
  }
}

Eigen::AlignedBox3d DistanceGrid::voxel_of(const Vec3& point) const {
  const Vec3 low = Vec3((point / voxel_ - impl_->base - shift).array().floor()) + impl_->base;
  return {voxel_ * (low + shift), voxel_ * (low + shift + Vec3::Ones())};
}

Mesh DistanceGrid::surface() const {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*impl_->grid, points, triangles, quads, 0.0, 0.0);
  Mesh mesh;
  for (const auto& p : points) mesh.vertices.push_back(voxel_ * (Vec3(p.x(), p.y(), p.z()) + impl_->base + shift));
  // OpenVDB's faces are oriented inwards.
  const auto add = [&](openvdb::Index32 a, openvdb::Index32 b, openvdb::Index32 c) {
    mesh.triangles.push_back({static_cast<int>(a), static_cast<int>(c), static_cast<int>(b)});
  };
  for (const auto& t : triangles) add(t[0], t[1], t[2]);
  for (const auto& q : quads) {
    const auto shorter = (points[q[0]] - points[q[2]]).lengthSqr() <= (points[q[1]] - points[q[3]]).lengthSqr();
    if (shorter) add(q[0], q[1], q[2]), add(q[0], q[2], q[3]);
    else add(q[0], q[1], q[3]), add(q[1], q[2], q[3]);
  }
  return mesh;
}

}  // namespace tack
