#include "framework/checks/contact_approach.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/scene/copied_lines.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

constexpr double tolerated_softness = 0.05;  // of the approach
// Recommended contact distance over the one that would suffice if surfaces deformed equally with
// it. They deform less, because they press over a smaller zone.
constexpr double safe = 0.6;
constexpr double of_flattening = 7.6;        // approach over flattening
constexpr double least_curved = 0.02;        // of the barrier's distance
constexpr size_t fewest_points = 12;
constexpr double narrowest = 1e-3;  // the extent of a zone across, over that along, squared: less is a line
// Least mean of heights over their root mean square: 0.85 for a sphere or a cylinder, less for a
// flat zone with a folded edge.
constexpr double evenly = 0.7;

struct Plane {
  Vec3 middle = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  // the normal last
  bool wide = false;             // the points are in no line

  double height(const Vec3& x) const { return axes.col(2).dot(x - middle); }
  Eigen::Vector2d along(const Vec3& x) const { return axes.leftCols<2>().transpose() * (x - middle); }
  void turn_over() { axes.rightCols<2>() *= -1; }
};

template <class Place>
Plane nearest_plane(const std::vector<PressedPoint>& points, const Place& place) {
  Plane plane;
  double force = 0;
  for (const PressedPoint& p : points) plane.middle += p.force * place(p), force += p.force;
  plane.middle /= force;
  Mat3 spread = Mat3::Zero();
  for (const PressedPoint& p : points) {
    const Vec3 off = place(p) - plane.middle;
    spread += p.force * off * off.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(spread);
  plane.axes = solver.eigenvectors().rowwise().reverse();
  if (plane.axes.determinant() < 0) plane.axes.col(0) *= -1;
  plane.wide = solver.eigenvalues()(1) > narrowest * solver.eigenvalues()(2);
  return plane;
}

// Best-fit planes of one of the two surfaces at rest and now; `way` points to their outside now.
struct Planes {
  Plane rest, now;

  Planes(const std::vector<PressedPoint>& points, int side, const Vec3& way)
      : rest(nearest_plane(points, [side](const PressedPoint& p) -> const Vec3& { return p.rest[side]; })),
        now(nearest_plane(points, [side](const PressedPoint& p) -> const Vec3& { return p.now[side]; })) {
    if (now.axes.col(2).dot(way) < 0) now.turn_over();
    Eigen::Matrix2d turn = Eigen::Matrix2d::Zero();
    for (const PressedPoint& p : points) turn += p.force * now.along(p.now[side]) * rest.along(p.rest[side]).transpose();
    if (turn.determinant() < 0) rest.turn_over();
  }
  bool wide() const { return rest.wide && now.wide; }
};

// Returns whether a body is soft: only bodies of elastic tets are. Other surfaces keep their shape
// if they are fixed or affine.
bool is_soft(const ObjectConfig& object, const Body& body) {
  return !body.tets.empty() && body.sheet.empty() && body.movable && body.frame.empty() &&
         std::any_of(object.energies.begin(), object.energies.end(), [](const auto& energy) { return energy->poisson().has_value(); });
}
bool is_firm(const Body& body) { return !body.movable || !body.frame.empty(); }

}  // namespace

PressedZone pressed_zone(const std::vector<PressedPoint>& points) {
  PressedZone zone;
  double force = 0;
  Vec3 way = Vec3::Zero();
  for (const PressedPoint& p : points) {
    const Vec3 apart = p.now[1] - p.now[0];
    zone.gap += p.force * apart.norm();
    way += p.force * apart.normalized();
    force += p.force;
  }
  zone.gap /= force;
  if (points.size() < fewest_points) return zone;
  const Planes a(points, 0, way), b(points, 1, way);
  if (!a.wide() || !b.wide()) return zone;
  double mean = 0, square = 0, change = 0;
  for (const PressedPoint& p : points) {
    const double rest = b.rest.height(p.rest[1]) - a.rest.height(p.rest[0]), now = b.now.height(p.now[1]) - a.now.height(p.now[0]);
    mean += p.force * std::abs(rest);
    square += p.force * rest * rest;
    change += p.force * (now - rest) * (now - rest);
  }
  const double curved = std::sqrt(square / force);
  if (mean / force < evenly * curved) return zone;
  zone.curved = curved;
  zone.flattened = std::sqrt(change / force);
  return zone;
}

