// Wind and the drag of a medium on triangles. With u = n . (w - v), the velocity w of the medium relative to a triangle of normal n and velocity v,
// the force on the triangle is
//     1/2 rho c_d A |u| u n.
// The law is the pressure of modified Newtonian flow (Lees 1955): the stagnation pressure times c_d times the squared cosine of the incidence.
// Triangles of an open sheet have pressure on both sides. Those of solids and closed sheets have it on the outside alone (u < 0 with n outwards):
// neither the lee nor the walls of cavities carry pressure. Divided by 1/2 rho c_d U^2 times the frontal area, the drag is 1 for a sheet or a face of a
// cuboid across the flow, 2/3 for a cylinder across it, and 1/2 for a sphere. Triangles do not shelter each other.
//
// With the normals and areas of the start of the step and the velocities of its end, v = rate (x - still), the force has the convex potential
//     rho c_d A / (6 rate) |u|^3,
// so that drag is implicit also for light sheets.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "energies/loads/ramp.hpp"
#include "framework/body/cavity_surface.hpp"
#include "framework/body/selection.hpp"
#include "framework/load/following_load.hpp"
#include "framework/world/load.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

struct WindSettings {
  Vec3 velocity = Vec3::Zero();  // m/s
  double density = 1.2;          // kg/m^3
  double drag = 1;
  Ramp ramp;
};

class WindTerm : public FollowingLoad {
 public:
  WindTerm(const WindSettings& settings, const ExposedTriangles& exposed)
      : FollowingLoad("wind"), settings_(settings), triangles_(exposed.open), open_(static_cast<int>(exposed.open.size())) {
    triangles_.insert(triangles_.end(), exposed.closed.begin(), exposed.closed.end());
  }
  bool needs_velocities() const override { return true; }

  std::vector<double> abrupt_times() const override { return settings_.ramp.corners(); }
  void begin_step(const StepStart& start) override {
    FollowingLoad::begin_step(start);
    normals_.resize(3, count());
    factors_.resize(count());
    still_.resize(count());
    first_.resize(count());
    const Vec3 wind = settings_.ramp.at(start.time + start.h) * settings_.velocity;
    for (int t = 0; t < count(); ++t) {
      const auto [a, b, c] = tack::corners(start.x, triangles_[t]);
      const Vec3 twice = (b - a).cross(c - a);
      const double size = twice.norm();
      normals_.col(t) = size > 0 ? Vec3(twice / size) : Vec3::Zero();
      factors_(t) = settings_.density * settings_.drag * size / 4;
      still_(t) = normals_.col(t).dot(wind + after().rate * mean(after().still, t));
      first_(t) = towards(start.x, t);
    }
  }

  double value(const VecX& x) const override {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int t = first; t < last; ++t) {
        const double u = towards(x, t), before = first_(t);
        // Without velocities, the limit of the drag.
        if (after().rate > 0) sum += factors_(t) / (3 * after().rate) * (std::abs(u * u * u) - std::abs(before * before * before));
        else sum -= factors_(t) * std::abs(u) * u * normals_.col(t).dot(mean(x, t) - mean(start(), t));
      }
      return sum;
    });
  }
  std::vector<StencilBatch> batches() const override { return {{3, count(), triangles_.front().data()}}; }
  void derivatives(const VecX& x, Projection, double* gradient, double* hessian) const override {
    for_each(count(), [&](int t) {
      const double u = towards(x, t);
      const Vec3 n = normals_.col(t), g = -factors_(t) / 3 * std::abs(u) * u * n;
      for (int k = 0; k < 3; ++k) Eigen::Map<Vec3>{gradient + 9 * static_cast<size_t>(t) + 3 * k} = g;
      if (!hessian) return;
      const Mat3 h = 2 * factors_(t) / 9 * std::abs(u) * after().rate * n * n.transpose();
      for (int k = 0; k < hessian_blocks(3); ++k) Eigen::Map<Mat3>{hessian + 54 * static_cast<size_t>(t) + 9 * k} = h;
    });
  }
  void add_forces(const VecX& x, double, VecX& forces) const override {
    for (int t = 0; t < count(); ++t) {
      const double u = towards(x, t);
      push(t, u, forces);
    }
  }
  // The mean of both ends.
  double work(const VecX& x, const DofMap& dofs) const override {
    VecX forces = VecX::Zero(x.size());
    add_forces(x, 1, forces);
    const Vec3 wind = settings_.ramp.at(time()) * settings_.velocity;
    for (int t = 0; t < count(); ++t) push(t, felt(t, normals_.col(t).dot(wind - mean(before(), t))), forces);
    return work_of(forces / 2, x - start(), dofs);
  }

 private:
  int count() const { return static_cast<int>(triangles_.size()); }
  Vec3 mean(const VecX& x, int t) const {
    const auto [a, b, c] = tack::corners(x, triangles_[t]);
    return (a + b + c) / 3;
  }
  void push(int t, double u, VecX& forces) const {
    for (const int v : triangles_[t]) vertex(forces, v) += factors_(t) / 3 * std::abs(u) * u * normals_.col(t);
  }
  // The part of a speed along the normal that pushes: on a closed surface the one that comes from outside.
  double felt(int t, double u) const { return t < open_ ? u : std::min(u, 0.0); }
  double towards(const VecX& x, int t) const { return felt(t, still_(t) - after().rate * normals_.col(t).dot(mean(x, t))); }

  const WindSettings& settings_;
  std::vector<Triangle> triangles_;  // those with two sides, then those with an outside
  int open_;                         // how many have two sides
  Eigen::Matrix3Xd normals_;
  VecX factors_, still_, first_;  // rho c_d A / 2; u of a triangle at the origin; u at the start of the step
};

class Wind : public Load {
 public:
  void fields(Fields& f) override {
    f.vector("velocity", settings_.velocity, units::velocity, "velocity of the medium; zero: drag of a medium at rest");
    settings_.ramp.fields(f, "ramp", "factor of the velocity over time");
    f.number("density", settings_.density, units::density, "density of the medium; that of air unless given").positive();
    f.number("drag", settings_.drag, units::none, "c_d of a face normal to the flow: windward pressure over 1/2 density speed^2; a sphere then has "
                                                  "1/2 of it, a cylinder across the flow 2/3").positive();
    f.component("select", select_, "vertices; triangles with all three selected are exposed");
  }
  std::unique_ptr<FollowingLoad> make_term(const Body& body, const VecX& rest, const VecX&) const override {
    const ExposedTriangles exposed = exposed_triangles(*select_, {body, rest});
    if (exposed.open.empty() && exposed.closed.empty())
      throw InputError("object '" + body.name + "': its wind's selection holds no whole triangle of an outer surface; widen it (rods and particles have no surface that wind acts on)");
    return std::make_unique<WindTerm>(settings_, exposed);
  }

 private:
  WindSettings settings_;
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
};

TACK_REGISTER(Load, Wind, "wind", "Drag of a medium on surfaces, along their normals, quadratic in the relative normal speed: on both sides of "
                                  "sheets, on the windward side of solids and closed sheets.", "");

}  // namespace
}  // namespace tack
