// Slip u = e + T^T sum_i c_i (x_i - x_i^n) of one contact point [m], with the elastic slip e at the
// start of the step if its law sticks (stick_anchors.hpp), else 0; and its potential
//     E = mu lambda f0(y) + (mu_s - mu) lambda f_s0(y) + mu_a lambda_a f_t0(y),   y = |u|,
// with derivatives by the moved point sum_i c_i x_i: T u E'/y, and T H T^T. On a side with
// rotations, the moved point depends on scalar dofs as well (rolling_points.hpp).
#pragma once

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/tangential_law.hpp"
#include "framework/core/projection.hpp"

namespace tack {

// Point: ContactPoint<K> or RollingPoint.
template <class Point>
struct Slip {
  Slip(const Point& point, const VecX& x, const VecX& start)
      : c(point), u(from_anchor(point, c.tangents.transpose() * c.moved(x, start))), y(u.norm()) {}

  // E [J], E'/y [N/m] and E'' [N/m].
  SlipSample sample(const TangentialLaw& law, double h, TangentialTerm term) const {
    SlipSample s{0, 0, 0};
    const auto add = [&](double magnitude, const SlipSample& f) {
      s.value += magnitude * f.value;
      s.slope_over_y += magnitude * f.slope_over_y;
      s.curvature += magnitude * f.curvature;
    };
    if (term != TangentialTerm::adhesion) {
      const double whole = law.sticks() ? law.elastic_slip : law.eps_v * h;
      add(law.mu * c.normal_force, friction_slip(y, whole));
      if (law.mu_static > law.mu)
        add((law.mu_static - law.mu) * c.normal_force,
            static_slip(y, whole, law.elastic_slip + law.stribeck * h));
    }
    if (term != TangentialTerm::friction)
      add(law.mu_a * law.peak_traction * c.area, adhesion_slip(y, law.eps_a * h));
    return s;
  }

  Vec3 slope(const SlipSample& s) const { return c.tangents * (s.slope_over_y * u); }

  // T H T^T with H = E'' along u and E'/y across, projected.
  Mat3 curvature(const SlipSample& s, Projection projection) const {
    const double across = projected(s.slope_over_y, projection);
    // If E'/y falls with y, the quadratic E'/y y^2/2 lies above E: a step with the exact curvature,
    // which is zero for full friction, overshoots from sliding into sticking.
    const double along =
        projection == Projection::majorize ? across : projected(s.curvature, projection);
    // Without slip both eigenvalues are equal, and any direction will do.
    const Vec3 direction = y > 0 ? Vec3(c.tangents * (u / y)) : Vec3(c.tangents.col(0));
    return across * c.tangents * c.tangents.transpose() +
           (along - across) * direction * direction.transpose();
  }

  // Work against friction in the step [J]. A spring that unloads gives energy back.
  double work(const SlipSample& s, const TangentialLaw& law) const {
    if constexpr (requires { c.elastic; })
      if (law.sticks()) return s.slope_over_y * u.dot(u - c.elastic);
    return s.slope_over_y * y * y;
  }

  const Point& c;
  Vec2 u;    // m
  double y;  // m

 private:
  static Vec2 from_anchor(const Point& point, const Vec2& step) {
    if constexpr (requires { point.elastic; }) return step + point.elastic;
    else return step;
  }
};

}  // namespace tack
