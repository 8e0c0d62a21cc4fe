// The residual model as a Ceres problem: one cost function per stencil and per block of unknowns.
// Blocks of unknowns are the parameter blocks.
#pragma once

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/iteration_callback.h>

#include <algorithm>

#include "framework/core/phase_clock.hpp"
#include "solvers/minimizers/residual_model.hpp"

namespace tack {

// Residuals of one stencil, already evaluated by the model.
class StencilCost : public ceres::CostFunction {
 public:
  StencilCost(const ResidualModel& model, const ResidualModel::Stencil& stencil, const bool& finite)
      : model_(model), stencil_(stencil), finite_(finite) {
    set_num_residuals(stencil.residuals);
    mutable_parameter_block_sizes()->assign(stencil.blocks, 3);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (!finite_) return false;
    std::copy_n(model_.residuals(stencil_), stencil_.residuals, residuals);
    if (!jacobians) return true;
    for (int k = 0; k < stencil_.blocks; ++k)
      if (double* out = jacobians[k])
        for (int row = 0; row < stencil_.residuals; ++row)
          std::copy_n(model_.jacobian(stencil_) + 3 * (stencil_.blocks * row + k), 3,
                      out + 3 * row);
    return true;
  }

 private:
  const ResidualModel& model_;
  const ResidualModel::Stencil& stencil_;
  const bool& finite_;
};

// sqrt(M) (q - target) of one block of unknowns.
class InertiaCost : public ceres::CostFunction {
 public:
  InertiaCost(const ResidualModel& model, int block)
      : root_(model.root_mass(block)), target_(model.target(block)) {
    set_num_residuals(3);
    mutable_parameter_block_sizes()->push_back(3);
  }
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    for (int c = 0; c < 3; ++c) residuals[c] = root_ * (x[0][c] - target_(c));
    if (jacobians && jacobians[0])
      for (int k = 0; k < 9; ++k) jacobians[0][k] = k % 4 == 0 ? root_ : 0;
    return true;
  }

 private:
  double root_;  // kg^1/2
  Vec3 target_;  // m
};

// Evaluates the model once per evaluation of all residuals, and stores the first trial point.
class EvaluateModel : public ceres::EvaluationCallback {
 public:
  EvaluateModel(ResidualModel& model, PhaseClock& clock) : model_(model), clock_(clock) {}
  void PrepareForEvaluation(bool with_jacobian, bool) override {
    const PhaseScope scope(clock_, Phase::assembly);
    finite = model_.evaluate(with_jacobian);
    if (first_trial.size() == 0 && model_.q() != start_) first_trial = model_.q();
  }
  bool finite = true;
  VecX first_trial;  // 3m; empty before the first trial

 private:
  ResidualModel& model_;
  PhaseClock& clock_;
  const VecX start_ = model_.q();
};

// Ends Ceres after a number of successful steps.
class StopAfter : public ceres::IterationCallback {
 public:
  explicit StopAfter(int steps) : left_(steps) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    radius = s.trust_region_radius;
    if (s.iteration == 0 || !s.step_is_successful) return ceres::SOLVER_CONTINUE;
    return --left_ == 0 ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
  double radius = 0;

 private:
  int left_;
};

}  // namespace tack
