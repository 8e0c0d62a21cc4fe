// Ceres' line-search methods on the guarded problem (guarded_problem.hpp). A trial whose path from
// the last accepted point is blocked is invalid to Ceres, which then shortens its step. Each Ceres
// iteration is one accepted point. Where Ceres gives up, it is restarted with new scales and no
// history; if the restart accepts no point, the minimisation ends.
#include <ceres/first_order_function.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/iteration_callback.h>
#include <fmt/format.h>

#include "framework/config/field.hpp"
#include "geometry/errors.hpp"
#include "solvers/minimizers/external/ceres_common.hpp"
#include "solvers/minimizers/guarded_problem.hpp"

namespace tack {
namespace {

class GuardedFunction : public ceres::FirstOrderFunction {
 public:
  explicit GuardedFunction(GuardedProblem& guarded) : guarded_(guarded) {}
  int NumParameters() const override { return guarded_.size(); }
  bool Evaluate(const double* z, double* cost, double* gradient) const override {
    if (guarded_.over() || guarded_.makes_no_progress()) return false;
    try {
      return guarded_.evaluate(z, *cost, gradient) == GuardedProblem::Trial::usable;
    } catch (...) {
      guarded_.fail(std::current_exception());
      return false;
    }
  }

 private:
  GuardedProblem& guarded_;
};

class AcceptIterate : public ceres::IterationCallback {
 public:
  AcceptIterate(GuardedProblem& guarded, const VecX& z) : guarded_(guarded), z_(z) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    try {
      if (s.iteration > 0 && !guarded_.over() && !guarded_.accept(z_.data())) return ceres::SOLVER_ABORT;
    } catch (...) {
      guarded_.fail(std::current_exception());
    }
    return guarded_.over() ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

 private:
  GuardedProblem& guarded_;
  const VecX& z_;  // Ceres' iterate
};

}  // namespace

class CeresLineSearch : public Minimizer {
 public:
  enum class Direction { lbfgs, bfgs, nonlinear_conjugate_gradients };
  enum class Conjugate { fletcher_reeves, polak_ribiere, hestenes_stiefel };

  void fields(Fields& f) override {
    Minimizer::fields(f);
    f.choice("direction", direction_,
             {{"lbfgs", Direction::lbfgs, "limited-memory BFGS"},
              {"bfgs", Direction::bfgs, "BFGS with a dense matrix"},
              {"nonlinear_conjugate_gradients", Direction::nonlinear_conjugate_gradients, "see `conjugate`"}},
             "method of the search direction");
    f.choice("conjugate", conjugate_,
             {{"fletcher_reeves", Conjugate::fletcher_reeves, "|g'|^2 / |g|^2"},
              {"polak_ribiere", Conjugate::polak_ribiere, "g'.(g' - g) / |g|^2"},
              {"hestenes_stiefel", Conjugate::hestenes_stiefel, "g'.(g' - g) / p.(g' - g)"}},
             "factor of the last direction in conjugate gradients");
    f.integer("memory", memory_, "curvature pairs that lbfgs stores").at_least(1);
  }

  void admit(const std::vector<const Term*>&, int unknowns) const override {
    if (direction_ == Direction::bfgs && unknowns > most_dense)
      throw InputError(fmt::format("ceres_line_search: bfgs keeps a dense matrix, and {} unknowns are more than "
                                   "{}; use direction: lbfgs", unknowns, most_dense));
  }

  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) override {
    return minimize_in_rounds(problem, judge_, max_iterations_, q,
                              [this](GuardedProblem& guarded) { round(guarded); });
  }

 private:
  static constexpr int most_dense = 5000;  // unknowns: a matrix of 200 MB

  void round(GuardedProblem& guarded) const {
    VecX z = VecX::Zero(guarded.size());
    const ceres::GradientProblem problem(new GuardedFunction(guarded));  // owns the function
    AcceptIterate accept(guarded, z);
    ceres::GradientProblemSolver::Summary summary;
    ceres::Solve(options(accept), problem, z.data(), &summary);
  }

  ceres::GradientProblemSolver::Options options(AcceptIterate& accept) const {
    ceres::GradientProblemSolver::Options o;
    o.line_search_direction_type = direction_ == Direction::lbfgs  ? ceres::LBFGS
                                   : direction_ == Direction::bfgs ? ceres::BFGS
                                                                   : ceres::NONLINEAR_CONJUGATE_GRADIENT;
    o.nonlinear_conjugate_gradient_type = conjugate_ == Conjugate::fletcher_reeves ? ceres::FLETCHER_REEVES
                                          : conjugate_ == Conjugate::polak_ribiere ? ceres::POLAK_RIBIERE
                                                                                   : ceres::HESTENES_STIEFEL;
    o.line_search_type = ceres::WOLFE;
    o.max_lbfgs_rank = memory_;
    o.use_approximate_eigenvalue_bfgs_scaling = true;
    o.max_num_iterations = max_iterations_;
    // The judge decides on convergence, not Ceres.
    o.function_tolerance = o.gradient_tolerance = o.parameter_tolerance = 0;
    o.update_state_every_iteration = true;
    o.callbacks.push_back(&accept);
    silence(o);
    return o;
  }

  Direction direction_ = Direction::lbfgs;
  Conjugate conjugate_ = Conjugate::hestenes_stiefel;  // the fewest iterations of the three
  int memory_ = 20;
  ConvergenceJudge judge_;
};

TACK_REGISTER(Minimizer, CeresLineSearch, "ceres_line_search",
              "Line-search methods of Ceres Solver, preconditioned by the Hessian's diagonal: hundreds of cheap "
              "iterations if contact is stiff, too many under prescribed motion; bfgs takes at most 5000 unknowns.",
              "Agarwal, Mierle and others, Ceres Solver 2.1");

}  // namespace tack
