// Energy of one stencil of the Geometric Contact Potential (gcp_stencil.hpp) with two derivatives.
// With Gamma = M times all directional factors and L = ln Gamma,
//     E = w phi Gamma,   dE = w Gamma (phi' d delta + phi dL),
//     d2E = w Gamma (phi'' d delta d delta^T + phi' d2 delta + phi' (d delta dL^T + dL d delta^T)
//                    + phi (dL dL^T + d2L)).
// L is a sum over factors; each depends on few differences of positions (directional_cosine.hpp).
#pragma once

#include "framework/contact/gcp/gcp_stencil.hpp"
#include "framework/contact/normal_law.hpp"

namespace tack {

using GcpPositions = std::array<Vec3, gcp_arity_max>;
using GcpGradient = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3 * gcp_arity_max, 1>;
using GcpHessian =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3 * gcp_arity_max, 3 * gcp_arity_max>;

// Returns the distance of the closest points, delta [m]. The core vertices come first.
double gcp_distance(GcpKind kind, const GcpPositions& x);

// Returns -u . t of a tangent factor, or u . n of an exterior factor.
double gcp_cosine(GcpKind kind, const GcpFactor& factor, const GcpPositions& x);

// Returns the mollifier M.
double gcp_mollifier(GcpKind kind, const GcpSmoothing& smoothing, const GcpPositions& x);

// Returns Gamma.
double gcp_direction(const GcpStencil& stencil, std::span<const GcpFactor> factors,
                     const GcpSmoothing& smoothing, const GcpPositions& x);

// Sets the gradient (3 arity) [N], and the Hessian (3 arity x 3 arity) [N/m] unless it is null.
// law: phi_k and its derivatives at delta - o.
void gcp_derivatives(const GcpStencil& stencil, std::span<const GcpFactor> factors,
                     const GcpSmoothing& smoothing, const GcpPositions& x, const LawSample& law,
                     GcpGradient& gradient, GcpHessian* hessian);

}  // namespace tack
