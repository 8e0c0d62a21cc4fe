// Signed distances to primitives about the origin: negative inside, exact everywhere. Lengths in
// metres. Axes are along y.
#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/types.hpp"

namespace tack {

inline double sphere_distance(const Vec3& p, double radius) { return p.norm() - radius; }

inline double box_distance(const Vec3& p, const Vec3& half) {
  const Vec3 q = p.cwiseAbs() - half;
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

inline double segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 e = b - a;
  const double length = e.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(e) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * e).norm();
}

inline double segment_distance(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 e = b - a;
  const double length = e.squaredNorm();
  const double t = length > 0 ? std::clamp((p - a).dot(e) / length, 0.0, 1.0) : 0.0;
  return (p - a - t * e).norm();
}

inline double torus_distance(const Vec3& p, double radius, double tube) {
  return std::hypot(std::hypot(p.x(), p.z()) - radius, p.y()) - tube;
}

// Returns the distance to a frustum with radii at y = -height / 2 and height / 2, one of which may
// be zero.
inline double cone_distance(const Vec3& p, double bottom, double top, double height) {
  const Vec2 q(std::hypot(p.x(), p.z()), p.y());
  const Vec2 low(bottom, -height / 2), high(top, height / 2);
  const double side = segment_distance(q, low, high);
  const double lid = segment_distance(q, Vec2(0, high.y()), high),
               floor = segment_distance(q, Vec2(0, low.y()), low);
  const Vec2 e = high - low, d = q - low;
  const bool inside = std::abs(q.y()) <= height / 2 && d.x() * e.y() - d.y() * e.x() <= 0;
  const double distance = std::min({side, lid, floor});
  return inside ? -distance : distance;
}

// Returns the distance of the extrusion by 2 * half along z of a shape with the signed distance
// `flat` in the plane z = 0.
inline double extruded_distance(double flat, double z, double half) {
  const Vec2 q(flat, std::abs(z) - half);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

// Returns min(a, b), rounded where they differ by less than `blend`: at most blend / 4 below it,
// and no steeper than the steeper one.
inline double blended_min(double a, double b, double blend) {
  if (blend <= 0) return std::min(a, b);
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * blend / 4;
}

}  // namespace tack
