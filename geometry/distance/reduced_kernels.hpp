// The four unclamped distances under one name per order of derivative, and the embedding of a
// result for some vertices of a stencil into the whole stencil. With both, point_edge.hpp,
// point_triangle.hpp and edge_edge.hpp write their case distinction once for value, gradient,
// Hessian and shortest vector.
#pragma once

#include <array>

#include "geometry/distance/line_line.hpp"
#include "geometry/distance/point_line.hpp"
#include "geometry/distance/point_plane.hpp"
#include "geometry/distance/point_point.hpp"

namespace tack {

struct ValueKernels {
  static double point_point(const Vec3& a, const Vec3& b) { return point_point_distance(a, b); }
  static double point_line(const Vec3& p, const Vec3& a, const Vec3& b) {
    return point_line_distance(p, a, b);
  }
  static double point_plane(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    return point_plane_distance(p, a, b, c);
  }
  static double line_line(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return line_line_distance(a, b, c, d);
  }
};

struct GradientKernels {
  static auto point_point(const Vec3& a, const Vec3& b) { return point_point_gradient(a, b); }
  static auto point_line(const Vec3& p, const Vec3& a, const Vec3& b) {
    return point_line_gradient(p, a, b);
  }
  static auto point_plane(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    return point_plane_gradient(p, a, b, c);
  }
  static auto line_line(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return line_line_gradient(a, b, c, d);
  }
};

struct DerivativeKernels {
  static auto point_point(const Vec3& a, const Vec3& b) { return point_point_derivatives(a, b); }
  static auto point_line(const Vec3& p, const Vec3& a, const Vec3& b) {
    return point_line_derivatives(p, a, b);
  }
  static auto point_plane(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    return point_plane_derivatives(p, a, b, c);
  }
  static auto line_line(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return line_line_derivatives(a, b, c, d);
  }
};

// The shortest vector, to the first argument or edge from the closest point of the others [m].
struct SeparationKernels {
  static Vec3 point_point(const Vec3& a, const Vec3& b) { return a - b; }
  static Vec3 point_line(const Vec3& p, const Vec3& a, const Vec3& b) {
    return project_onto_line(p, a, b).residual;
  }
  static Vec3 point_plane(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    return project_onto_triangle(p, a, b, c).residual;
  }
  static Vec3 line_line(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return project_line_onto_line(a, b, c, d).residual;
  }
};

// embed<4, 0, 2>(d): d belongs to vertices 0 and 2 of a stencil of four; the rest becomes zero.
template <int V, int... At>
double embed(double value) {
  return value;
}

template <int V, int... At>
Vec3 embed(const Vec3& separation) {
  return separation;
}

template <int V, int... At>
StencilGradient<3 * V> embed(const StencilGradient<3 * sizeof...(At)>& part) {
  constexpr std::array<int, sizeof...(At)> at{At...};
  StencilGradient<3 * V> out;
  out.value = part.value;
  out.gradient.setZero();
  for (int i = 0; i < int(at.size()); ++i) {
    out.gradient.template segment<3>(3 * at[i]) = part.gradient.template segment<3>(3 * i);
  }
  return out;
}

template <int V, int... At>
StencilDerivatives<3 * V> embed(const StencilDerivatives<3 * sizeof...(At)>& part) {
  constexpr std::array<int, sizeof...(At)> at{At...};
  StencilDerivatives<3 * V> out;
  out.value = part.value;
  out.gradient.setZero();
  out.hessian.setZero();
  for (int i = 0; i < int(at.size()); ++i) {
    out.gradient.template segment<3>(3 * at[i]) = part.gradient.template segment<3>(3 * i);
    for (int j = 0; j < int(at.size()); ++j) {
      out.hessian.template block<3, 3>(3 * at[i], 3 * at[j]) =
          part.hessian.template block<3, 3>(3 * i, 3 * j);
    }
  }
  return out;
}

}  // namespace tack
