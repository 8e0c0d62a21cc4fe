// Parameters of the closest points on two primitives, for a known type (closest_feature.hpp) or
// with classification. Dimensionless, in [0, 1] up to rounding errors.
#pragma once

#include "geometry/distance/closest_feature.hpp"

namespace tack {

inline double clamped(double parameter) {
  return parameter < 0 ? 0 : parameter > 1 ? 1 : parameter;
}

// The closest point is (1 - u) e0 + u e1.
inline double point_edge_parameter(const Vec3& p, const Vec3& e0, const Vec3& e1,
                                   PointEdgeType type) {
  if (type == PointEdgeType::P_E0) return 0.0;
  if (type == PointEdgeType::P_E1) return 1.0;
  return project_onto_line(p, e0, e1).u;
}

inline double point_edge_parameter(const Vec3& p, const Vec3& e0, const Vec3& e1) {
  return point_edge_closest(p, e0, e1).parameter;
}

// The closest point is l0 t0 + l1 t1 + l2 t2, l0 + l1 + l2 = 1.
inline Vec3 point_triangle_barycentric(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                       const Vec3& t2, PointTriangleType type) {
  using enum PointTriangleType;
  const auto on_edge = [&p](const Vec3& e0, const Vec3& e1) {
    return project_onto_line(p, e0, e1).u;
  };
  double u = 0.0;
  switch (type) {
    case P_T0: return {1.0, 0.0, 0.0};
    case P_T1: return {0.0, 1.0, 0.0};
    case P_T2: return {0.0, 0.0, 1.0};
    case P_E0: u = on_edge(t0, t1); return {1.0 - u, u, 0.0};
    case P_E1: u = on_edge(t1, t2); return {0.0, 1.0 - u, u};
    case P_E2: u = on_edge(t2, t0); return {u, 0.0, 1.0 - u};
    case P_T: break;
  }
  const PlaneProjection plane = project_onto_triangle(p, t0, t1, t2);
  return {1.0 - plane.u - plane.v, plane.u, plane.v};
}

inline Vec3 point_triangle_barycentric(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                       const Vec3& t2) {
  return point_triangle_barycentric(p, t0, t1, t2, point_triangle_type(p, t0, t1, t2));
}

// The closest points are (1 - u) ea0 + u ea1 and (1 - v) eb0 + v eb1; returns (u, v).
inline Vec2 edge_edge_parameters(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0, const Vec3& eb1,
                                 EdgeEdgeType type) {
  using enum EdgeEdgeType;
  switch (type) {
    case EA0_EB0: return {0.0, 0.0};
    case EA0_EB1: return {0.0, 1.0};
    case EA1_EB0: return {1.0, 0.0};
    case EA1_EB1: return {1.0, 1.0};
    case EA_EB0: return {clamped(project_onto_line(eb0, ea0, ea1).u), 0.0};
    case EA_EB1: return {clamped(project_onto_line(eb1, ea0, ea1).u), 1.0};
    case EA0_EB: return {0.0, clamped(project_onto_line(ea0, eb0, eb1).u)};
    case EA1_EB: return {1.0, clamped(project_onto_line(ea1, eb0, eb1).u)};
    case EA_EB: break;
  }
  const PlaneProjection plane = project_line_onto_line(ea0, ea1, eb0, eb1);
  return {clamped(plane.u), clamped(plane.v)};
}

inline Vec2 edge_edge_parameters(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                 const Vec3& eb1) {
  return edge_edge_parameters(ea0, ea1, eb0, eb1, edge_edge_type(ea0, ea1, eb0, eb1));
}

}  // namespace tack
