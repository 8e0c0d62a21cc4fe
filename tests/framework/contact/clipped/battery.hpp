// Two bodies that adhere, placed vertex by vertex, for comparison of energies and forces with
// closed forms. Lengths are in ranges of the law. The planes of the lower body are y = 0 unless
// stated.
#pragma once

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/contact/adhesion_law.hpp"
#include "framework/contact/normal_law.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"

namespace tack::battery {

inline constexpr double range = 2e-3, contact_distance = 2e-5;  // m
inline constexpr double away = 0.5;  // height of the upper body at rest [m]
inline const std::string triangular_traction =
    "{type: fang, peak_traction: 1 kPa, peak_distance: 1 mm}";

// Size and cells of a box, in ranges; its centre is the origin.
inline std::string box(const Vec3& size, const std::array<int, 3>& cells) {
  return fmt::format(
      "shape: {{type: box, size: [{}, {}, {}], cells: [{}, {}, {}]}}, energies: [{{type: "
      "neo_hookean, young: 1e5}}]",
      size.x() * range, size.y() * range, size.z() * range, cells[0], cells[1], cells[2]);
}
// A sheet of any shape.
inline std::string sheet(const std::string& shape) {
  return fmt::format(
      "shape: {}, shell: {{thickness: 0.01 mm}}, energies: [{{type: neo_hookean_membrane, young: "
      "1e5}}]",
      shape);
}
inline std::string grid(double width, double depth, int cells_x, int cells_z) {
  return sheet(fmt::format("{{type: grid, size: [{}, {}], cells: [{}, {}]}}", width * range,
                           depth * range, cells_x, cells_z));
}

struct Measured {
  double energy;       // J
  Vec3 force;          // on the upper body [N]
  double net, moment;  // of all forces, over the sum of their magnitudes (and 10 ranges)
};

// Position in ranges -> position in ranges.
using Placement = std::function<Vec3(const Vec3&)>;

class Bodies {
 public:
  Bodies(const std::string& integral, const std::string& upper, const std::string& lower,
         const std::string& law = triangular_traction)
      : scene_(fmt::format("objects:\n  - {{name: upper, {}, place: {{translate: [0, {}, 0]}}}}\n  "
                           "- {{name: lower, {}}}\n"
                           "contact: {{distance: {}, model: {}, pairs: [{{between: [upper, "
                           "lower], adhesion: {}}}]}}\n",
                           upper, away, lower, contact_distance, integral, law)) {}

  World& world() { return *scene_.world; }
  int upper_vertices() const { return scene_.world->bodies[0].vertex_count; }
  VecX placed(const Placement& upper, const Placement& lower) const {
    VecX x = scene_.world->rest;
    for (int v = 0; v < x.size() / 3; ++v) {
      const bool above = v < upper_vertices();
      const Vec3 own = (vertex(x, v) - Vec3(0, above ? away : 0, 0)) / range;
      vertex(x, v) = range * (above ? upper(own) : lower(own));
    }
    return x;
  }
  VecX forces(const VecX& x) {
    VecX all = VecX::Zero(x.size());
    world().records.add_forces(ForceDirection::normal, x, "adhesion", all);
    return all;
  }
  double energy(const VecX& x) {
    double sum = 0;
    for (const EnergyRecord& record : world().records.energies())
      if (record.name == "adhesion") sum += record.value(x);
    return sum;
  }
  void begin_step(const VecX& x) {
    world().participants.begin_step({x, 0, 1e-3});
    world().participants.move_to(x);
  }
  Measured at(const VecX& x) {
    begin_step(x);
    const VecX all = forces(x);
    const double scale = std::max(all.cwiseAbs().sum(), 1e-30);
    Measured m{energy(x), Vec3::Zero(), total(all).norm() / scale,
               total_moment(x, all).norm() / (10 * range * scale)};
    for (int v = 0; v < upper_vertices(); ++v) m.force += vertex(all, v);
    return m;
  }
  Measured at(const Placement& upper, const Placement& lower) { return at(placed(upper, lower)); }