ContactApproach::ContactApproach(const SceneConfig& scene, const World& world) : scene_(scene), world_(world) {
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    const bool surface = !body.triangles.empty() && body.edges.empty() && body.points.empty();
    soft_.push_back(surface && is_soft(scene.objects[i], body));
    firm_.push_back(surface && is_firm(body));
  }
  if (std::find(soft_.begin(), soft_.end(), 1) == soft_.end()) return;
  for (const PairLaw& adhesion : world.contact->pairs().laws(LawTerm::adhesion)) wanted_.push_back(adhesion.laws().empty());
}

bool ContactApproach::is_examined(const Objects& objects) const {
  const auto [a, b] = objects;
  if (a == b || !((soft_[a] && (soft_[b] || firm_[b])) || (firm_[a] && soft_[b]))) return false;
  const PairTable& pairs = world_.contact->pairs();
  const auto adheres = [&](int law) { return law >= 0 && !wanted_[law]; };
  for (int part = -1; part < pairs.region_pair_count(a, b); ++part)
    if (adheres(pairs.point(a, b, part).law) || adheres(pairs.point(b, a, part).law)) return false;
  return true;
}

std::map<ContactApproach::Objects, std::vector<PressedPoint>> ContactApproach::zones(const VecX& x) const {
  const VecX& rest = world_.contact->surface().rest;
  const ContactPoints contacts = contact_points({*world_.contact, wanted_, x});
  std::map<Objects, std::vector<PressedPoint>> zones;
  for_each_record(contacts, [&](const auto& c) {
    const Objects objects = std::minmax(c.object, c.opposite);
    if (c.kind() == PointKind::edges || !(c.normal_force > 0) || !is_examined(objects)) return;
    PressedPoint p{{Vec3::Zero(), Vec3::Zero()}, {Vec3::Zero(), Vec3::Zero()}, c.normal_force};
    for (int i = 0; i < static_cast<int>(c.vertices.size()); ++i) {
      const bool own = i < c.own_vertex_count;
      const int side = own == (c.object == objects.first) ? 0 : 1;
      const double weight = own ? c.coefficients[i] : -c.coefficients[i];
      p.rest[side] += weight * vertex(rest, c.vertices[i]);
      p.now[side] += weight * vertex(x, c.vertices[i]);
    }
    zones[objects].push_back(p);
  });
  return zones;
}

void ContactApproach::examine(const VecX& x) {
  if (wanted_.empty()) return;
  for (const auto& [objects, points] : zones(x)) {
    double force = 0;
    for (const PressedPoint& p : points) force += p.force;
    Pressed& pressed = pressed_[objects];
    if (force <= pressed.force) continue;
    const PairTable& pairs = world_.contact->pairs();
    const auto [a, b] = objects;
    const double range = std::max(pairs.point(a, b).range_max(), pairs.point(b, a).range_max()), distance = range - pairs.offset(a, b);
    const PressedZone zone = pressed_zone(points);
    const bool curved = zone.curved > least_curved * distance;
    pressed = {force, curved ? range - zone.gap : 0, curved ? of_flattening * zone.flattened : 0, distance};
  }
}

std::vector<Warning> ContactApproach::warnings() const {
  CopiedLines lines;
  for (const auto& [objects, p] : pressed_) {
    const double approach = p.barrier + p.elastic;
    if (!(p.barrier > tolerated_softness * approach)) continue;
    const auto [object, other] = soft_[objects.first] ? objects : Objects(objects.second, objects.first);
    lines.add(scene_.objects[object], WarningKind::soft_barrier,
               fmt::format("where '{}' and '{}' were pressed together, the barrier took {:.2g} m of their approach of {:.2g} m ({:.0f}%): contact.distance "
                           "({:.3g} m) is not small against what their curved surfaces give way by, and they seem softer than they are; take {:.1g} m or "
                           "less, or raise contact.barrier.stiffness",
                           world_.bodies[object].name, world_.bodies[other].name, p.barrier, approach, 100 * p.barrier / approach, p.distance,
                           safe * tolerated_softness * p.elastic * p.distance / p.barrier));
  }
  return lines.warnings();
}

}  // namespace tack
