// Composite tets of one elastic material, as a sum of squares: the residuals of psi_s at each point
// and of its substitute in each part (solid_residuals.hpp), and sqrt(V) g(J) of the mean J,
// U = g^2 / 2.
#pragma once

#include <atomic>

#include "energies/solid/composite_term.hpp"
#include "energies/solid/solid_residuals.hpp"
#include "framework/core/residual_view.hpp"

namespace tack {

template <class Material>
class CompositeSolid : public CompositeTerm<Material>, public ResidualView {
 public:
  CompositeSolid(std::string name, const Material& material, const Body& body, const VecX& rest)
      : CompositeTerm<Material>(std::move(name), material, body, rest),
        squares_(material.lame.lambda >= 0) {}

  // A negative lambda is no sum of squares.
  const ResidualView* residual_view() const override { return squares_ ? this : nullptr; }

  std::vector<ResidualBatch> residual_batches() const override {
    const StencilBatch tets = this->batches().front();
    return {{tets.arity, residual_count, tets.count, tets.vertices}};
  }

  bool residuals(const VecX& x, double* r, double* jacobian) const override {
    std::atomic<bool> finite = true;
    for_each(this->count(), [&](int t) {
      const size_t at = static_cast<size_t>(t) * residual_count;
      if (!residuals_of(t, x, r + at, jacobian ? jacobian + columns * at : nullptr)) finite = false;
    });
    return finite;
  }

 private:
  static constexpr int residual_count = composite_samples * tet_residual_count + 1,
                       columns = 3 * composite_nodes;
  using OfEdges = Eigen::Matrix<double, tet_residual_count, 12, Eigen::RowMajor>;
  using OfNodes = Eigen::Matrix<double, Eigen::Dynamic, columns, Eigen::RowMajor>;

  // `of_edges`: derivatives by the corners of a tet, 0 to 3; node n moves edge l by c_l.
  static void add_node(double* jacobian, const OfEdges& of_edges, int node,
                       const CompositeTable::Row& c) {
    Eigen::Map<Eigen::Matrix<double, tet_residual_count, columns, Eigen::RowMajor>> rows(jacobian);
    for (int l = 0; l < 3; ++l)
      rows.template middleCols<3>(3 * node) += c[l] * of_edges.middleCols<3>(3 * (l + 1));
  }

  bool residuals_of(int t, const VecX& x, double* r, double* jacobian) const {
    const CompositeTets& tets = this->tets_;
    const CompositeTable& table = composite_table();
    Eigen::Map<OfNodes> all(jacobian, jacobian ? residual_count : 0, columns);
    if (jacobian) all.setZero();
    double mean = 0;
    Eigen::Matrix<double, 1, columns> growth = Eigen::Matrix<double, 1, columns>::Zero();
    OfEdges of_edges;
    for (int k = 0; k < composite_samples; ++k) {
      const TetRest<double> rest{tets.shape_of(t, k), tets.weight(k) * tets.volume_of(t)};
      const Mat3 f = tets.deformation(t, k, x);
      double* const into = r + tet_residual_count * k;
      double* const slopes = jacobian ? of_edges.data() : nullptr;
      if (!(k < composite_points ? tet_residuals(this->split_.shape, rest, f, into, slopes)
                                 : tet_residuals(this->split_.part, rest, f, into, slopes)))
        return false;
      double* const rows = jacobian ? jacobian + columns * tet_residual_count * k : nullptr;
      if (k >= composite_points) {
        const auto& nodes = composite_tets[k - composite_points];
        if (jacobian)
          for (int i = 0; i < 4; ++i)
            add_node(rows, of_edges, nodes[i], table.part[k - composite_points][i]);
        continue;
      }
      const auto& c = table.point[k];
      const double j = f.determinant();
      mean += j / composite_points;
      if (!jacobian) continue;
      const Mat3 of_growth =
          j / composite_points * f.inverse().transpose() * rest.shape.transpose();
      for (int a = 0; a < composite_nodes; ++a) {
        add_node(rows, of_edges, a, c[a]);
        growth.template segment<3>(3 * a) +=
            (of_growth * Eigen::Map<const Vec3>(c[a].data())).transpose();
      }
    }
    const double root_volume = std::sqrt(tets.volume_of(t));
    r[residual_count - 1] = root_volume * this->split_.volume.root(mean);
    if (jacobian)
      all.row(residual_count - 1) = root_volume * this->split_.volume.root_slope(mean) * growth;
    return std::isfinite(r[residual_count - 1]);
  }

  bool squares_;
};

}  // namespace tack
