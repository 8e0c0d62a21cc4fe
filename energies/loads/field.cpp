// Force by formulas of position, time and velocity, which need not have a potential. A step that starts at x_n with the velocities v_n has the force
//     f_n + A (x - x_n) + B (v - v_n),    v = rate (x - still) the velocities at its end,
// where A and B are the derivatives by position and velocity, made symmetric and negative semi-definite. Restoring and braking forces are thus
// implicit, driving forces explicit. This force has a potential. It is exact for linear springs and dampers, and of first order otherwise.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "framework/body/chosen_vertices.hpp"
#include "framework/body/extent.hpp"
#include "framework/config/formula.hpp"
#include "framework/body/selection.hpp"
#include "framework/config/field.hpp"
#include "framework/load/following_load.hpp"
#include "framework/world/load.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

struct FieldFormulas {
  std::array<std::string, 3> text = {"0", "0", "0"};
  std::map<std::string, Quantity> parameters;
  std::vector<Formula> compiled;
  bool of_velocity = false;

  std::vector<std::string> variables() const {
    std::vector<std::string> names{"t", "x", "y", "z", "vx", "vy", "vz"};
    for (const auto& [name, value] : parameters) names.push_back(name);
    return names;
  }
  std::string compile() {
    compiled.clear();
    of_velocity = false;
    const std::vector<std::string> own{"t", "x", "y", "z", "vx", "vy", "vz", "pi"};
    for (const auto& [name, value] : parameters)
      if (std::find(own.begin(), own.end(), name) != own.end()) return fmt::format("the parameter '{}' is something else in formulas already; take another name", name);
    try {
      for (const std::string& formula : text) {
        compiled.emplace_back(formula, variables());
        for (const char* v : {"vx", "vy", "vz"}) of_velocity = of_velocity || formula.find(v) != std::string::npos;
      }
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  Vec3 at(double t, const Vec3& x, const Vec3& v) const {
    std::vector<double> values{t, x.x(), x.y(), x.z(), v.x(), v.y(), v.z()};
    for (const auto& [name, value] : parameters) values.push_back(value);
    Vec3 f;
    for (int i = 0; i < 3; ++i) f(i) = compiled[i](values);
    if (!(f.norm() < 1e100))
      throw SimulationError(fmt::format("the field ({}) is no finite force at t = {:.6g} s, ({:.6g}, {:.6g}, {:.6g}) m: {:.3g}, {:.3g}, {:.3g}", fmt::join(text, ", "),
                                        t, x.x(), x.y(), x.z(), f.x(), f.y(), f.z()));
    return f;
  }
};

// Returns the symmetric part without positive eigenvalues.
Mat3 resisting(const Mat3& m) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen((m + m.transpose()) / 2);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMin(0).asDiagonal() * eigen.eigenvectors().transpose();
}

class FieldTerm : public FollowingLoad {
 public:
  // weights: per vertex, mass, volume or 1 as the formulas ask; size: extent of the vertices [m].
  FieldTerm(const FieldFormulas& formulas, std::vector<int> vertices, VecX weights, double size)
      : FollowingLoad("field"), formulas_(formulas), vertices_(std::move(vertices)), weights_(std::move(weights)), step_(1e-5 * size) {}
  bool needs_velocities() const override { return formulas_.of_velocity; }

  void begin_step(const StepStart& start) override {
    FollowingLoad::begin_step(start);
    const double t = start.time + start.h;
    forces_.resize(3, count());
    by_place_.resize(vertices_.size());
    by_velocity_.assign(vertices_.size(), Mat3::Zero());
    for (int i = 0; i < count(); ++i) {
      const Vec3 x = vertex(start.x, vertices_[i]), v = vertex(before(), vertices_[i]);
      forces_.col(i) = weights_(i) * formulas_.at(t, x, v);
      Mat3 by_place;
      for (int k = 0; k < 3; ++k) {
        const Vec3 d = step_ * Vec3::Unit(k);
        by_place.col(k) = (formulas_.at(t, x + d, v) - formulas_.at(t, x - d, v)) / (2 * step_);
      }
      by_place_[i] = weights_(i) * resisting(by_place);
      if (after().rate == 0) continue;
      Mat3 by_velocity;
      const double change = 1e-5 * std::max(v.norm(), 1e-3);
      for (int k = 0; k < 3; ++k) {
        const Vec3 d = change * Vec3::Unit(k);
        by_velocity.col(k) = (formulas_.at(t, x, v + d) - formulas_.at(t, x, v - d)) / (2 * change);
      }
      by_velocity_[i] = weights_(i) * resisting(by_velocity);
    }
  }

  double value(const VecX& x) const override {
    double sum = 0;
    for (int i = 0; i < count(); ++i) {
      const Vec3 d = way(x, i), now = changed(x, i), then = changed(start(), i);
      sum -= d.dot(forces_.col(i) + by_place_[i] * d / 2);
      if (after().rate > 0) sum -= (now.dot(by_velocity_[i] * now) - then.dot(by_velocity_[i] * then)) / (2 * after().rate);
    }
    return sum;
  }
  std::vector<StencilBatch> batches() const override { return {{1, count(), vertices_.data()}}; }
  void derivatives(const VecX& x, Projection, double* gradient, double* hessian) const override {
    for (int i = 0; i < count(); ++i) {
      Eigen::Map<Vec3>{gradient + 3 * static_cast<size_t>(i)} = -(forces_.col(i) + by_place_[i] * way(x, i) + by_velocity_[i] * changed(x, i));
      if (hessian) Eigen::Map<Mat3>{hessian + 9 * static_cast<size_t>(i)} = -by_place_[i] - after().rate * by_velocity_[i];
    }
  }
  // For a step that ends at x.
  void add_forces(const VecX& x, double part, VecX& sum) const override {
    for (int i = 0; i < count(); ++i) {
      const int v = vertices_[i];
      vertex(sum, v) += weights_(i) * formulas_.at(time() + part * h(), vertex(start(), v) + part * way(x, i), vertex(before(), v) + part * changed(x, i));
    }
  }
  double work(const VecX& x, const DofMap& dofs) const override {
    VecX sum = VecX::Zero(x.size()), middle = sum;
    add_forces(x, 0, sum);
    add_forces(x, 0.5, middle);
    sum += 4 * middle;
    add_forces(x, 1, sum);
    return work_of(sum / 6, x - start(), dofs);
  }

