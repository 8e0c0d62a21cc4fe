// Stiffness of affine bodies against strain (Lan et al. 2022, Affine Body Dynamics, eq. 4):
//     P = sum over bodies of kappa/2 V |E|^2,   E = (A^T A - I) / 2,
// A the linear part of the body's affine map, V its volume, kappa its stiffness [Pa]. A bar under
// the stress s has the strain s / kappa.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

// Strain for which the default stiffness is chosen; a run warns if strains exceed it.
inline constexpr double tolerated_affine_strain = 1e-4;

class OrthogonalityTerm : public Term, public ResidualView {
 public:
  OrthogonalityTerm() : Term("affine") {}

  // rest: 3n [m]; volume [m^3]; stiffness [Pa].
  void add(const Tet& frame, const VecX& rest, double volume, double stiffness);
  bool empty() const { return frames_.empty(); }
  // Retracts the step p from the unknowns q onto rotations (retraction.hpp), for bodies without
  // fixed vertices whose strain energy under p would exceed `loss` [J]. Centroids move along p.
  // Returns false if there are no such bodies.
  bool retract(const DofMap& dofs, const VecX& q, VecX& p, double loss) const;
  // Returns the principal strain of largest magnitude of all bodies.
  double largest_strain(const VecX& x) const;

  double value(const VecX& x) const override;
  bool visit_energies(const VecX& x, const EnergyVisitor& visit) const override;
  std::vector<StencilBatch> batches() const override;
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;

  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override;
  bool residuals(const VecX& x, double* r, double* jacobian) const override;

 private:
  struct Body {
    Mat3 shape;      // rest edges^-1 [1/m]
    double modulus;  // kappa V [J]
  };
  double energy(int body, const VecX& x) const;         // J
  Mat3 map_of(int body, const VecX& x) const;           // A
  Eigen::Matrix<double, 3, 4> corners(int body) const;  // d A / d x: A = sum_a x_a corners.col(a)^T

  std::vector<Tet> frames_;
  std::vector<Body> bodies_;
};

}  // namespace tack
