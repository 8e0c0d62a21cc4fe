// Additive continuous collision detection (ACCD), after Li et al. 2021, "Codimensional Incremental
// Potential Contact". Vertices move along linear trajectories x + t dx. t advances by lower bounds
// of the time in which the gap can close, each evaluated at the advanced positions, so that t never
// passes the target. The larger one of two bounds counts:
//  * gap / speed, with the relative speed of the fastest pair of vertices (the paper);
//  * the time in which a slab between the two primitives closes. It ignores motion along the slab,
//    and needs 1 to 7 times fewer iterations on random motions.
//
// gap(t) = distance(t) - min_distance [m]. The functions return a step t in [0, t_max] such that
//     gap >= gap_fraction_min * gap(0)  on all of [0, t],
// and t_max if no motion brings the primitives that close. The step ends before the first time of
// gap = gap_fraction_min * gap(0) by about 1-2% of gap(0), which also absorbs rounding errors. It
// may end earlier at the limit of iterations, never later. A pair that starts with gap <= 0 gets 0,
// or t_max if it has no relative motion.
//
// gap_fraction_min: fraction of the initial gap that must remain, in [0, 1). t_max >= 0.
// min_distance >= 0 [m]. Throws InputError for parameters outside these ranges.
#pragma once

#include <array>

#include "geometry/types.hpp"

namespace tack {

double point_point_accd(const Vec3& p0, const Vec3& p1, const Vec3& dp0, const Vec3& dp1,
                        double gap_fraction_min, double t_max, double min_distance = 0.0);

double point_edge_accd(const Vec3& p, const Vec3& e0, const Vec3& e1, const Vec3& dp,
                       const Vec3& de0, const Vec3& de1, double gap_fraction_min, double t_max,
                       double min_distance = 0.0);

double point_triangle_accd(const Vec3& p, const Vec3& t0, const Vec3& t1, const Vec3& t2,
                           const Vec3& dp, const Vec3& dt0, const Vec3& dt1, const Vec3& dt2,
                           double gap_fraction_min, double t_max, double min_distance = 0.0);

double edge_edge_accd(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0, const Vec3& eb1,
                      const Vec3& dea0, const Vec3& dea1, const Vec3& deb0, const Vec3& deb1,
                      double gap_fraction_min, double t_max, double min_distance = 0.0);

// The same by the vertices of both primitives: a point or an edge, and a point, an edge or a
// triangle.
inline double accd(const std::array<Vec3, 1>& a, const std::array<Vec3, 1>& b,
                   const std::array<Vec3, 1>& da, const std::array<Vec3, 1>& db,
                   double gap_fraction_min, double t_max, double min_distance = 0.0) {
  return point_point_accd(a[0], b[0], da[0], db[0], gap_fraction_min, t_max, min_distance);
}
inline double accd(const std::array<Vec3, 1>& a, const std::array<Vec3, 2>& b,
                   const std::array<Vec3, 1>& da, const std::array<Vec3, 2>& db,
                   double gap_fraction_min, double t_max, double min_distance = 0.0) {
  return point_edge_accd(a[0], b[0], b[1], da[0], db[0], db[1], gap_fraction_min, t_max,
                         min_distance);
}
inline double accd(const std::array<Vec3, 1>& a, const std::array<Vec3, 3>& b,
                   const std::array<Vec3, 1>& da, const std::array<Vec3, 3>& db,
                   double gap_fraction_min, double t_max, double min_distance = 0.0) {
  return point_triangle_accd(a[0], b[0], b[1], b[2], da[0], db[0], db[1], db[2], gap_fraction_min,
                             t_max, min_distance);
}
inline double accd(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b,
                   const std::array<Vec3, 2>& da, const std::array<Vec3, 2>& db,
                   double gap_fraction_min, double t_max, double min_distance = 0.0) {
  return edge_edge_accd(a[0], a[1], b[0], b[1], da[0], da[1], db[0], db[1], gap_fraction_min, t_max,
                        min_distance);
}

}  // namespace tack
