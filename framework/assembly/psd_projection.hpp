// Projection of the symmetric Hessian of a stencil onto the positive semi-definite cone.
// Translation-invariant stencils are projected in the 3(K-1) dimensions orthogonal to translations;
// an early Cholesky test skips matrices that are definite there already.
#pragma once

#include "framework/core/projection.hpp"
#include "geometry/types.hpp"

namespace tack {

/// N = 2, 3, 6, 8, 9: plain eigenvalue projection.
template <int N>
void project_psd(Eigen::Matrix<double, N, N>& hessian, Projection projection);

/// Arity 2 to 10, translation invariant: 3K x 3K.
template <int K>
void project_stencil_psd(Eigen::Matrix<double, 3 * K, 3 * K>& hessian, Projection projection);

/// Stencils of three vertices and two twists (StencilBatch): in the six dimensions of the vertices
/// orthogonal to translations, plus the two twists.
void project_scalar_psd(Eigen::Matrix<double, 15, 15>& hessian, Projection projection);

}  // namespace tack
