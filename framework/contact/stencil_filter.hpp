// Makes the Hessians of contact stencils positive semi-definite. The Hessian of a point-plane or
// line-line distance lives in five dimensions: with the normal n, tangents t1 and t2 and the weights c
// of the closest points (sum c_i x_i = d n), it is spanned by R^4 (x) n without translations (three)
// and c (x) t1, c (x) t2. There the eigenvalue problem is 5x5 instead of 12x12, with the same result.
#pragma once

#include <Eigen/Geometry>

#include "framework/assembly/parallel.hpp"
#include "framework/assembly/psd_filter.hpp"
#include "framework/assembly/stencil_blocks.hpp"
#include "framework/contact/stencil_energy.hpp"
#include "framework/core/term.hpp"

namespace tack {

using DistanceBasis = Eigen::Matrix<double, 12, 5>;

// c: weights of the four vertices; n: unit normal. Columns are orthonormal.
inline DistanceBasis distance_basis(const Eigen::Vector4d& c, const Vec3& n) {
  const Eigen::Vector4d unit = c.normalized();
  // Complete (1,1,1,1)/2 and unit (they are orthogonal: sum c = 0) to a basis of R^4.
  int smallest = 0;
  unit.cwiseAbs().minCoeff(&smallest);
  Eigen::Vector4d a = Eigen::Vector4d::Unit(smallest);
  a.array() -= 0.25;
  a = (a - a.dot(unit) * unit).normalized();
  Eigen::Vector4d b;
  const auto minor = [&](int i, int j, int k) {
    Mat3 m;
    m << 1, 1, 1, unit(i), unit(j), unit(k), a(i), a(j), a(k);
    return m.determinant();
  };
  b << minor(1, 2, 3), -minor(0, 2, 3), minor(0, 1, 3), -minor(0, 1, 2);
  b.normalize();
  const Vec3 t1 = n.unitOrthogonal(), t2 = n.cross(t1);
  DistanceBasis basis;
  basis << stacked<4>(unit, n), stacked<4>(a, n), stacked<4>(b, n), stacked<4>(unit, t1),
      stacked<4>(unit, t2);
  return basis;
}

inline void project_in_basis(const DistanceBasis& basis, Mat12& hessian, SpdFilter filter) {
  using Mat5 = Eigen::Matrix<double, 5, 5>;
  const Mat5 before = basis.transpose() * hessian * basis;
  Mat5 after = before;
  project_psd<5>(after, filter);
  if (after == before) return;
  hessian.noalias() += basis * (after - before) * basis.transpose();
}

// The weights and normal of a stencil from the gradient of its squared distance, 2 c (x) r.
inline void filter_plane_like(const StencilGradient<12>& s, Mat12& hessian, SpdFilter filter) {
  Eigen::Index strongest = 0;
  Eigen::Map<const Eigen::Matrix<double, 3, 4>> columns(s.gradient.data());
  columns.colwise().squaredNorm().maxCoeff(&strongest);
  const Vec3 n = columns.col(strongest).normalized();
  project_in_basis(distance_basis(columns.transpose() * n, n), hessian, filter);
}

// c: the stencil's points (corners(x, stencil)); eps_x of an edge-edge stencil, else unused.
template <class Kind>
void filter_stencil(const std::array<Vec3, Kind::arity>& c, double eps_x,
                    typename StencilEnergy<Kind>::Matrix& hessian, SpdFilter filter) {
  if constexpr (std::is_same_v<Kind, PointTriangleKind>) {
    filter_plane_like(distance_between<GradientKernels>(Kind{}, c), hessian, filter);
  } else if constexpr (std::is_same_v<Kind, EdgeEdgeKind>) {
    const bool inside = edge_edge_type(c[0], c[1], c[2], c[3]) == EdgeEdgeType::EA_EB;
    const bool mollified = edge_edge_cross_squared(c[0], c[1], c[2], c[3]) < eps_x;
    if (inside && !mollified) {
      filter_plane_like(GradientKernels::line_line(c[0], c[1], c[2], c[3]), hessian, filter);
    } else {
      project_stencil_psd<4>(hessian, filter);
    }
  } else {
    project_stencil_psd<Kind::arity>(hessian, filter);
  }
}

// A sample's Hessian is filtered as that of its point.
template <class Kind>
void filter_hessian(const VecX& x, const StencilOf<Kind>& s, double eps_x,
                    typename StencilEnergy<Kind>::Matrix& hessian, SpdFilter filter) {
  const auto c = corners(x, s);
  if constexpr (is_sample<Kind>) {
    auto of_point = chain_to_point<3 * Kind::arity>(hessian, s.inside);
    filter_stencil<typename Kind::PointKind>(c, eps_x, of_point, filter);
    hessian = chain_to_triangle<3 * Kind::arity - 6>(of_point, s.inside);
  } else {
    filter_stencil<Kind>(c, eps_x, hessian, filter);
  }
}

template <class Kind>
void filter_slots(const VecX& x, const StencilsOf<Kind>& stencils, const double* thresholds,
                  SpdFilter filter, double* hessian) {
  constexpr int slots = 9 * hessian_blocks(Kind::arity);
  for_each(static_cast<int>(stencils.size()), [&](int i) {
    typename StencilEnergy<Kind>::Matrix h;
    double* at = hessian + slots * static_cast<size_t>(i);
    load_blocks<Kind::arity>(at, h);
    filter_hessian<Kind>(x, stencils[i], thresholds ? thresholds[i] : 0, h, filter);
    store_blocks<Kind::arity>(h, at);
  }, 16);
}

}  // namespace tack
