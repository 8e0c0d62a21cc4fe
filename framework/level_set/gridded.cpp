// Level sets that need exact distances, which are computed on a grid: offsets and shells of others,
// and meshes.
#include <fmt/format.h>

#include "framework/config/field.hpp"
#include "framework/level_set/level_set.hpp"
#include "framework/shapes/mesh_cache.hpp"
#include "geometry/errors.hpp"
#include "geometry/level_set/zero_surface.hpp"
#include "geometry/mesh/mass_properties.hpp"

namespace tack {
namespace {

using Box = Eigen::AlignedBox3d;

// Level set defined by the surface of another one and distances from it, up to band_width() [m].
class Gridded : public DerivedLevelSet {
 public:
  void prepare(double voxel) override {
    DerivedLevelSet::prepare(voxel);
    const Box box = child().bounds();
    if (!finite(box)) throw InputError(fmt::format("level set '{}' needs a bounded one", type()));
    const Mesh surface = zero_surface([this](auto points, auto values) { child().evaluate(points, values); }, box, voxel);
    grid_ = DistanceGrid::of(surface, voxel, band_width() + 4 * voxel);
    check(*grid_);
  }

 protected:
  virtual void check(const DistanceGrid&) const {}  // throws InputError if the parameters do not fit the body
  virtual double band_width() const = 0;
  std::optional<DistanceGrid> grid_;
};

class OffsetLevelSet : public Gridded {
 public:
  void fields(Fields& f) override {
    f.number("distance", distance_, units::length, "outwards; negative: inwards").required();
    DerivedLevelSet::fields(f);
  }

 protected:
  void check(const DistanceGrid& grid) const override {
    const double depth = -grid.lowest();
    if (distance_ < 0 && depth < -distance_)
      throw InputError(fmt::format("level set 'offset': nothing is left of it, as it is {:.3g} m deep at most and distance is {:.3g} m; offset by less",
                                   std::max(depth, 0.0), distance_));
  }
  double band_width() const override { return std::abs(distance_); }
  Box own_bounds() const override { return widened(child().bounds(), std::max(distance_, 0.0)); }
  void own_values(std::span<const Vec3> points, std::span<double> values) const override {
    grid_->sample(points, values);
    for (double& value : values) value -= distance_;
  }

 private:
  double distance_ = 0;  // m
};

class ShellLevelSet : public Gridded {
 public:
  void fields(Fields& f) override {
    f.number("thickness", thickness_, units::length, "thickness, half of it on each side of the surface").required().positive();
    DerivedLevelSet::fields(f);
  }

 protected:
  double band_width() const override { return thickness_ / 2; }
  Box own_bounds() const override { return widened(child().bounds(), thickness_ / 2); }
  void own_values(std::span<const Vec3> points, std::span<double> values) const override {
    grid_->sample(points, values);
    for (double& value : values) value = std::abs(value) - thickness_ / 2;
  }

 private:
  double thickness_ = 0.1;  // m
};

class MeshLevelSet : public LevelSet {
 public:
  void fields(Fields& f) override {
    f.component("shape", shape_, "shape with a closed surface").required();
    LevelSet::fields(f);
  }
  void prepare(double voxel) override {
    const Mesh mesh = mesh_of_shape(*shape_)->mesh;
    mass_properties(mesh);  // throws InputError for open surfaces
    box_ = bounding_box(mesh);
    grid_ = DistanceGrid::of(mesh, voxel, 4 * voxel);
  }

 protected:
  Box own_bounds() const override { return box_; }
  void own_values(std::span<const Vec3> points, std::span<double> values) const override {
    grid_->sample(points, values);
    // Beyond the band, the distance to the box is a lower bound.
    for (size_t i = 0; i < points.size(); ++i)
      if (values[i] > 0) values[i] = std::max(values[i], box_.exteriorDistance(points[i]));
  }

 private:
  std::unique_ptr<ShapeSource> shape_;
  Box box_;
  std::optional<DistanceGrid> grid_;
};

TACK_REGISTER(LevelSet, OffsetLevelSet, "offset", "Another body, grown or shrunk by a distance.", "");
TACK_REGISTER(LevelSet, ShellLevelSet, "shell", "A shell around the surface of another body.", "");
TACK_REGISTER(LevelSet, MeshLevelSet, "mesh", "The interior of a closed surface: that of a shape or of a file.", "");

}  // namespace
}  // namespace tack
