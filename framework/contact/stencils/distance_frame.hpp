// Second derivatives of the distance between two features, in compact form. With the shortest
// vector r = sum_i w_i x_i = d n, tangents t1 and t2 orthogonal to n, and the duals q_i of
// span_projection.hpp,
//     d2d/dx_i dx_j = -w_i q_j n^T - w_j n q_i^T - d q_i.q_j n n^T
//                     + w_i w_j / d (f_1 t1 t1^T + f_2 t2 t2^T),
// where f_k is 1 if the features do not extend along t_k, else 0: planes have f = (0, 0), a line
// along t1 has (0, 1), points have (1, 1). q_i has no component along t_k with f_k = 1.
#pragma once

#include "geometry/distance/reduced_kernels.hpp"

namespace tack {

template <int K>
struct DistanceFrame {
  Eigen::Matrix<double, K, 1> weights;
  Vec3 residual;                      // r [m]
  Vec3 along;                         // t1; t2 = n x t1
  Eigen::Matrix<double, 3, K> duals;  // [1/m]
  Vec2 free;                          // f
};

// Kernels of distance_between and reduce_edge_edge.
struct FrameKernels {
  static DistanceFrame<2> point_point(const Vec3& a, const Vec3& b) {
    const Vec3 r = a - b;
    return {{1, -1}, r, r.unitOrthogonal(), Eigen::Matrix<double, 3, 2>::Zero(), {1, 1}};
  }
  static DistanceFrame<3> point_line(const Vec3& p, const Vec3& a, const Vec3& b) {
    const auto [u, r] = project_onto_line(p, a, b);
    const Vec3 q = (a - b) / (a - b).squaredNorm();
    DistanceFrame<3> frame{{1, u - 1, -u}, r, q.normalized(), {}, {0, 1}};
    frame.duals << Vec3::Zero(), q, -q;
    return frame;
  }
  static DistanceFrame<4> point_plane(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const PlaneProjection plane = project_onto_triangle(p, a, b, c);
    DistanceFrame<4> frame = in_plane(point_plane_weights(plane), plane);
    frame.duals << Vec3::Zero(), plane.dual_a + plane.dual_b, -plane.dual_a, -plane.dual_b;
    return frame;
  }
  static DistanceFrame<4> line_line(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const PlaneProjection plane = project_line_onto_line(a, b, c, d);
    DistanceFrame<4> frame = in_plane(line_line_weights(plane), plane);
    frame.duals << -plane.dual_a, plane.dual_a, plane.dual_b, -plane.dual_b;
    return frame;
  }

 private:
  static DistanceFrame<4> in_plane(const Eigen::Vector4d& weights, const PlaneProjection& plane) {
    return {weights, plane.residual, plane.residual.cross(plane.dual_a).normalized(), {}, {0, 0}};
  }
};

template <int V, int... At>
DistanceFrame<V> embed(const DistanceFrame<sizeof...(At)>& frame) {
  constexpr std::array<int, sizeof...(At)> at{At...};
  DistanceFrame<V> out{Eigen::Matrix<double, V, 1>::Zero(), frame.residual, frame.along,
                       Eigen::Matrix<double, 3, V>::Zero(), frame.free};
  for (int i = 0; i < int(at.size()); ++i) {
    out.weights[at[i]] = frame.weights[i];
    out.duals.col(at[i]) = frame.duals.col(i);
  }
  return out;
}

}  // namespace tack
