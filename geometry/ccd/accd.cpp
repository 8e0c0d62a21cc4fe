#include "geometry/ccd/accd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Fractions of the closable gap (1 - gap_fraction_min) gap(0): steps aim at the first, iteration
// ends at the second.
constexpr double aim_fraction = 0.01;
constexpr double stop_fraction = 0.02;
constexpr int iterations_max = 1000;
// Upper bound of the rounding error of a signed distance per unit of coordinate.
constexpr double rounding_per_coordinate = 16.0 * std::numeric_limits<double>::epsilon();

// Two convex hulls, of A and B vertices, with a displacement for each vertex.
template <int A, int B>
struct MovingPair {
  Eigen::Matrix<double, 3, A> a, da;
  Eigen::Matrix<double, 3, B> b, db;
};

// Makes positions relative to the first vertex, and displacements relative to their mean. Neither
// changes a distance, and small gaps stay accurate far from the origin and in fast common motion.
template <int A, int B>
void make_relative(MovingPair<A, B>& pair) {
  const Vec3 origin = pair.a.col(0);
  const Vec3 mean = (pair.da.rowwise().sum() + pair.db.rowwise().sum()) / (A + B);
  pair.a.colwise() -= origin;
  pair.b.colwise() -= origin;
  pair.da.colwise() -= mean;
  pair.db.colwise() -= mean;
}

// Returns the largest relative speed of two vertices: an upper bound for all points of both hulls.
template <int A, int B>
double largest_relative_speed(const MovingPair<A, B>& pair) {
  double squared = 0.0;
  for (int i = 0; i < A; ++i) {
    for (int j = 0; j < B; ++j) {
      const double candidate = (pair.da.col(i) - pair.db.col(j)).squaredNorm();
      if (!(candidate <= squared)) squared = candidate;  // keeps a NaN, unlike std::max
    }
  }
  return std::sqrt(squared) * (1.0 + rounding_per_coordinate);
}

// Largest coordinates, the scale of rounding errors: position + t * speed.
struct Scale {
  double position, speed;
};

template <int A, int B>
Scale coordinate_scale(const MovingPair<A, B>& pair) {
  return {std::max(pair.a.cwiseAbs().maxCoeff(), pair.b.cwiseAbs().maxCoeff()),
          std::max(pair.da.cwiseAbs().maxCoeff(), pair.db.cwiseAbs().maxCoeff())};
}

// Returns the time for which the slab between the hulls, orthogonal to the fixed unit vector n, is at
// least as thick as `thickness`. The distance is at least the thickness of such a slab, for any n.
// Unlike the bound by speed, this bound ignores motion orthogonal to n.
template <int A, int B>
double slab_time(const MovingPair<A, B>& pair, const Vec3& n, double t, double thickness,
                 const Scale& scale) {
  const Eigen::Matrix<double, 1, A> speed_a = n.transpose() * pair.da;
  const Eigen::Matrix<double, 1, B> speed_b = n.transpose() * pair.db;
  const Eigen::Matrix<double, 1, A> at_a = n.transpose() * (pair.a + t * pair.da);
  const Eigen::Matrix<double, 1, B> at_b = n.transpose() * (pair.b + t * pair.db);
  const double needed = thickness + rounding_per_coordinate * (scale.position + t * scale.speed);
  double time = std::numeric_limits<double>::infinity();
  for (int i = 0; i < A; ++i) {
    for (int j = 0; j < B; ++j) {
      const double closing = speed_b[j] - speed_a[i] + rounding_per_coordinate * scale.speed;
      if (closing > 0.0) time = std::min(time, (at_a[i] - at_b[j] - needed) / closing);
    }
  }
  return time;
}

void check_parameters(double gap_fraction_min, double t_max, double min_distance) {
  if (gap_fraction_min >= 0.0 && gap_fraction_min < 1.0 && t_max >= 0.0 && min_distance >= 0.0) return;
  throw InputError(fmt::format(
      "additive CCD: gap_fraction_min = {} must lie in [0, 1), t_max = {} and min_distance = {} must not be "
      "negative; correct the contact or step filter settings",
      gap_fraction_min, t_max, min_distance));
}

