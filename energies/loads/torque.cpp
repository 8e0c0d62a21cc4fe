// Moment M about an axis through a fixed point, or through the moving centre of the vertices. Let a be the axis, m weights, and r positions relative to
// the centre, r0 at the start of the step. The rotation in the step, by least squares, is
//     theta = atan2(S, C),   S = sum_v m_v (a x r0_v) . r_v,   C = sum_v m_v r0_v . r_v  across the axis,
// and the potential is - M theta. Its forces have the moment M about the axis; without a fixed point their sum is zero. S and C are linear in x, so
// that the Hessian has rank two, with the eigenvalues 1 / (S^2 + C^2) and its negative.
// A free body would also be tilted, by the moment I a / (a . I a) - a, if the axis is no principal axis. Unless the scene gives a point of the axis,
// where bearings would take that moment, the forces m (b x r0), b = I^-1 a - a / (a . I a), of the start of the step cancel it.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

#include "energies/loads/ramp.hpp"
#include "framework/body/selection.hpp"
#include "framework/core/global_modes.hpp"
#include "framework/load/following_load.hpp"
#include "framework/world/load.hpp"

namespace tack {
namespace {

struct TorqueSettings {
  double value = 0;  // N m
  Vec3 axis = Vec3::UnitY();
  std::optional<Vec3> point;  // m
  Ramp ramp;
};

class TorqueTerm : public FollowingLoad, public GlobalModeSource {
 public:
  TorqueTerm(const TorqueSettings& settings, std::vector<int> vertices, VecX weights)
      : FollowingLoad("torque"), settings_(settings), axis_(settings.axis.normalized()), vertices_(std::move(vertices)), weights_(std::move(weights)) {}

  std::vector<double> abrupt_times() const override { return settings_.ramp.corners(); }
  void begin_step(const StepStart& start) override {
    FollowingLoad::begin_step(start);
    across_.resize(3, count());
    ahead_.resize(3, count());
    centre_ = settings_.point.value_or(mean(start.x));
    upright_.setZero(3, count());
    Mat3 inertia = Mat3::Zero();
    for (int i = 0; i < count(); ++i) {
      const Vec3 r = vertex(start.x, vertices_[i]) - centre_;
      inertia += weights_(i) * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
      across_.col(i) = weights_(i) * (r - axis_.dot(r) * axis_);
      ahead_.col(i) = weights_(i) * axis_.cross(r);
    }
    const Eigen::LLT<Mat3> factor(inertia);
    if (settings_.point || factor.info() != Eigen::Success || !(factor.rcond() > 1e-9)) return;
    const Vec3 b = factor.solve(axis_) - axis_ / axis_.dot(inertia * axis_);
    for (int i = 0; i < count(); ++i) upright_.col(i) = weights_(i) * b.cross(Vec3(vertex(start.x, vertices_[i]) - centre_));
  }

  double value(const VecX& x) const override {
    const auto [s, c] = sums(x);
    double held = 0;
    for (int i = 0; i < count(); ++i) held += upright_.col(i).dot(vertex(x, vertices_[i]) - vertex(start(), vertices_[i]));
    return -moment(1) * (std::atan2(s, c) + held);
  }
  std::vector<StencilBatch> batches() const override { return {{1, count(), vertices_.data()}}; }
  void derivatives(const VecX& x, Projection, double* gradient, double* hessian) const override {
    Eigen::Map<Eigen::Matrix3Xd>{gradient, 3, count()} = -forces(x, moment(1));
    if (hessian) std::fill(hessian, hessian + 9 * static_cast<size_t>(count()), 0.0);
  }
  void add_global_modes(const VecX& x, Projection projection, GlobalModes& modes) const override {
    const auto [s, c] = sums(x);
    const double twice = 2 * std::atan2(s, c), half = std::atan2(-std::cos(twice), -std::sin(twice)) / 2, size = moment(1) / (s * s + c * c);
    for (const double sign : {-1.0, 1.0}) {
      const double coefficient = projected(sign * size, projection);
      if (coefficient == 0) continue;
      // -M times the second derivative by S and C: to +1 / rho^2 belongs (cos, sin) of half the angle.
      const double of_s = sign < 0 ? std::cos(half) : -std::sin(half), of_c = sign < 0 ? std::sin(half) : std::cos(half);
      GlobalMode mode{coefficient, VecX::Zero(x.size())};
      for (int i = 0; i < count(); ++i) vertex(mode.vector, vertices_[i]) = of_s * ahead_.col(i) + of_c * across_.col(i);
      modes.push_back(std::move(mode));
    }
  }
  void add_forces(const VecX& x, double part, VecX& sum) const override {
    const Eigen::Matrix3Xd all = forces(x, moment(part));
    for (int i = 0; i < count(); ++i) vertex(sum, vertices_[i]) += all.col(i);
  }

