// Weight of the clipped integral (clipped_pair.hpp) near a boundary of the surface:
//     rho(t) = t (12 - 36 t + 40 t^2 - 15 t^3),   t = s / R in [0, 1],   rho = 1 beyond,
// s: distance inside from the boundary edge [m], R: width of the strip [m]. rho(0) = 0, rho(1) = 1,
// rho'(1) = 0, and the integrals of 1 - rho and of t (1 - rho) over [0, 1] are zero.
//
// Why: without a weight the force jumps by the work of adhesion per length where the boundaries of
// both surfaces coincide, and Newton's method stalls. The two integrals keep area and its first
// moment. rho'(0) > 0 makes the boundary force leave zero linearly, so that the Hessian of an
// aligned boundary is not singular. Limit: the weight exceeds one inside the strip, by up to 1.32.
#pragma once

namespace tack {

struct BoundaryWeight {
  double value, slope;  // rho, d rho / dt

  // Number: double, or a pack of them.
  template <class Number>
  static Number value_in_strip(const Number& t) {
    return t * (12 + t * (-36 + t * (40 - 15 * t)));
  }
  template <class Number>
  static Number slope_in_strip(const Number& t) {
    return 12 + t * (-72 + t * (120 - 60 * t));
  }
  static BoundaryWeight at(double t) {
    if (t >= 1) return {1, 0};
    if (t <= 0) return {0, 12};
    return {value_in_strip(t), slope_in_strip(t)};
  }
};

}  // namespace tack