// `separation(a, b)` is the shortest vector from hull b to hull a.
template <int A, int B, typename Separation>
double collision_free_step(MovingPair<A, B> pair, const Separation& separation, double gap_fraction_min, double t_max,
                           double min_distance) {
  check_parameters(gap_fraction_min, t_max, min_distance);
  make_relative(pair);
  const double speed = largest_relative_speed(pair);
  if (speed == 0.0) return t_max;
  if (!std::isfinite(speed)) return 0.0;

  const Scale scale = coordinate_scale(pair);
  double target = 0.0, aim = 0.0, close = 0.0;
  double safe = 0.0;
  for (int k = 0; k < iterations_max; ++k) {
    const double t = safe;
    const Vec3 shortest = separation(pair.a + t * pair.da, pair.b + t * pair.db);
    const double distance = shortest.norm();
    const double gap = distance - min_distance;
    if (k == 0) {
      target = gap_fraction_min * gap;
      aim = target + aim_fraction * (gap - target);
      close = target + stop_fraction * (gap - target);
    }
    // Ends also at a start without a gap, and at values that are not a number.
    if (!(gap > close && distance > 0.0)) return t;

    const double rounding = rounding_per_coordinate * (scale.position + t * scale.speed);
    const double by_speed = (gap - aim - rounding) / (speed + rounding_per_coordinate * scale.speed);
    if (t + by_speed >= t_max) return t_max;
    const double by_slab = slab_time(pair, shortest / distance, t, min_distance + aim, scale);
    const double step = std::max(by_speed, by_slab);
    if (!(step > 0.0)) return t;
    if (t + step >= t_max) return t_max;
    safe = t + step;
  }
  return safe;
}

}  // namespace

double point_point_accd(const Vec3& p0, const Vec3& p1, const Vec3& dp0, const Vec3& dp1,
                        double gap_fraction_min, double t_max, double min_distance) {
  const auto separation = [](const Vec3& a, const Vec3& b) -> Vec3 { return a - b; };
  return collision_free_step<1, 1>({p0, dp0, p1, dp1}, separation, gap_fraction_min, t_max, min_distance);
}

double point_edge_accd(const Vec3& p, const Vec3& e0, const Vec3& e1, const Vec3& dp,
                       const Vec3& de0, const Vec3& de1, double gap_fraction_min, double t_max,
                       double min_distance) {
  MovingPair<1, 2> pair{p, dp, {}, {}};
  pair.b.col(0) = e0, pair.b.col(1) = e1;
  pair.db.col(0) = de0, pair.db.col(1) = de1;
  const auto separation = [](const Vec3& a, const Eigen::Matrix<double, 3, 2>& b) {
    return point_edge_separation(a, b.col(0), b.col(1));
  };
  return collision_free_step(pair, separation, gap_fraction_min, t_max, min_distance);
}

double point_triangle_accd(const Vec3& p, const Vec3& t0, const Vec3& t1, const Vec3& t2,
                           const Vec3& dp, const Vec3& dt0, const Vec3& dt1, const Vec3& dt2,
                           double gap_fraction_min, double t_max, double min_distance) {
  MovingPair<1, 3> pair{p, dp, {}, {}};
  pair.b.col(0) = t0, pair.b.col(1) = t1, pair.b.col(2) = t2;
  pair.db.col(0) = dt0, pair.db.col(1) = dt1, pair.db.col(2) = dt2;
  const auto separation = [](const Vec3& a, const Mat3& b) {
    return point_triangle_separation(a, b.col(0), b.col(1), b.col(2));
  };
  return collision_free_step(pair, separation, gap_fraction_min, t_max, min_distance);
}

double edge_edge_accd(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0, const Vec3& eb1,
                      const Vec3& dea0, const Vec3& dea1, const Vec3& deb0, const Vec3& deb1,
                      double gap_fraction_min, double t_max, double min_distance) {
  MovingPair<2, 2> pair;
  pair.a.col(0) = ea0, pair.a.col(1) = ea1, pair.da.col(0) = dea0, pair.da.col(1) = dea1;
  pair.b.col(0) = eb0, pair.b.col(1) = eb1, pair.db.col(0) = deb0, pair.db.col(1) = deb1;
  using Ends = Eigen::Matrix<double, 3, 2>;
  const auto separation = [](const Ends& a, const Ends& b) {
    return edge_edge_separation(a.col(0), a.col(1), b.col(0), b.col(1));
  };
  return collision_free_step(pair, separation, gap_fraction_min, t_max, min_distance);
}

}  // namespace tack
