// Fast proof that a segment and a triangle are disjoint: an axis on which their projections are
// apart by more than the rounding error. The axes are the triangle's normal, the three in-plane
// normals of its edges and the three cross products of its edges with the segment. In exact
// arithmetic these axes suffice, except for parallel or degenerate pairs.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "geometry/types.hpp"

namespace tack {

// Returns true only if the closed segment pq and the closed triangle abc are certainly disjoint.
// On any axis, the projection of a difference of size m has an error below 8 eps |axis|_1 m, so
// that rounding of the axis itself has no effect.
inline bool certainly_disjoint(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b,
                               const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, aq = q - a;
  const double size = std::max({ab.cwiseAbs().maxCoeff(), ac.cwiseAbs().maxCoeff(),
                                ap.cwiseAbs().maxCoeff(), aq.cwiseAbs().maxCoeff()});
  const double tolerance = 16.0 * std::numeric_limits<double>::epsilon() * size;
  const auto separates = [&](const Vec3& axis) {
    const double sb = axis.dot(ab), sc = axis.dot(ac), sp = axis.dot(ap), sq = axis.dot(aq);
    const double gap = std::max(std::min(sp, sq) - std::max({0.0, sb, sc}),
                                std::min({0.0, sb, sc}) - std::max(sp, sq));
    return gap > tolerance * axis.lpNorm<1>();
  };
  const Vec3 normal = ab.cross(ac), bc = c - b, pq = q - p;
  return separates(normal) || separates(normal.cross(ab)) || separates(normal.cross(ac)) ||
         separates(normal.cross(bc)) || separates(pq.cross(ab)) || separates(pq.cross(ac)) ||
         separates(pq.cross(bc));
}

}  // namespace tack
