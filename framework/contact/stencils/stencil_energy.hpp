// Energy of one contact stencil, E = w m phi(d) with s = d^2. Derivatives follow from the chain
// rule
//     dE/ds = w m phi' / (2 d),   d2E/ds2 = w m (phi'' - phi'/d) / (4 s),
// and the product rule for the edge-edge mollifier m.
#pragma once

#include "framework/contact/stencils/contact_set.hpp"
#include "framework/contact/normal_law.hpp"
#include "framework/contact/stencils/stencil_distance.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"

namespace tack {

// eps_x: the threshold of the mollifier, for edge-edge stencils only [m^4].
template <class Kind>
struct StencilEnergy {
  static constexpr int n = 3 * Kind::arity;
  using Vector = Eigen::Matrix<double, n, 1>;
  using Matrix = Eigen::Matrix<double, n, n>;

  static Vector gradient(const VecX& x, const StencilOf<Kind>& stencil, const LawSample& l,
                         double gap, double eps_x) {
    const auto s = stencil_distance<GradientKernels>(Kind{}, x, stencil);
    const Vector phi = l.slope / (2 * gap) * s.gradient;
    if constexpr (std::is_same_v<Kind, EdgeEdgeKind>) {
      const auto c = corners(x, stencil);
      const auto m = edge_edge_mollifier_gradient(c[0], c[1], c[2], c[3], eps_x);
      return stencil.weight * (m.value * phi + l.value * m.gradient);
    } else {
      return stencil.weight * phi;
    }
  }

  static void derivatives(const VecX& x, const StencilOf<Kind>& stencil, const LawSample& l,
                          double gap, double eps_x, Vector& gradient, Matrix& hessian) {
    const auto s = stencil_distance<DerivativeKernels>(Kind{}, x, stencil);
    const double slope = l.slope / (2 * gap);
    const double curvature = (l.curvature - l.slope / gap) / (4 * s.value);
    gradient = slope * s.gradient;
    hessian.noalias() = (curvature * s.gradient) * s.gradient.transpose();
    hessian += slope * s.hessian;
    if constexpr (std::is_same_v<Kind, EdgeEdgeKind>) {
      const auto c = corners(x, stencil);
      const auto m = edge_edge_mollifier_derivatives(c[0], c[1], c[2], c[3], eps_x);
      hessian = m.value * hessian + l.value * m.hessian + m.gradient * gradient.transpose() +
                gradient * m.gradient.transpose();
      gradient = m.value * gradient + l.value * m.gradient;
    }
    gradient *= stencil.weight;
    hessian *= stencil.weight;
  }
};

}  // namespace tack
