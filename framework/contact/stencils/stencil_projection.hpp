// Derivatives of contact stencils with positive semi-definite Hessians, for several stencils side
// by side.
//     H = phi'' grad d grad d^T + phi' d2d
// acts in five dimensions only (distance_frame.hpp): (x) n, the three dimensions of R^K without
// translations and without the complement of w and the duals; and w (x) t1, w (x) t2. There the
// eigenvalue problem is 5x5 instead of 3K x 3K, with an equal result.
#pragma once

#include "framework/assembly/pack_projection.hpp"
#include "framework/assembly/psd_projection.hpp"
#include "framework/assembly/stencil_blocks.hpp"
#include "framework/contact/stencils/distance_frame.hpp"
#include "framework/contact/stencils/stencil_energy.hpp"
#include "framework/core/term.hpp"

namespace tack {

template <int K>
class StencilPack {
 public:
  static constexpr int blocks = K * (K + 1) / 2;

  // gap: the length of the frame's residual [m]. weight: factor on the law.
  void set(int lane, const DistanceFrame<K>& frame, const LawSample& law, double gap,
           double weight) {
    set_lane<K, 1>(w_, lane, frame.weights);
    set_lane<3, 1>(n_, lane, frame.residual / gap);
    set_lane<3, 1>(along_, lane, frame.along);
    set_lane<3, K>(duals_, lane, frame.duals);
    set_lane<2, 1>(free_, lane, frame.free);
    gap_.set(lane, gap);
    slope_.set(lane, weight * law.slope);
    curvature_.set(lane, weight * law.curvature);
  }

  // Slots of each stencil: see Term.
  void derivatives(Projection projection, Pack* gradient, Pack* hessian) const {
    for (int i = 0; i < K; ++i)
      for (int d = 0; d < 3; ++d) gradient[3 * i + d] = slope_ * w_(i) * n_(d);

    // Orthonormal e_0 = w / |w|, e_1, e_2 and the tilts t_k . sum_i q_i (u_i . n) = sum_m tilt(k,
    // m) e_m . u_n.
    const PackMatrix<3, 2> tangents = tangent_vectors();
    const PackMatrix<K, 2> duals = duals_.transpose() * tangents;
    PackMatrix<K, 3> e;
    PackMatrix<2, 3> tilt;
    const Pack length = sqrt(Pack(w_.squaredNorm()));
    e.col(0) = w_ * Pack(1 / length);
    for (int k = 0; k < 2; ++k) {
      PackMatrix<K> rest = duals.col(k);
      const Pack size = rest.squaredNorm();
      tilt(k, 2) = 0;
      for (int m = 0; m <= k; ++m) {
        tilt(k, m) = e.col(m).dot(duals.col(k));
        rest -= e.col(m) * tilt(k, m);
      }
      const Pack left = rest.squaredNorm();
      const PackMask some = left > 1e-28 * size;
      tilt(k, k + 1) = select(some, sqrt(left), 0);
      e.col(k + 1) = rest * select(some, 1 / sqrt(left), 0);
    }

    // In (e_0, e_1, e_2) (x) n, e_0 (x) t1, e_0 (x) t2.
    PackMatrix<5, 5> form;
    for (int m = 0; m < 3; ++m) {
      for (int l = 0; l < 3; ++l)
        form(m, l) = -slope_ * gap_ * (tilt(0, m) * tilt(0, l) + tilt(1, m) * tilt(1, l));
      for (int k = 0; k < 2; ++k) form(m, 3 + k) = form(3 + k, m) = -slope_ * length * tilt(k, m);
    }
    form(0, 0) += curvature_ * length * length;
    const Pack turn = slope_ / gap_ * length * length;
    form(3, 3) = turn * free_(0);
    form(4, 4) = turn * free_(1);
    form(3, 4) = form(4, 3) = 0;
    project_psd<5>(form, projection);

    const PackMat3 within =
        tangents * PackMatrix<2, 2>(form.template bottomRightCorner<2, 2>()) * tangents.transpose();
    const PackMatrix<K, 3> half = e * PackMat3(form.template topLeftCorner<3, 3>());
    const PackMatrix<K, 2> coupling = e * PackMatrix<3, 2>(form.template topRightCorner<3, 2>());
    const PackMatrix<3, K> mixed = tangents * coupling.transpose();
    for (int i = 0; i < K; ++i) {
      for (int j = 0; j <= i; ++j, hessian += 9) {
        const Pack normal = half(i, 0) * e(j, 0) + half(i, 1) * e(j, 1) + half(i, 2) * e(j, 2);
        const PackVec3 row = n_ * normal + mixed.col(i) * e(j, 0);
        const Pack both = e(i, 0) * e(j, 0);
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r)
            hessian[3 * c + r] =
                n_(r) * row(c) + e(i, 0) * mixed(r, j) * n_(c) + both * within(r, c);
      }
    }
  }