 private:
  int count() const { return static_cast<int>(vertices_.size()); }
  double moment(double part) const { return settings_.value * settings_.ramp.at(time() + part * h()); }
  Vec3 mean(const VecX& x) const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < count(); ++i) sum += weights_(i) * vertex(x, vertices_[i]);
    return sum / weights_.sum();
  }
  std::pair<double, double> sums(const VecX& x) const {
    double s = 0, c = 0;
    for (int i = 0; i < count(); ++i) {
      const Vec3 r = vertex(x, vertices_[i]) - centre_;
      s += ahead_.col(i).dot(r);
      c += across_.col(i).dot(r);
    }
    return {s, c};
  }
  Eigen::Matrix3Xd forces(const VecX& x, double moment) const {
    const auto [s, c] = sums(x);
    return moment * ((c * ahead_ - s * across_) / (s * s + c * c) + upright_);
  }

  const TorqueSettings& settings_;
  Vec3 axis_, centre_ = Vec3::Zero();
  std::vector<int> vertices_;
  VecX weights_;
  Eigen::Matrix3Xd ahead_, across_;  // weights times a x r0, and times r0 across the axis
  Eigen::Matrix3Xd upright_;         // forces over the moment
};

class Torque : public Load {
 public:
  void fields(Fields& f) override {
    f.number("value", settings_.value, units::moment, "moment about the axis, right-handed").required();
    f.vector("axis", settings_.axis, units::none, "direction of the axis, fixed in space");
    f.optional_vector("point", settings_.point, units::length, "a fixed point of the axis; the moving centre of mass of the selection unless given");
    settings_.ramp.fields(f, "ramp", "factor over time");
    f.component("select", select_, "vertices; each takes a force proportional to its mass and its distance from the axis");
    f.check("axis", [this]() -> std::string { return settings_.axis.norm() > 0 ? "" : "must not be zero"; });
  }
  std::unique_ptr<FollowingLoad> make_term(const Body& body, const VecX& rest, const VecX& mass) const override {
    std::vector<int> chosen = select(*select_, {body, rest});
    if (!body.frame.empty()) chosen = body.frame;  // it is stiff: a moment on a part of it is one on all of it
    VecX weights(chosen.size());
    Vec3 centre = Vec3::Zero();
    for (size_t i = 0; i < chosen.size(); ++i) {
      weights(static_cast<Eigen::Index>(i)) = mass(chosen[i]);
      centre += mass(chosen[i]) * vertex(rest, chosen[i]);
    }
    if (!(weights.sum() > 0)) throw InputError("object '" + body.name + "': a torque needs something that has a mass; free the object, or choose other vertices");
    centre = settings_.point.value_or(centre / weights.sum());
    double inertia = 0;
    for (size_t i = 0; i < chosen.size(); ++i)
      inertia += weights(static_cast<Eigen::Index>(i)) * settings_.axis.normalized().cross(vertex(rest, chosen[i]) - centre).squaredNorm();
    const double extent = (vertex(rest, chosen.front()) - vertex(rest, chosen.back())).squaredNorm();
    if (!(inertia > 1e-12 * weights.sum() * extent) || inertia == 0)
      throw InputError("object '" + body.name + "': all that the torque turns lies on its axis; choose more vertices, or another axis or point");
    return std::make_unique<TorqueTerm>(settings_, std::move(chosen), std::move(weights));
  }

 private:
  TorqueSettings settings_;
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
};

TACK_REGISTER(Load, Torque, "torque", "A moment about an axis of fixed direction, through a fixed point or the moving centre of mass.", "");

}  // namespace
}  // namespace tack