 private:
  TestScene scene_;
};

// Energy per area of a gap, and its derivatives; the gap in ranges.
inline LawSample law_at(double gap, const std::string& law = triangular_traction) {
  const auto adhesion = bind_component<AdhesionLaw>(parse_string(law, "law"));
  NormalLaw& normal = dynamic_cast<NormalLaw&>(*adhesion);
  normal.prepare({contact_distance, 1e5, 0});
  return normal.at(gap * range);
}

// Exact energy [J] and normal force [N]: int of phi and phi' over density(s) ds for gaps g(s), s
// from 0 to `end`; the density is an area per length in ranges.
struct Exact {
  double energy = 0, normal = 0;
};
inline Exact integrate(double end, const std::function<double(double)>& gap,
                       const std::function<double(double)>& density,
                       const std::string& law = triangular_traction) {
  constexpr int points = 20000;
  const auto adhesion = bind_component<AdhesionLaw>(parse_string(law, "law"));
  NormalLaw& normal = dynamic_cast<NormalLaw&>(*adhesion);
  normal.prepare({contact_distance, 1e5, 0});
  Exact exact;
  for (int i = 0; i < points; ++i) {
    const double s = (i + 0.5) / points * end, area = density(s) * end / points * range * range;
    const LawSample sample = normal.at(gap(s) * range);
    exact.energy += area * sample.value;
    exact.normal += area * sample.slope;
  }
  return exact;
}
inline Exact even(double area, double gap, const std::string& law = triangular_traction) {
  const LawSample sample = law_at(gap, law);
  return {area * range * range * sample.value, area * range * range * sample.slope};
}

// Placements.
inline Placement shifted(const Vec3& by) {
  return [by](const Vec3& p) { return Vec3(p + by); };
}
inline Placement turned(double angle, const Vec3& axis, const Vec3& shift) {
  const Mat3 rotation = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  return [rotation, shift](const Vec3& p) { return Vec3(rotation * p + shift); };
}
// Moves vertices inside of the outline along x and z, by a fraction of a cell, before a placement.
inline Placement irregular(double width, double depth, int cells, double fraction,
                           const Placement& then) {
  return [=](const Vec3& p) {
    if (std::abs(p.x()) > 0.4999 * width || std::abs(p.z()) > 0.4999 * depth) return then(p);
    const double at = 12.9898 * p.x() + 78.233 * p.z();
    const Vec3 by(std::sin(437.58 * at), 0, std::sin(191.7 * at + 1));
    return then(p + fraction / cells * Vec3(width * by.x(), 0, depth * by.z()));
  };
}

// Ratios to the exact values, and errors of the lateral force and of the balance.
struct Ratios {
  double energy_low = std::numeric_limits<double>::infinity(), energy_high = -energy_low;
  double normal_low = energy_low, normal_high = -energy_low;
  double lateral = 0;  // largest error of the lateral force, over `lateral_scale`
  double net = 0;      // largest net force and moment

  // The pull down is the normal force. lateral: exact force on the upper body along x and z [N].
  void add(const Measured& m, const Exact& exact, const Vec2& lateral_exact, double lateral_scale) {
    const double energy = m.energy / exact.energy, normal = -m.force.y() / exact.normal;
    energy_low = std::min(energy_low, energy);
    energy_high = std::max(energy_high, energy);
    normal_low = std::min(normal_low, normal);
    normal_high = std::max(normal_high, normal);
    lateral = std::max(
        lateral, (Vec2(m.force.x(), m.force.z()) - lateral_exact).norm() / std::abs(lateral_scale));
    net = std::max({net, m.net, m.moment});
  }
  double energy_error() const {
    return std::max(std::abs(energy_low - 1), std::abs(energy_high - 1));
  }
  double normal_error() const {
    return std::max(std::abs(normal_low - 1), std::abs(normal_high - 1));
  }
};

// Bounds of errors; 0: not bounded.
struct ErrorBounds {
  double energy = 0, normal = 0, lateral = 0;
};
struct Row {
  std::string name;
  std::function<Ratios(const std::string& integral)> measure;
  ErrorBounds clipped, lagged;
};

inline void print_table(const std::vector<Row>& rows) {
  fmt::print("{:42} {:13} {:>15} {:>15} {:>8} {:>8}\n", "case", "model", "energy", "normal force",
             "lateral", "balance");
  for (const Row& row : rows)
    for (const char* integral : {"clipped", "area_integral"}) {
      const Ratios r = row.measure(integral);
      fmt::print("{:42} {:13} {:.5f}-{:.5f} {:.5f}-{:.5f} {:8.1e} {:8.1e}\n", row.name, integral,
                 r.energy_low, r.energy_high, r.normal_low, r.normal_high, r.lateral, r.net);
    }
}

// Bounds hold, and all forces and moments add up to zero: for clipped to round-off.
inline void check(const std::vector<Row>& rows) {
  for (const Row& row : rows)
    for (const auto& [integral, bounds] :
         {std::pair("clipped", row.clipped), std::pair("area_integral", row.lagged)}) {
      const Ratios r = row.measure(integral);
      INFO(row.name << ", " << integral << ": energy " << r.energy_low << " to " << r.energy_high
                    << ", normal force " << r.normal_low << " to " << r.normal_high
                    << ", lateral force off by " << r.lateral);
      if (bounds.energy > 0) CHECK(r.energy_error() <= bounds.energy);
      if (bounds.normal > 0) CHECK(r.normal_error() <= bounds.normal);
      if (bounds.lateral > 0) CHECK(r.lateral <= bounds.lateral);
      CHECK(r.net <= 1e-11);
    }
}

}  // namespace tack::battery
