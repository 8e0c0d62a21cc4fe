// Smooth steps of the Geometric Contact Potential, with two derivatives.
//  * H(z; alpha, beta) rises from 0 at z = -alpha to 1 at z = beta. It is the integral of a
//  quadratic
//    B-spline, so that it is twice continuously differentiable.
//  * h(y) = y (2 - y) rises from 0 at y = 0 to 1 at y = 1, with a slope at 0 and none at 1.
// Source: Huang et al. 2025, Geometric Contact Potential, ACM TOG 44(4): smoothed Heaviside
// function, mollifier h_c of the distances.
#pragma once

namespace tack {

// A function of one number with two derivatives.
struct SmoothStep {
  double value, slope, curvature;
};

// Returns H(z; alpha, beta), alpha + beta > 0.
inline SmoothStep smooth_heaviside(double z, double alpha, double beta) {
  const double k = 3 / (alpha + beta), s = (z - beta) * k;  // the spline's knots: s = -3, -2, -1, 0
  if (s <= -3) return {0, 0, 0};
  if (s >= 0) return {1, 0, 0};
  if (s <= -2) {
    const double r = s + 3;
    return {r * r * r / 6, k * r * r / 2, k * k * r};
  }
  if (s <= -1)
    return {0.5 - s * (1.5 + s * (1.5 + s / 3)), -k * (1.5 + s * (3 + s)), -k * k * (3 + 2 * s)};
  return {1 + s * s * s / 6, k * s * s / 2, k * k * s};
}

// Returns h(y).
inline SmoothStep quadratic_step(double y) {
  if (y <= 0) return {0, 0, 0};
  if (y >= 1) return {1, 0, 0};
  return {y * (2 - y), 2 - 2 * y, -2};
}

}  // namespace tack