 private:
  int count() const { return static_cast<int>(vertices_.size()); }
  Vec3 way(const VecX& x, int i) const { return vertex(x, vertices_[i]) - vertex(start(), vertices_[i]); }
  // Returns the change of velocity for a step that ends at x.
  Vec3 changed(const VecX& x, int i) const {
    const int v = vertices_[i];
    return after().rate * (vertex(x, v) - vertex(after().still, v)) - vertex(before(), v);
  }

  const FieldFormulas& formulas_;
  std::vector<int> vertices_;
  VecX weights_;
  double step_;  // m, of differences
  Eigen::Matrix3Xd forces_;
  std::vector<Mat3> by_place_, by_velocity_;
};

class FieldLoad : public Load {
 public:
  enum class Per { mass, volume, area, object };

  void fields(Fields& f) override {
    for (int i = 0; i < 3; ++i) {
      const std::string key(1, "xyz"[i]);
      f.text(key, formulas_.text[i], "component along " + key + ", a formula of t [s], the position x, y, z [m], the velocity vx, vy, vz [m/s] "
                                                                    "and the parameters, in SI")
          .formula({"t", "x", "y", "z", "vx", "vy", "vz"});
    }
    f.quantities("parameters", formulas_.parameters, "parameters of the formulas, with their units");
    f.choice("per", per_,
             {{"mass", Per::mass, "the formulas are accelerations [m/s^2]"},
              {"volume", Per::volume, "forces per volume at rest [N/m^3]"},
              {"area", Per::area, "forces per area of the surface at rest [Pa]"},
              {"object", Per::object, "the total force on the selection, distributed over its vertices by mass [N]"}},
             "reference quantity of the formulas");
    f.component("select", select_, "vertices");
    f.check("x", [this] { return formulas_.compile(); });
  }

  std::unique_ptr<FollowingLoad> make_term(const Body& body, const VecX& rest, const VecX& mass) const override {
    const std::vector<int> chosen = select(*select_, {body, rest});
    const double size = std::max(extent_of(body, rest).diagonal().norm(), body.radius);
    const bool whole = static_cast<int>(chosen.size()) == body.vertex_count;
    // The frame of an affine body has its mass.
    const bool framed = !body.frame.empty() && per_ != Per::area;
    if (framed && !whole)
      throw InputError("object '" + body.name + "': a field per mass or volume on part of an affine body has no meaning (its mass is that of the whole); select all of "
                       "it, or take `per: area`");
    const std::vector<int> on = framed ? body.frame : chosen;
    const VecX all = per_ == Per::area ? areas(body, rest, chosen) : per_ == Per::volume && !framed ? volumes(body, rest) : mass;
    VecX weights(on.size());
    for (size_t i = 0; i < on.size(); ++i) weights(static_cast<Eigen::Index>(i)) = all(on[i]);
    if (!(weights.sum() > 0))
      throw InputError(fmt::format("object '{}': what its field chooses has no {}; choose other vertices, or another `per`", body.name,
                                   per_ == Per::area ? "triangles of the surface" : per_ == Per::volume ? "tets or sheets with a thickness" : "mass"));
    if (per_ == Per::object) weights /= weights.sum();
    if (per_ == Per::volume && framed) weights *= body.volume / weights.sum();
    return std::make_unique<FieldTerm>(formulas_, on, std::move(weights), size > 0 ? size : 1);
  }

 private:
  static VecX areas(const Body& body, const VecX& rest, const std::vector<int>& chosen) {
    const ChosenVertices all(body, chosen);
    VecX sum = VecX::Zero(rest.size() / 3);
    for (const Triangle& t : body.triangles) {
      if (!all.contains(t)) continue;
      for (const int v : t) sum(v) += triangle_area(rest, t) / 3;
    }
    return sum;
  }
  // A quarter of each tet, a third of each piece of a sheet.
  static VecX volumes(const Body& body, const VecX& rest) {
    VecX sum = VecX::Zero(rest.size() / 3);
    for (size_t t = 0; t < body.tets.size(); ++t) {
      const auto [a, b, c, d] = tack::corners(rest, body.tets[t]);
      const double volume = body.references.empty() ? std::abs(tet_volume(a, b, c, d)) : body.references[t].volume;
      for (const int v : body.tets[t]) sum(v) += volume / 4;
    }
    for (const Triangle& t : body.sheet)
      for (const int v : t) sum(v) += body.thickness * triangle_area(rest, t) / 3;
    return sum;
  }

  FieldFormulas formulas_;
  Per per_ = Per::mass;
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
};

TACK_REGISTER(Load, FieldLoad, "field", "A force given by formulas of position, time and velocity.", "");

}  // namespace
}  // namespace tack
