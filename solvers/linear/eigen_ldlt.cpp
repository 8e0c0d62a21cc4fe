// Eigen's simplicial LDL^T: no dense kernels, a second opinion on small problems.
#include "solvers/linear/direct_solver.hpp"
#include "solvers/linear/simplicial_factor.hpp"

namespace tack {

class EigenLdlt : public DirectSolver {
 public:
  bool factorize_blocks(const BlockMatrix& matrix, PhaseClock& clock) override { return factor_.factorize(matrix, clock) && factor_.pivots().minCoeff() > 0; }
  void solve_blocks(const VecX& b, VecX& x, PhaseClock& clock) override { x = factor_.solve(b, clock); }
  int analyses() const override { return factor_.analyses(); }

 private:
  SimplicialFactor factor_;
};

TACK_REGISTER(LinearSolver, EigenLdlt, "eigen_ldlt",
              "Sparse LDL^T factorisation by Eigen, without dense kernels.",
              "Eigen 3.4, SimplicialLDLT");

}  // namespace tack
