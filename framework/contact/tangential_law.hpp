// Friction and tangential adhesion of one contact as functions of the slip y = |u| of the time
// step:
//     E = mu lambda f0(y) + (mu_s - mu) lambda f_s0(y) + mu_a lambda_a f_t0(y)          [J]
//     f0' = f1 = 2y/e - y^2/e^2 for y < e = eps_v h, then 1  (the paper, eq. 3 and 4)
//     f_t0' = f_t = 2y/e - y^2/e^2 for y < 2e, e = eps_a h, then 0  (eq. 13 and 14; the text prints
//     eps_v in the range, but the quadratic vanishes at 2 eps_a h)
//     f_s0' = f_s = f1 for y < e = eps_v h, then 1 - t^2 (3 - 2t), t = (y - e) / w, for y < e + w =
//     v_s h, then 0: friction falls from static to kinetic up to the Stribeck speed v_s
//     (Armstrong-Helouvry, Dupont, Canudas de Wit 1994, section 2.1; here with a cubic)
// With an elastic slip l, friction sticks: y is the slip from an anchor (stick_anchors.hpp), and l
// takes the place of eps_v h, l + v_s h that of v_s h.
// All integrals start at f(0) = 0. f_t0 is concave between e and 2e, f_s0 from e on.
#pragma once

namespace tack {

enum class TangentialTerm { all, friction, adhesion };

// Tangential laws between two objects.
struct TangentialLaw {
  double mu = 0;             // coefficient of (kinetic) friction
  double mu_static = 0;      // coefficient of static friction, at least mu
  double stribeck = 1e-2;    // v_s: sliding speed from which friction is kinetic, above eps_v [m/s]
  double eps_v = 1e-3;       // sliding speed from which friction is full [m/s]
  double mu_a = 0;           // tangential adhesion over normal adhesion
  double peak_traction = 0;  // of the normal adhesion [Pa]
  double eps_a = 1e-3;       // sliding speed of the largest tangential adhesion [m/s]
  double across = 1;         // friction across the grain over that along it
  double elastic_slip = 0;   // l: slip up to which a contact sticks [m]; 0: it creeps below eps_v

  bool sticks() const { return elastic_slip > 0; }
  bool acts() const { return mu_static > 0 || mu_a * peak_traction > 0; }
};

// f(y) [m], f'(y)/y [1/m] and f''(y) [1/m]; the quotient is finite at y = 0.
struct SlipSample {
  double value, slope_over_y, curvature;
};

namespace detail {
inline SlipSample slip_start(double y, double e) {
  return {y * y / e * (1 - y / (3 * e)), (2 - y / e) / e, 2 * (1 - y / e) / e};
}
}  // namespace detail

// f0; e = eps_v h [m].
inline SlipSample friction_slip(double y, double e) {
  if (y < e) return detail::slip_start(y, e);
  return {y - e / 3, 1 / y, 0};
}

// f_s0; e = eps_v h, end = v_s h [m].
inline SlipSample static_slip(double y, double e, double end) {
  if (y < e) return detail::slip_start(y, e);
  const double w = end - e, t = (y - e) / w;
  if (t >= 1) return {2 * e / 3 + w / 2, 0, 0};
  return {2 * e / 3 + w * t * (1 - t * t * (1 - t / 2)), (1 - t * t * (3 - 2 * t)) / y,
          -6 * t * (1 - t) / w};
}

// f_t0; e = eps_a h [m].
inline SlipSample adhesion_slip(double y, double e) {
  if (y < 2 * e) return detail::slip_start(y, e);
  return {4 * e / 3, 0, 0};
}

}  // namespace tack
