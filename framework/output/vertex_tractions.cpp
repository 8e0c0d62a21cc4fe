#include "framework/output/vertex_tractions.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "framework/contact/contact_system.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

// Fraction of the tributary area; a smaller contact area is not used.
constexpr double least_share = 0.02;

// Returns the contact area of each vertex [m^2].
VecX contact_areas(const World& world, const VecX& x) {
  if (world.contact) world.contact->require_at(x);
  // Stored in the first of three entries, as forces are collected.
  VecX areas = VecX::Zero(x.size());
  for (const ForceRecord& force : world.records.forces())
    if (force.add_areas) force.add_areas(x, areas);
  world.collect_on_meshes(areas);
  return areas(Eigen::seq(0, Eigen::last, 3));
}

// Surface around each vertex.
struct Surround {
  VecX areas;    // m^2; zero inside of solids
  VecX outward;  // 3n: a third of the area vectors of a solid's triangles; zero for other bodies
};

Surround surround_of(const World& world, const VecX& x) {
  Surround s{VecX::Zero(x.size() / 3), VecX::Zero(x.size())};
  for (const Body& body : world.bodies) {
    for (const Triangle& t : body.triangles) {
      const Vec3 a = vertex(x, t[0]), area = (vertex(x, t[1]) - a).cross(vertex(x, t[2]) - a) / 6;
      for (const int v : t) {
        s.areas(v) += area.norm();
        if (body.sheet.empty()) vertex(s.outward, v) += area;
      }
    }
    const double width = body.section ? body.section->contact_width() : 0;
    for (const Edge& e : body.edges)
      for (const int v : e) s.areas(v) += width * (vertex(x, e[1]) - vertex(x, e[0])).norm() / 2;
    for (const int v : body.points) s.areas(v) += std::numbers::pi * body.radius * body.radius;
  }
  return s;
}

// pressed (n): sign of the traction of bodies without inside; empty: all positive.
VecX tractions(const World& world, const VecX& x, const VecX& forces, const VecX& pressed) {
  const Surround around = surround_of(world, x);
  const VecX areas = contact_areas(world, x);
  VecX result = VecX::Constant(areas.size(), std::numeric_limits<double>::quiet_NaN());
  for (int v = 0; v < result.size(); ++v) {
    if (around.areas(v) <= 0) continue;
    const double area = areas(v) > least_share * around.areas(v) ? areas(v) : around.areas(v);
    const bool solid = !vertex(around.outward, v).isZero();
    const bool pulls = pressed.size() > 0 && (solid ? vertex(forces, v).dot(vertex(around.outward, v)) > 0 : pressed(v) < 0);
    result(v) = (pulls ? -1 : 1) * vertex(forces, v).norm() / area;
  }
  return result;
}

}  // namespace

VecX normal_pressures(const World& world, const VecX& x, const VecX& forces, std::string_view summand) {
  VecX pressed = VecX::Zero(x.size());
  for (const ForceRecord& force : world.records.forces())
    if (force.direction == ForceDirection::normal && force.add_compressions && force.has(summand)) force.add_compressions(x, summand, pressed);
  world.collect_on_meshes(pressed);
  return tractions(world, x, forces, pressed(Eigen::seq(0, Eigen::last, 3)));
}

VecX tangential_tractions(const World& world, const VecX& x, const VecX& forces) { return tractions(world, x, forces, {}); }

}  // namespace tack
