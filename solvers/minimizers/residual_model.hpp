// A least-squares model of an incremental potential around one point q0:
//     1/2 |sqrt(M) (q - target)|^2 + 1/2 sum over terms of scale |r(q)|^2,
// with the residuals of all terms over the stencils that are active at q0. The other terms of the
// potential (residual_view.hpp) act with their force at q0, which is folded into the target: the
// model's gradient at q0 is the potential's. Without inertia, a weak pull towards q0 takes its
// place.
#pragma once

#include "framework/core/objective.hpp"
#include "framework/core/residual_view.hpp"

namespace tack {

class ResidualModel {
 public:
  // The objective is at q0 and must stay there while the model is used.
  explicit ResidualModel(Objective& objective);
  ResidualModel(const ResidualModel&) = delete;
  ResidualModel& operator=(const ResidualModel&) = delete;

  // A stencil with the blocks of unknowns that move its vertices.
  struct Stencil {
    int arity, residuals, blocks;
    size_t first;  // index of its first residual
    // Index of its Jacobian by vertices: residuals x (3 arity), row-major.
    size_t first_of_vertices;
    size_t first_jacobian;  // index of its Jacobian by blocks: residuals x (3 blocks), row-major
    // Indices of its blocks, and of the weights of each vertex on all blocks.
    size_t first_block, first_weight;
  };
  const std::vector<Stencil>& stencils() const { return stencils_; }
  const DofMap& dofs() const { return squares_.dofs; }
  double root_mass(int block) const { return root_mass_(block); }
  Vec3 target(int block) const { return target_.segment<3>(3 * block); }

  // Unknowns (3m) to evaluate at, initially q0. Methods that own the unknowns write to them.
  VecX& q() { return q_; }
  // Evaluates residuals and, if wanted, Jacobians at q(). Returns false if a residual is not
  // finite.
  bool evaluate(bool with_jacobian);
  const double* residuals(const Stencil& s) const { return r_.data() + s.first; }
  const int* blocks(const Stencil& s) const { return blocks_.data() + s.first_block; }
  // Jacobian by the unknowns, without their constrained directions.
  const double* jacobian(const Stencil& s) const { return jacobian_.data() + s.first_jacobian; }

 private:
  void lay_out();
  void add(const ResidualBatch& batch, const int* vertices);
  void reduce(const Stencil& s);
  void fold(const VecX& gradient);

  LeastSquares squares_;
  std::vector<Stencil> stencils_;
  std::vector<std::pair<size_t, size_t>> view_start_;  // per view: its first residual and entry
  VecX q_, x_, root_mass_, target_;                    // m; m; kg^1/2; m
  std::vector<int> blocks_;                            // blocks of all stencils
  std::vector<double> weights_;
  std::vector<int> constrained_;  // per block: index among the partly fixed blocks, or -1
  std::vector<double> r_, of_vertices_, jacobian_;
};

}  // namespace tack
