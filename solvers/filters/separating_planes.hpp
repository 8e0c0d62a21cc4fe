// Bounds of the steps of two primitives whose vertices move by different fractions.
//
// Planes: with the closest points a and b of two convex primitives at the distance d, the first one
// lies in {n . (x - a) <= 0}, the second in {n . (x - b) >= 0}, n = (b - a) / d. If each may use
// its share of the part of the gap that may be lost, along n, both stay on their sides of a slab
// between them, whatever fraction of its displacement each vertex makes. What a vertex lies behind
// its plane is its own.
// Source of the idea: planes between close primitives bound vertices one by one, as in
// divide-and-truncate methods (Chen et al. 2025, Offset Geometric Contact, use spheres).
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "framework/core/step_cuts.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/types.hpp"

namespace tack {

/// Bound of the step of a unit of motion (step_cuts.hpp).
struct UnitBound {
  int unit;
  double step;
};

/// Returns the units of vertices; -1 where the displacement is zero.
template <size_t N>
std::array<int, N> moving_units(const MotionUnits& units, const std::array<int, N>& vertices,
                                const std::array<Vec3, N>& displacements) {
  std::array<int, N> all;
  for (size_t i = 0; i < N; ++i)
    all[i] = displacements[i].isZero(0) ? -1 : units.of_vertex[vertices[i]];
  return all;
}

/// Returns true if at most one unit moves vertices of two primitives (-1: at rest).
template <size_t A, size_t B>
bool same_unit(const std::array<int, A>& a, const std::array<int, B>& b) {
  int first = -1;
  for (const std::span<const int> units : {std::span<const int>(a), std::span<const int>(b)})
    for (const int unit : units) {
      if (unit < 0) continue;
      if (first >= 0 && unit != first) return false;
      first = unit;
    }
  return true;
}

template <size_t N>
double largest_norm(const std::array<Vec3, N>& vectors) {
  double largest = 0;
  for (const Vec3& v : vectors) largest = std::max(largest, v.squaredNorm());
  return std::sqrt(largest);
}

/// Returns the closest points of two primitives: two edges, or a point and a point, edge or
/// triangle.
template <size_t A, size_t B>
std::array<Vec3, 2> closest_points(const std::array<Vec3, A>& a, const std::array<Vec3, B>& b) {
  if constexpr (A == 2) {
    const Vec2 uv = edge_edge_parameters(a[0], a[1], b[0], b[1]);
    return {a[0] + uv[0] * (a[1] - a[0]), b[0] + uv[1] * (b[1] - b[0])};
  } else if constexpr (B == 3) {
    const Vec3 l = point_triangle_barycentric(a[0], b[0], b[1], b[2]);
    return {a[0], l[0] * b[0] + l[1] * b[1] + l[2] * b[2]};
  } else if constexpr (B == 2) {
    return {a[0], b[0] + point_edge_parameter(a[0], b[0], b[1]) * (b[1] - b[0])};
  } else {
    return {a[0], b[0]};
  }
}

/// Appends the bounds that keep two primitives on their sides of the planes between them. a, b:
/// vertices [m]; da, db: their displacements [m]; ua, ub: their units; offset: the part of the
/// distance that is no gap [m]; kept: the fraction of the gap that must remain.
template <size_t A, size_t B>
void bound_by_planes(const std::array<Vec3, A>& a, const std::array<Vec3, B>& b,
                     const std::array<Vec3, A>& da, const std::array<Vec3, B>& db,
                     const std::array<int, A>& ua, const std::array<int, B>& ub, double offset,
                     double kept, std::vector<UnitBound>& bounds) {
  const auto [pa, pb] = closest_points(a, b);
  const double distance = (pb - pa).norm(), usable = (1 - kept) * (distance - offset);
  const Vec3 normal = distance > 0 ? Vec3((pb - pa) / distance) : Vec3::Zero();
  // Calls act(unit, approach along the normal, how far it lies behind its plane) per vertex.
  const auto each = [&](const auto& x, const auto& d, const auto& units, const Vec3& plane,
                        double side, const auto& act) {
    for (size_t i = 0; i < x.size(); ++i)
      if (units[i] >= 0)
        act(units[i], side * normal.dot(d[i]), std::max(0.0, side * normal.dot(plane - x[i])));
  };
  double need_a = 0, need_b = 0;
  each(a, da, ua, pa, 1,
       [&](int, double approach, double behind) { need_a = std::max(need_a, approach - behind); });
  each(b, db, ub, pb, -1,
       [&](int, double approach, double behind) { need_b = std::max(need_b, approach - behind); });
  if (usable > 0 && need_a + need_b <= usable) return;
  const double share = need_a + need_b > 0 ? need_a / (need_a + need_b) : 0;
  const auto bound = [&](double room) {
    return [&, room](int unit, double approach, double behind) {
      if (!(usable > 0)) bounds.push_back({unit, 0});
      else if (approach > room + behind) bounds.push_back({unit, (room + behind) / approach});
    };
  };
  each(a, da, ua, pa, 1, bound(usable * share));
  each(b, db, ub, pb, -1, bound(usable * (1 - share)));
}

/// Appends the bound of each unit that moves vertices of two primitives, the others at rest.
/// accd(da, db): largest step of the two primitives for these displacements.
template <size_t A, size_t B, class Accd>
void bound_alone(const std::array<Vec3, A>& da, const std::array<Vec3, B>& db,
                 const std::array<int, A>& ua, const std::array<int, B>& ub, const Accd& accd,
                 std::vector<UnitBound>& bounds) {
  std::array<int, A + B> units;
  std::copy(ub.begin(), ub.end(), std::copy(ua.begin(), ua.end(), units.begin()));
  for (size_t i = 0; i < units.size(); ++i) {
    const int unit = units[i];
    if (unit < 0 || std::find(units.begin(), units.begin() + i, unit) != units.begin() + i)
      continue;
    std::array<Vec3, A> own_a;
    std::array<Vec3, B> own_b;
    for (size_t k = 0; k < A; ++k) own_a[k] = ua[k] == unit ? da[k] : Vec3::Zero();
    for (size_t k = 0; k < B; ++k) own_b[k] = ub[k] == unit ? db[k] : Vec3::Zero();
    if (const double step = accd(own_a, own_b); step < 1) bounds.push_back({unit, step});
  }
}

}  // namespace tack