 private:
  PackMatrix<3, 2> tangent_vectors() const {
    PackMatrix<3, 2> t;
    t.col(0) = along_;
    for (int d = 0; d < 3; ++d)
      t(d, 1) = n_((d + 1) % 3) * along_((d + 2) % 3) - n_((d + 2) % 3) * along_((d + 1) % 3);
    return t;
  }

  PackMatrix<K> w_;
  PackVec3 n_, along_;
  PackMatrix<3, K> duals_;
  PackMatrix<2> free_;
  Pack gap_, slope_, curvature_;
};

// Returns whether the Hessian depends on more than the distance: for edge-edge stencils with m < 1.
template <class Kind>
bool is_mollified(const std::array<Vec3, Kind::arity>& c, double eps_x) {
  if constexpr (std::is_same_v<Kind, EdgeEdgeKind>)
    return edge_edge_cross_squared(c[0], c[1], c[2], c[3]) < eps_x;
  return false;
}

// Writes the slots of the stencils [first, last), with projected Hessians. gap, law: arrays that
// begin with stencil `first`. thresholds: eps_x of all edge-edge stencils; null for other kinds.
template <class Kind>
void projected_derivatives(const VecX& x, const StencilsOf<Kind>& stencils, int first, int last,
                           const double* thresholds, const double* gap, const LawSample* law,
                           Projection projection, double* gradient, double* hessian) {
  using Stencil = StencilEnergy<Kind>;
  constexpr int n = Stencil::n, slots = 9 * hessian_blocks(Kind::arity);
  constexpr int points = is_interior<Kind> ? Kind::arity - 2 : Kind::arity;
  using Point = typename PointKindOf<Kind>::type;
  StencilPack<points> pack;
  for (int at = first; at < last; at += pack_width) {
    const int lanes = std::min(pack_width, last - at);
    unsigned mollified = 0;
    for (int l = 0; l < pack_width; ++l) {
      const int i = at + std::min(l, lanes - 1);
      const auto c = corners(x, stencils[i]);
      pack.set(l, distance_between<FrameKernels>(Point{}, c), law[i - first], gap[i - first],
               stencils[i].weight);
      if (thresholds && is_mollified<Point>(c, thresholds[i])) mollified |= 1u << l;
    }
    Pack g[3 * points], h[9 * StencilPack<points>::blocks];
    pack.derivatives(projection, g, h);
    double* const g_out = gradient + n * static_cast<size_t>(at);
    double* const h_out = hessian + slots * static_cast<size_t>(at);
    if constexpr (is_interior<Kind>) {
      constexpr int point_slots = 9 * StencilPack<points>::blocks;
      double point_g[pack_width * 3 * points], point_h[pack_width * point_slots];
      store_lanes(g, 3 * points, point_g, lanes);
      store_lanes(h, point_slots, point_h, lanes);
      for (int l = 0; l < lanes; ++l) {
        const Vec3& inside = stencils[at + l].inside;
        Eigen::Matrix<double, 3 * points, 3 * points> of_point;
        load_blocks<points>(point_h + point_slots * l, of_point);
        store_blocks<Kind::arity>(chain_to_triangle<3 * points>(of_point, inside),
                                  h_out + slots * l);
        Eigen::Map<typename Stencil::Vector>(g_out + n * l) = chain_to_triangle<3 * points>(
            Eigen::Matrix<double, 3 * points, 1>(
                Eigen::Map<Eigen::Matrix<double, 3 * points, 1>>(point_g + 3 * points * l)),
            inside);
      }
    } else {
      store_lanes(g, n, g_out, lanes);
      store_lanes(h, slots, h_out, lanes);
    }
    for (int l = 0; l < lanes; ++l) {
      if (!(mollified >> l & 1u)) continue;
      const int i = at + l;
      typename Stencil::Vector full_g;
      typename Stencil::Matrix full_h;
      Stencil::derivatives(x, stencils[i], law[i - first], gap[i - first], thresholds[i], full_g,
                           full_h);
      project_stencil_psd<Kind::arity>(full_h, projection);
      Eigen::Map<typename Stencil::Vector>(g_out + n * l) = full_g;
      store_blocks<Kind::arity>(full_h, h_out + slots * l);
    }
  }
}

}  // namespace tack
