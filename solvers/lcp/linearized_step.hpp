// Implicit Euler, linearised at the start of the step. For displacements p of the unknowns:
//     A p = M h v + h^2 f - h^2 K_s p_s + h J^T lambda,    A = M + h^2 K
// f, K: forces and stiffness (projected, with damping) of all terms, dynamic ones too, except
// contact, friction and bonds; p_s: prescribed displacements; lambda: impulses along rows J [N s].
#pragma once

#include <memory>
#include <optional>

#include "framework/core/linear_solver.hpp"
#include "framework/stepping/stepper.hpp"
#include "framework/world/world.hpp"

namespace tack {

class StepPotential;

class LinearizedStep {
 public:
  // All arguments must outlive the step.
  LinearizedStep(World& world, PhaseClock& clock, LinearSolver& solver);
  ~LinearizedStep();

  void new_unknowns();
  // Factorises A and finds the end of the step without impulses. Returns false if the factorisation
  // fails.
  bool begin(const Step& step);
  const DofMap& dofs() const { return world_.dofs; }
  double h() const { return h_; }
  // Returns the end configuration (3n) for displacements p due to impulses.
  VecX end(const VecX& p) const;
  // rhs <- A^-1 rhs; one column per right side.
  void solve(Eigen::MatrixXd& rhs);
  // Removes the constrained directions of partly constrained vertices, in which rows must not act.
  void take_held_out(Eigen::Ref<VecX> column) const;

 private:
  VecX imposed(const Step& step);

  World& world_;
  PhaseClock& clock_;
  LinearSolver& solver_;
  std::vector<const Term*> terms_;
  std::unique_ptr<StepPotential> potential_;
  // Stiffness with all prescribed vertices free, for their effect on others. Made only if a
  // prescribed vertex moves.
  DofMap all_;
  std::unique_ptr<StepPotential> of_all_;
  VecX x_fixed_;  // 3n: prescribed vertices at the end of the step, others at its start
  VecX free_;     // p without impulses
  double h_ = 0;
};

}  // namespace tack
