// Implicit Euler, linearised at the start of the step: of displacements p of the unknowns
//     A p = M h v + h^2 f - h^2 K_s p_s + h J^T lambda,    A = M + h^2 K
// with the forces f and the stiffness K (projected, with damping) of all terms but contact,
// friction and bonds, dynamic ones too, the prescribed displacements p_s, and impulses lambda along
// rows J [N s].
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
  // All must outlive it.
  LinearizedStep(World& world, PhaseClock& clock, LinearSolver& solver);
  ~LinearizedStep();

  void new_unknowns();
  // Factorises A and finds where the step would end without impulses; false if that fails.
  bool begin(const Step& step);
  const DofMap& dofs() const { return world_.dofs; }
  double h() const { return h_; }
  // Where the step ends with the displacements p beside those without impulses (3n).
  VecX end(const VecX& p) const;
  // rhs <- A^-1 rhs, of one or several columns in the unknowns.
  void solve(Eigen::MatrixXd& rhs);
  // Takes out what is held of partly held vertices: rows may not act there.
  void take_held_out(Eigen::Ref<VecX> column) const;

 private:
  VecX imposed(const Step& step);

  World& world_;
  PhaseClock& clock_;
  LinearSolver& solver_;
  std::vector<const Term*> terms_;
  std::unique_ptr<StepPotential> potential_;
  // With all held vertices free: how what the script moves acts on others. Only made if it moves
  // something.
  DofMap all_;
  std::unique_ptr<StepPotential> of_all_;
  VecX places_;  // 3n: what the script moves at its end, the rest at its start
  VecX free_;    // of the unknowns: p without impulses
  double h_ = 0;
};

}  // namespace tack
