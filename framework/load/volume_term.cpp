#include "framework/load/volume_term.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "geometry/cross_matrix.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Blocks (a, a), (b, a), (b, b) of the Hessian that couples a with b by f [w]_x. Its eigenvalues
// are +-f |w|, twice, and zero.
void write_hessian(double f, const Vec3& w, Projection projection, double* blocks) {
  const double size = w.norm(), absolute_fraction = projection == Projection::none ? 0 : projection == Projection::absolute ? 1 : 0.5;
  Mat3 own = Mat3::Zero();
  if (absolute_fraction > 0 && size > 0) own = absolute_fraction * std::abs(f) * size * (Mat3::Identity() - w * w.transpose() / (size * size));
  Eigen::Map<Mat3>{blocks} = own;
  Eigen::Map<Mat3>{blocks + 9} = -(1 - absolute_fraction) * f * cross_matrix(w);
  Eigen::Map<Mat3>{blocks + 18} = own;
}

}  // namespace

double VolumeTerm::target(double) const { return not_a_number; }
double VolumeTerm::amount() const { return not_a_number; }

void VolumeTerm::begin_step(const StepStart& start) {
  FollowingLoad::begin_step(start);
  origin_ = surface_.mean_position(start.x);
  boundary_.clear();
  cone_volume_t0_ = 0;
  if (surface_.closed()) return;
  boundary_.assign(surface_.edges().size(), Vec3::Zero());
  for (size_t i = 0; i < boundary_.size(); ++i)
    if (const auto& e = surface_.edges()[i]; e.right < 0)
      boundary_[i] = (vertex(start.x, e.a) - origin_).cross(vertex(start.x, e.b) - origin_) / 6;
  cone_volume_t0_ = surface_.volume(start.x, origin_);
}

double VolumeTerm::enclosed(const VecX& x) const {
  double volume = surface_.volume(x, origin_) - cone_volume_t0_;
  for (size_t i = 0; i < boundary_.size(); ++i) {
    const auto& e = surface_.edges()[i];
    volume += boundary_[i].dot(vertex(x, e.a) + vertex(x, e.b) - vertex(start(), e.a) - vertex(start(), e.b));
  }
  return volume;
}

double VolumeTerm::value(const VecX& x) const { return sample(enclosed(x), 1).energy; }

void VolumeTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  const double p = sample(enclosed(x), 1).pressure;
  for_each(static_cast<int>(surface_.edges().size()), [&](int i) {
    const auto& e = surface_.edges()[i];
    const Vec3 a = vertex(x, e.a), b = vertex(x, e.b), left = vertex(x, e.left);
    Vec3 g = surface_.edge_area_vector(e, x);
    if (e.right < 0) g += boundary_[i] - (a - origin_).cross(b - origin_) / 6;
    double* const slots = gradient + 6 * static_cast<size_t>(i);
    Eigen::Map<Vec3>{slots} = Eigen::Map<Vec3>{slots + 3} = -p * g;
    if (!hessian) return;
    const Vec3 right = e.right < 0 ? origin_ : Vec3(vertex(x, e.right));
    write_hessian(p / 6, left - right, projection, hessian + 27 * static_cast<size_t>(i));
  });
}

void VolumeTerm::add_global_modes(const VecX& x, Projection projection, GlobalModes& modes) const {
  const double stiffness = projected(sample(enclosed(x), 1).stiffness, projection);
  if (stiffness == 0) return;
  GlobalMode mode{stiffness, VecX::Zero(x.size())};
  surface_.add_areas(x, 1, mode.vector);
  modes.push_back(std::move(mode));
}

void VolumeTerm::add_forces(const VecX& x, double fraction, VecX& forces) const {
  surface_.add_areas(x, sample(enclosed(x), fraction).pressure, forces);
}

}  // namespace tack
