// Deformations of level sets.
#include <fmt/format.h>

#include "framework/config/field.hpp"
#include "framework/level_set/level_set.hpp"
#include "geometry/errors.hpp"
#include "geometry/level_set/gradient_noise.hpp"

namespace tack {
namespace {

using Box = Eigen::AlignedBox3d;

// Deformation of another level set: its values at the original positions, divided by the steepness
// of the map.
class Deformation : public DerivedLevelSet {
 public:
  void prepare(double voxel) override {
    DerivedLevelSet::prepare(voxel);
    inner_ = child().bounds();
    if (!finite(inner_)) throw InputError(fmt::format("level set '{}' needs a bounded one", type()));
    prepare_deformation();
  }

 protected:
  virtual void prepare_deformation() = 0;
  void own_values(std::span<const Vec3> points, std::span<double> values) const override {
    std::vector<Vec3> moved;
    moved.reserve(points.size());
    for (const Vec3& p : points) moved.push_back(origin(p));
    child().evaluate(moved, values);
    for (double& value : values) value /= steepness_;
  }
  virtual Vec3 origin(const Vec3& p) const = 0;

  Box inner_;
  double steepness_ = 1;
};

class TwistLevelSet : public Deformation {
 public:
  void fields(Fields& f) override {
    f.number("rate", rate_, units::curvature, "angle per length along y, about the y axis, right-handed, in radians").required();
    DerivedLevelSet::fields(f);
  }

 protected:
  void prepare_deformation() override {
    for (const Vec3& corner : corners(inner_)) radius_ = std::max(radius_, std::hypot(corner.x(), corner.z()));
    // Singular values of a shear by rate * radius; the body lies within the radius.
    const double shear = std::abs(rate_) * radius_;
    steepness_ = shear / 2 + std::sqrt(1 + shear * shear / 4);
  }
  Box own_bounds() const override { return {Vec3(-radius_, inner_.min().y(), -radius_), Vec3(radius_, inner_.max().y(), radius_)}; }
  Vec3 origin(const Vec3& p) const override {
    // Outside of the cylinder that contains the body, where the twist would be steeper, the nearest
    // point of the cylinder counts.
    const double radius = std::hypot(p.x(), p.z()), factor = radius > radius_ ? radius_ / radius : 1;
    return Eigen::AngleAxisd(-rate_ * p.y(), Vec3::UnitY()) * Vec3(factor * p.x(), p.y(), factor * p.z());
  }
  void own_values(std::span<const Vec3> points, std::span<double> values) const override {
    Deformation::own_values(points, values);
    for (size_t i = 0; i < points.size(); ++i) values[i] = std::max(values[i], std::hypot(points[i].x(), points[i].z()) - radius_);
  }

 private:
  double rate_ = 0, radius_ = 0;  // 1/m, m
};

class BendLevelSet : public Deformation {
 public:
  void fields(Fields& f) override {
    f.number("radius", radius_, units::length, "radius of the circle that the x axis becomes, about an axis along z; "
                                               "larger y is nearer to the centre").required().positive();
    DerivedLevelSet::fields(f);
  }

 protected:
  void prepare_deformation() override {
    if (inner_.isEmpty()) return;
    if (!(inner_.max().y() < radius_))
      throw InputError(fmt::format("level set 'bend': reaches up to y = {} m, beyond the centre of a circle of {} m; take a larger radius",
                                   inner_.max().y(), radius_));
    if (inner_.max().x() > M_PI * radius_ || inner_.min().x() < -M_PI * radius_)
      throw InputError(fmt::format("level set 'bend': is longer than a circle of radius {} m; take a larger one", radius_));
    hole_ = radius_ - inner_.max().y();
    // Straight lines are shorter than arcs, at most by pi / 2.
    steepness_ = M_PI / 2 * std::max(1.0, radius_ / hole_);
    outer_ = radius_ - inner_.min().y();
  }
  Box own_bounds() const override {
    if (inner_.isEmpty()) return inner_;
    return {Vec3(-outer_, radius_ - outer_, inner_.min().z()), Vec3(outer_, radius_ + outer_, inner_.max().z())};
  }
  Vec3 origin(const Vec3& p) const override {
    const double y = radius_ - p.y();
    return {std::atan2(p.x(), y) * radius_, radius_ - std::hypot(p.x(), y), p.z()};
  }
  void own_values(std::span<const Vec3> points, std::span<double> values) const override {
    Deformation::own_values(points, values);
    // Also the values on the other side of the circle. Nearer to the centre than the whole body, the
    // distance to the body's inner radius.
    std::vector<Vec3> around;
    around.reserve(points.size());
    for (const Vec3& p : points) {
      const Vec3 x = origin(p);
      around.emplace_back(x.x() - std::copysign(2 * M_PI * radius_, x.x()), x.y(), x.z());
    }
    std::vector<double> other(points.size());
    child().evaluate(around, other);
    for (size_t i = 0; i < points.size(); ++i) {
      const double inner = hole_ - std::hypot(points[i].x(), radius_ - points[i].y());
      values[i] = inner > 0 ? inner : std::min(values[i], other[i] / steepness_);
    }
  }

 private:
  double radius_ = 1, outer_ = 1, hole_ = 0;  // m
};

class NoiseLevelSet : public DerivedLevelSet {
 public:
  void fields(Fields& f) override {
    f.number("amplitude", amplitude_, units::length, "largest displacement of the surface, outwards or inwards").required().positive();
    f.number("wavelength", wavelength_, units::length, "wavelength of the coarsest bumps").required().positive();
    f.integer("octaves", octaves_, "number of octaves; each has half the wavelength and amplitude of the one before").at_least(1).at_most(8);
    f.integer("seed", seed_, "random seed of the bumps").at_least(0);
    DerivedLevelSet::fields(f);
  }

 protected:
  Box own_bounds() const override { return widened(child().bounds(), amplitude_); }
  void own_values(std::span<const Vec3> points, std::span<double> values) const override {
    child().evaluate(points, values);
    // Heights add up to the amplitude; every octave is as steep as the first.
    const double first = amplitude_ / (2 - std::pow(0.5, octaves_ - 1));
    const double steepness = 1 + octaves_ * first * gradient_noise_slope / wavelength_;
    for (size_t i = 0; i < points.size(); ++i) {
      double height = first, length = wavelength_, sum = 0;
      for (int k = 0; k < octaves_; ++k, height /= 2, length /= 2)
        sum += height * gradient_noise(points[i] / length, static_cast<std::uint32_t>(seed_ * 8 + k));
      values[i] = (values[i] - sum) / steepness;
    }
  }

 private:
  double amplitude_ = 0.1, wavelength_ = 1;  // m
  int octaves_ = 1, seed_ = 1;
};

TACK_REGISTER(LevelSet, TwistLevelSet, "twist", "Another body, twisted about the y axis.", "");
TACK_REGISTER(LevelSet, BendLevelSet, "bend", "Another body, bent so that the x axis becomes a circle.", "");
TACK_REGISTER(LevelSet, NoiseLevelSet, "noise", "Another body with random bumps on its surface.", "");

}  // namespace
}  // namespace tack
