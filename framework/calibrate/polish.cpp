#include "framework/calibrate/polish.hpp"

#include <ceres/ceres.h>
#include <gflags/gflags_declare.h>

#include <algorithm>
#include <exception>

DECLARE_int32(minloglevel);  // of glog, through which Ceres prints to stderr

namespace tack {
namespace {

class Residuals : public ceres::CostFunction {
 public:
  Residuals(const PolishProblem& problem, int size, int unknowns) : problem_(problem) {
    set_num_residuals(size);
    mutable_parameter_block_sizes()->push_back(unknowns);
  }

  // Clamps to the bounds itself: with Ceres' own bounds, every step has a line search, and
  // evaluations are expensive.
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    if (failure_) return false;
    try {
      std::vector<double> u;
      for (size_t i = 0; i < problem_.low.size(); ++i) u.push_back(std::clamp(parameters[0][i], problem_.low[i], problem_.high[i]));
      return evaluate(u, residuals, jacobians ? jacobians[0] : nullptr);
    } catch (...) {  // no exceptions through a library that does not clean up
      failure_ = std::current_exception();
      return false;
    }
  }

  const std::exception_ptr& failure() const { return failure_; }

 private:
  bool evaluate(const std::vector<double>& u, double* residuals, double* jacobian) const {
    std::vector<double> found;
    if (!problem_.residuals(u, found)) return false;
    std::copy(found.begin(), found.end(), residuals);
    if (!jacobian) return true;
    Eigen::MatrixXd derivatives;
    if (!problem_.jacobian(u, derivatives)) return false;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(jacobian, derivatives.rows(), derivatives.cols()) = derivatives;
    return true;
  }

  const PolishProblem& problem_;
  mutable std::exception_ptr failure_;
};

}  // namespace

void polish(const PolishProblem& p, const std::vector<double>& start, int size) {
  const int unknowns = static_cast<int>(start.size());
  std::vector<double> u = start;
  Residuals cost(p, size, unknowns);
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  problem.AddResidualBlock(&cost, nullptr, u.data());
  double length = 0;
  for (const double x : u) length += x * x;
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = p.iterations;
  options.max_num_consecutive_invalid_steps = 2;
  options.initial_trust_region_radius = 10;
  options.function_tolerance = 1e-3;
  options.parameter_tolerance = p.tolerance / (1 + std::sqrt(length));
  options.logging_type = ceres::SILENT;
  FLAGS_minloglevel = 3;  // only fatal errors
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (cost.failure()) std::rethrow_exception(cost.failure());
}

}  // namespace tack
