// Continuous collision detection by additive steps (ACCD), after Li et al. 2021, "Codimensional
// Incremental Potential Contact": vertices move as x + t dx, and t advances by lower bounds of the
// time in which the gap can close, each evaluated at the advanced positions, so t never passes the
// target. Two bounds are used, the larger counts: the paper's, gap / speed, with the fastest pair
// of vertices for the speed; and the time in which a slab between the two primitives closes, which
// ignores motion along it (on random motions 1 to 7 times fewer iterations).
//
// gap(t) = distance(t) - min_distance [m]. The result is a step t in [0, t_max] such that
// gap >= keep * gap(0) on all of [0, t]; t_max if nothing approaches that far. It stops short
// of the first time at which gap = keep * gap(0) by about 1-2% of gap(0), which also absorbs
// rounding. It may stop earlier when the bound on iterations is hit, never later. A pair that
// starts with gap <= 0 gets 0 unless it does not move relative to itself (then t_max).
//
// keep in [0, 1): fraction of the initial gap that must remain. t_max >= 0. min_distance >= 0 [m].
// Throws InputError for parameters outside these ranges.
#pragma once

#include "geometry/types.hpp"

namespace tack {

double point_point_accd(const Vec3& p0, const Vec3& p1, const Vec3& dp0, const Vec3& dp1,
                        double keep, double t_max, double min_distance = 0.0);

double point_edge_accd(const Vec3& p, const Vec3& e0, const Vec3& e1, const Vec3& dp,
                       const Vec3& de0, const Vec3& de1, double keep, double t_max,
                       double min_distance = 0.0);

double point_triangle_accd(const Vec3& p, const Vec3& t0, const Vec3& t1, const Vec3& t2,
                           const Vec3& dp, const Vec3& dt0, const Vec3& dt1, const Vec3& dt2,
                           double keep, double t_max, double min_distance = 0.0);

double edge_edge_accd(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0, const Vec3& eb1,
                      const Vec3& dea0, const Vec3& dea1, const Vec3& deb0, const Vec3& deb1,
                      double keep, double t_max, double min_distance = 0.0);

}  // namespace tack
