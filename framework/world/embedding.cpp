#include "framework/world/embedding.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "framework/body/extent.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/tet_coordinates.hpp"

namespace tack {
namespace {

std::vector<std::pair<int, double>> weights_on(const Tet& tet, const VecX& rest, const Vec3& point) {
  const auto w = tet_coordinates({vertex(rest, tet[0]), vertex(rest, tet[1]), vertex(rest, tet[2]), vertex(rest, tet[3])}, point);
  return {{tet[0], w[0]}, {tet[1], w[1]}, {tet[2], w[2]}, {tet[3], w[3]}};
}

double least(const std::vector<std::pair<int, double>>& weights) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [unused, w] : weights) least = std::min(least, w);
  return least;
}

// Removes weights below round-off, so that a point at a vertex depends on that vertex only.
void snap(std::vector<std::pair<int, double>>& weights) {
  constexpr double round_off = 1e-10;
  for (const auto& [v, w] : weights)
    if (std::abs(w - 1) < round_off) {
      const int same = v;
      weights = {{same, 1.0}};
      return;
    }
  std::erase_if(weights, [](const auto& entry) { return std::abs(entry.second) < round_off; });
}

}  // namespace

Embedding::Embedding(const World& world, int body)
    : world_(world), body_(world.bodies[body]), size_(extent_of(body_, world.rest).diagonal().norm()) {}

Embedding::Attachment Embedding::of(const Vec3& point) const {
  Attachment attachment;
  const Triangle* closest = nullptr;
  double least_square = std::numeric_limits<double>::infinity();
  for (const Triangle& t : body_.triangles) {
    const double d = point_triangle_distance(point, at(t[0]), at(t[1]), at(t[2]));
    if (d < least_square) least_square = d, closest = &t;
  }
  attachment.distance = closest ? std::sqrt(least_square) : std::numeric_limits<double>::infinity();
  if (!body_.frame.empty()) {
    attachment.on = weights_on({body_.frame[0], body_.frame[1], body_.frame[2], body_.frame[3]}, world_.rest, point);
  } else if (!body_.tets.empty()) {
    attachment.on = on_tets(point, closest);
    if (least(attachment.on) >= -touching) attachment.distance = 0;
  } else if (closest) {
    attachment.on = on_triangle(*closest, point);
    attachment.error = attachment.distance;
  }
  snap(attachment.on);
  return attachment;
}

// Uses the tetrahedron that contains the point, or else that of the nearest face.
std::vector<std::pair<int, double>> Embedding::on_tets(const Vec3& point, const Triangle* closest) const {
  const Tet* chosen = nullptr;
  for (const Tet& t : body_.tets) {
    if (least(weights_on(t, world_.rest, point)) >= -touching) return weights_on(t, world_.rest, point);
    if (closest && std::all_of(closest->begin(), closest->end(),
                               [&](int v) { return std::find(t.begin(), t.end(), v) != t.end(); }))
      chosen = &t;
  }
  return weights_on(*chosen, world_.rest, point);
}

std::vector<std::pair<int, double>> Embedding::on_triangle(const Triangle& t, const Vec3& point) const {
  const Vec3 a = at(t[0]), u = at(t[1]) - a, v = at(t[2]) - a;
  Eigen::Matrix<double, 3, 2> edges;
  edges << u, v;
  const Eigen::Vector2d w = (edges.transpose() * edges).inverse() * (edges.transpose() * (point - a));
  return {{t[0], 1 - w.sum()}, {t[1], w(0)}, {t[2], w(1)}};
}

}  // namespace tack
