#include "framework/contact/terms/contact_residuals.hpp"

#include <atomic>
#include <cmath>

#include "framework/contact/stencils/stencil_distance.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

template <class Kind>
inline constexpr int residual_count = std::is_same_v<Kind, EdgeEdgeKind> ? 2 : 1;

template <class Kind>
using Rows = Eigen::Matrix<double, residual_count<Kind>, 3 * Kind::arity, Eigen::RowMajor>;

// Sets the residuals of a stencil. Returns false where the energy is not finite. eps_x: the threshold
// of the mollifier, for edge-edge stencils only [m^4].
template <class Kind>
bool stencil_residuals(const VecX& x, const StencilOf<Kind>& stencil, const PairLaw& law,
                       const LawRoot& root, double eps_x, double* r, double* jacobian) {
  const auto s = stencil_distance<GradientKernels>(Kind{}, x, stencil);
  const double gap = std::sqrt(s.value), weight = std::sqrt(stencil.weight);
  const LawSample phi = law.at(gap);
  if (!(gap > 0) || !std::isfinite(phi.value)) return false;
  const LawRoot::Sample rho = root.at(gap, phi);
  r[0] = weight * rho.value;
  Eigen::Map<Rows<Kind>> rows(jacobian);
  if (jacobian) rows.row(0) = weight * rho.slope / (2 * gap) * s.gradient.transpose();
  if constexpr (std::is_same_v<Kind, EdgeEdgeKind>) {
    const auto c = corners(x, stencil);
    const auto m = edge_edge_mollifier_gradient(c[0], c[1], c[2], c[3], eps_x);
    const double root_m = std::sqrt(m.value), missing = std::sqrt(std::max(1 - m.value, 0.0));
    const double well = weight * std::sqrt(2 * root.depth());
    if (jacobian) {
      // At exactly parallel edges m is zero with a quadratic minimum, and its root has no derivative.
      rows.row(0) *= root_m;
      if (root_m > 0) rows.row(0) += r[0] / (2 * root_m) * m.gradient.transpose();
      rows.row(1).setZero();
      if (missing > 0) rows.row(1) = -well / (2 * missing) * m.gradient.transpose();
    }
    r[0] *= root_m;
    r[1] = well * missing;
  }
  return true;
}

}  // namespace

void ContactResiduals::find_roots() const {
  if (!roots_.empty()) return;
  for (const PairLaw& law : system_.pairs().laws()) roots_.emplace_back(law);
}

std::vector<ResidualBatch> ContactResiduals::residual_batches() const {
  std::vector<ResidualBatch> batches;
  for_each_kind(system_.contacts(), [&](auto kind, const auto& stencils, const double*) {
    auto& vertices = batch_vertices_[batches.size()];
    vertices.clear();
    for (const auto& s : stencils) vertices.insert(vertices.end(), s.vertices.begin(), s.vertices.end());
    batches.push_back({kind.arity, residual_count<decltype(kind)>, static_cast<int>(stencils.size()),
                       vertices.data()});
  });
  return batches;
}

bool ContactResiduals::residuals(const VecX& x, double* r, double* jacobian) const {
  find_roots();
  std::atomic<bool> finite = true;
  for_each_kind(system_.contacts(), [&](auto kind, const auto& stencils, const double* thresholds) {
    using K = decltype(kind);
    constexpr size_t rows = residual_count<K>, entries = rows * 3 * K::arity;
    const int count = static_cast<int>(stencils.size());
    for_each(count, [&](int i) {
      double* r_i = r + rows * i;
      double* jacobian_i = jacobian ? jacobian + entries * i : nullptr;
      if (stencils[i].weight > 0) {
        if (!stencil_residuals<K>(x, stencils[i], system_.pairs().laws()[stencils[i].law],
                                  roots_[stencils[i].law], thresholds ? thresholds[i] : 0, r_i, jacobian_i))
          finite = false;
        return;
      }
      std::fill(r_i, r_i + rows, 0.0);
      if (jacobian) std::fill(jacobian_i, jacobian_i + entries, 0.0);
    });
    r += rows * count;
    if (jacobian) jacobian += entries * count;
  });
  return finite;
}

}  // namespace tack
