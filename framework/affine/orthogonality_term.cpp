#include "framework/affine/orthogonality_term.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "framework/affine/retraction.hpp"
#include "framework/assembly/psd_projection.hpp"
#include "framework/assembly/stencil_blocks.hpp"
#include "framework/assembly/symmetric_eigen.hpp"
#include "geometry/parallel.hpp"
#include "geometry/tet_edges.hpp"

namespace tack {
namespace {

Mat3 strain_of(const Mat3& a) { return 0.5 * (a.transpose() * a - Mat3::Identity()); }

}  // namespace

void OrthogonalityTerm::add(const Tet& frame, const VecX& rest, double volume, double stiffness) {
  frames_.push_back(frame);
  bodies_.push_back({edges_of(frame, rest).inverse(), stiffness * volume});
}

Mat3 OrthogonalityTerm::map_of(int body, const VecX& x) const { return edges_of(frames_[body], x) * bodies_[body].shape; }

Eigen::Matrix<double, 3, 4> OrthogonalityTerm::corners(int body) const {
  Eigen::Matrix<double, 3, 4> c;
  c.rightCols<3>() = bodies_[body].shape.transpose();
  c.col(0) = -c.rightCols<3>().rowwise().sum();
  return c;
}

double OrthogonalityTerm::largest_strain(const VecX& x) const {
  double largest = 0;
  for (int b = 0; b < static_cast<int>(bodies_.size()); ++b) {
    const Mat3 strain = strain_of(map_of(b, x));
    largest = std::max(largest, SymmetricEigen<3>(strain).values().lpNorm<Eigen::Infinity>());
  }
  return largest;
}

bool OrthogonalityTerm::retract(const DofMap& dofs, const VecX& q, VecX& p, double loss) const {
  std::vector<char> retracted(frames_.size(), 0);
  for_each(static_cast<int>(frames_.size()), [&](int b) {
    const Tet& frame = frames_[b];
    if (!std::all_of(frame.begin(), frame.end(), [&](int v) { return dofs.owns(v); })) return;
    Eigen::Matrix<double, 3, 4> x, displacement;
    for (int i = 0; i < 4; ++i) {
      x.col(i) = q.segment<3>(3 * dofs.block(frame[i]));
      displacement.col(i) = p.segment<3>(3 * dofs.block(frame[i]));
    }
    const Eigen::Matrix<double, 4, 3> map = corners(b).transpose();
    const Mat3 linear = displacement * map;
    const Mat3 a = x * map;
    Mat3 change = linear;
    if (!retract_change(a, change)) return;
    const Mat3 excess = strain_of(a + linear) - strain_of(a + change);
    if (bodies_[b].modulus / 2 * excess.squaredNorm() <= loss) return;
    // The change of A acts on the corners at rest, relative to their centroid.
    const Mat3 edges = bodies_[b].shape.inverse();
    const Vec3 first = -edges.rowwise().sum() / 4;
    for (int i = 0; i < 4; ++i) {
      const Vec3 rest = i == 0 ? first : Vec3(first + edges.col(i - 1));
      p.segment<3>(3 * dofs.block(frame[i])) += (change - linear) * rest;
    }
    retracted[b] = 1;
  }, 16);
  return std::any_of(retracted.begin(), retracted.end(), [](char b) { return b != 0; });
}

double OrthogonalityTerm::energy(int b, const VecX& x) const { return bodies_[b].modulus / 2 * strain_of(map_of(b, x)).squaredNorm(); }

double OrthogonalityTerm::value(const VecX& x) const {
  return sum_chunks(static_cast<int>(bodies_.size()), [&](int first, int last) {
    double sum = 0;
    for (int b = first; b < last; ++b) sum += energy(b, x);
    return sum;
  });
}

bool OrthogonalityTerm::visit_energies(const VecX& x, const EnergyVisitor& visit) const {
  for (size_t b = 0; b < bodies_.size(); ++b) visit(frames_[b], energy(static_cast<int>(b), x));
  return true;
}

std::vector<StencilBatch> OrthogonalityTerm::batches() const {
  return {{4, static_cast<int>(frames_.size()), frames_.empty() ? nullptr : frames_.front().data()}};
}

void OrthogonalityTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  for_each(static_cast<int>(bodies_.size()), [&](int b) {
    const Mat3 a = map_of(b, x), strain = strain_of(a);
    const auto c = corners(b);
    const double modulus = bodies_[b].modulus;
    Eigen::Map<Eigen::Matrix<double, 3, 4>>{gradient + 12 * static_cast<size_t>(b)} = modulus * a * strain * c;
    if (!hessian) return;
    // d(A E) = dA E + A (dA^T A + A^T dA) / 2, with dA = dx_k c_k^T.
    Eigen::Matrix<double, 12, 12> h;
    const Mat3 outer = a * a.transpose();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const Vec3 ci = c.col(i), cj = c.col(j);
        h.block<3, 3>(3 * i, 3 * j) = modulus * (ci.dot(strain * cj) * Mat3::Identity() + 0.5 * (ci.dot(cj) * outer) +
                                                 0.5 * (a * cj) * (a * ci).transpose());
      }
    if (projection != Projection::none) project_stencil_psd<4>(h, projection);
    store_blocks<4>(h, hessian + 90 * static_cast<size_t>(b));
  }, 16);
}

std::vector<ResidualBatch> OrthogonalityTerm::residual_batches() const {
  return {{4, 6, static_cast<int>(frames_.size()), frames_.empty() ? nullptr : frames_.front().data()}};
}

// Returns the six strains of each body, those of shear times the root of two.
bool OrthogonalityTerm::residuals(const VecX& x, double* r, double* jacobian) const {
  for (int b = 0; b < static_cast<int>(bodies_.size()); ++b) {
    const Mat3 a = map_of(b, x), strain = strain_of(a);
    const auto c = corners(b);
    const double root = std::sqrt(bodies_[b].modulus);
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        const double factor = i == j ? root : std::sqrt(2.0) * root;
        *r++ = factor * strain(i, j);
        if (!jacobian) continue;
        for (int k = 0; k < 4; ++k, jacobian += 3)
          Eigen::Map<Vec3>{jacobian} = factor / 2 * (c(i, k) * a.col(j) + c(j, k) * a.col(i));
      }
  }
  return true;
}

}  // namespace tack
