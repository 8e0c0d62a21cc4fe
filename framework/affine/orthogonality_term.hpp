// What keeps affine bodies rigid (Lan et al. 2022, Affine Body Dynamics, eq. 4):
//     P = sum over bodies of kappa/2 V |E|^2,   E = (A^T A - I) / 2,
// A the linear part of the body's affine map, V its volume, kappa its stiffness [Pa]: a bar that is stretched by a
// stress s gets the strain s / kappa.
#pragma once

#include <vector>

#include "framework/core/dof_map.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

// What the stiffness of a body keeps its strains below unless the scene gives it; beyond, a run warns.
inline constexpr double tolerated_affine_strain = 1e-4;

class OrthogonalityTerm : public Term, public ResidualView {
 public:
  OrthogonalityTerm() : Term("affine") {}

  // rest: 3n [m]; volume [m^3]; stiffness [Pa].
  void add(const Tet& frame, const VecX& rest, double volume, double stiffness);
  bool empty() const { return frames_.empty(); }
  // Bends the step p from the unknowns q of bodies that are free as a whole (bent_change.hpp), where turning them straight
  // would cost more than `loss` [J]; their centroids go straight. False if there are none.
  bool bend(const DofMap& dofs, const VecX& q, VecX& p, double loss) const;
  // The largest principal strain of any body, by magnitude.
  double largest_strain(const VecX& x) const;

  double value(const VecX& x) const override;
  bool share_energy(const VecX& x, const EnergyShare& share) const override;
  std::vector<StencilBatch> batches() const override;
  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override;

  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override;
  bool residuals(const VecX& x, double* r, double* jacobian) const override;

 private:
  struct Body {
    Mat3 shape;    // rest edges^-1 [1/m]
    double modulus;  // kappa V [J]
  };
  double energy(int body, const VecX& x) const;  // J
  Mat3 map_of(int body, const VecX& x) const;  // A
  Eigen::Matrix<double, 3, 4> corners(int body) const;  // d A / d x: A = sum_a x_a corners.col(a)^T

  std::vector<Tet> frames_;
  std::vector<Body> bodies_;
};

}  // namespace tack
