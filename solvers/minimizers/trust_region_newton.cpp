// Trust-region Newton method. Conjugate gradients minimise the quadratic model
//     m(p) = g . p + 1/2 p . H p   within   |p|_M <= radius,
// M the preconditioner, and end where they leave the ball or meet a negative curvature (Steihaug
// 1983; Nocedal and Wright, algorithm 7.2; with a preconditioner Conn, Gould and Toint, algorithm
// 7.5.1). So H need not be projected. The step policies then truncate p to its feasible length and
// line-search it: a decrease that falls short is repaired by a shorter step along p, which costs
// values only, instead of a new p in a smaller ball (Nocedal and Yuan 1998). The radius follows
// the ratio of the decrease to that of the model at the step that was made, so that truncation by
// contact does not count against the model. There is no bound before the first step that is poor
// or of negative curvature; a negative curvature then ends the gradients at their iterate (Dembo
// and Steihaug 1983).
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "framework/core/symmetric_product.hpp"
#include "solvers/linear/preconditioner.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "solvers/minimizers/direction_check.hpp"
#include "solvers/minimizers/forcing_term.hpp"

namespace tack {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

// Conjugate gradients in a ball. As a LinearSolver, in a ball of infinite radius.
class BoundedGradients : public LinearSolver {
 public:
  enum class End { solved, boundary, negative_curvature, too_slow };

  void fields(Fields& f) override {
    f.component("preconditioner", preconditioner_, "approximate inverse of the Hessian, and metric of the trust region");
    f.integer("cg_iterations_max", iterations_max_, "conjugate gradients of a system, after which their iterate is the direction").at_least(1);
  }
  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) override {
    const PhaseScope scope(clock, Phase::factorize);
    clock.count_factorization();
    matrix_ = &matrix;
    return preconditioner_->update(matrix, clock.deadline());
  }
  void set_matrix(const BlockMatrix& matrix) { matrix_ = &matrix; }  // of later products
  void solve(const VecX& b, VecX& x, PhaseClock& clock) override { correct(b, x, 1e-2, clock); }
  void correct(const VecX& b, VecX& x, double relative, PhaseClock& clock) override {
    if (minimize(b, x, relative, unbounded, clock) != End::solved) x.setConstant(b.size(), std::numeric_limits<double>::quiet_NaN());
  }
  int analyses() const override { return 0; }
  int iterations() const override { return iterations_; }

  // x <- a minimum of 1/2 x . A x - x . b in the ball, from x = 0, to the residual `relative` in
  // the norm of the preconditioner.
  End minimize(const VecX& b, VecX& x, double relative, double radius, PhaseClock& clock) {
    const PhaseScope scope(clock, Phase::solve);
    x.setZero(b.size());
    residual_ = b;
    preconditioner_->apply(residual_, z_);
    direction_ = z_;
    double rz = residual_.dot(z_), dd = rz, xd = 0, xx = 0;  // dd, xd, xx: products in the metric M
    first_length_ = length_ = 0;
    const double enough = relative * relative * rz;
    for (iterations_ = 0; rz > enough; ++iterations_) {
      if (iterations_ == iterations_max_) return End::too_slow;
      clock.deadline().check();
      product_.multiply(*matrix_, direction_, image_);
      const double curvature = direction_.dot(image_), step = rz / curvature;
      if (std::isnan(curvature)) {
        x.setConstant(b.size(), curvature);
        return End::too_slow;
      }
      const double next_xx = xx + step * (2 * xd + step * dd);
      if (!(curvature > 0) || next_xx >= radius * radius) {
        const End end = curvature > 0 ? End::boundary : End::negative_curvature;
        if (radius < unbounded) advance((std::sqrt(xd * xd + dd * (radius * radius - xx)) - xd) / dd, x);
        else if (iterations_ == 0) advance(1, x);
        length_ = radius < unbounded ? radius : iterations_ == 0 ? std::sqrt(dd) : std::sqrt(xx);
        if (iterations_++ == 0) first_length_ = length_;
        return end;
      }
      advance(step, x);
      preconditioner_->apply(residual_, z_);
      const double next = residual_.dot(z_), ratio = next / rz;
      xd = ratio * (xd + step * dd);
      dd = next + ratio * ratio * dd;
      direction_ = z_ + ratio * direction_;
      rz = next;
      xx = next_xx;
      length_ = std::sqrt(xx);
      if (iterations_ == 0) first_length_ = length_;
    }
    if (rz >= 0) return End::solved;
    x.setConstant(b.size(), std::numeric_limits<double>::quiet_NaN());  // no positive definite preconditioner
    return End::too_slow;
  }
  // Return, for the last minimum, its length and that of the first iterate in the metric M, and
  // x . A x.
  double length() const { return length_; }
  double first_length() const { return first_length_; }
  double curvature(const VecX& b, const VecX& x) const { return x.dot(b - residual_); }

 private:
  void advance(double step, VecX& x) {
    x += step * direction_;
    residual_ -= step * image_;
  }

  std::unique_ptr<Preconditioner> preconditioner_ = Registry<Preconditioner>::make("incomplete_cholesky");
  int iterations_max_ = 1000;
  const BlockMatrix* matrix_ = nullptr;
  SymmetricProduct product_;
  VecX residual_, z_, direction_, image_;
  double length_ = 0, first_length_ = 0;
  int iterations_ = 0;
};

class TrustRegionNewton : public DescentMinimizer {
 public:
  enum class Hessian { none, contacts, clamp };

  void fields(Fields& f) override {
    DescentMinimizer::fields(f);
    f.choice("projection", projection_,
             {{"none", Hessian::none, "the exact Hessian"},
              {"contacts", Hessian::contacts, "negative eigenvalues of contacts become zero"},
              {"clamp", Hessian::clamp, "negative eigenvalues of all stencils become zero"}},
             "projection of the Hessian of the model");
    forcing_.fields(f);
    gradients_.fields(f);
  }
  std::string linear_solver() const override { return "conjugate gradients in the trust region"; }

 protected:
  bool newton_like() const override { return end_ == BoundedGradients::End::solved; }
  double newton_norm(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) override {
    return check_.norm(gradients_, *hessian_, problem, p, result);
  }

  void begin(const MinimizerProblem&, MinimizerResult&) override {
    forcing_.begin();
    end_ = BoundedGradients::End::solved;
    radius_ = unbounded;
  }

  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult& result) override {
    Objective& objective = problem.objective;
    hessian_ = &objective.hessian(request());
    ++result.linear_solves;
    if (!gradients_.factorize(*hessian_, problem.clock)) {  // a diagonal block is indefinite
      if (!precondition_by_clamped(problem)) return MinimizerStatus::factorization_failed;
      hessian_ = &objective.hessian(request());
      gradients_.set_matrix(*hessian_);
    }
    const VecX b = -objective.gradient();
    end_ = gradients_.minimize(b, p, forcing_.next(b.norm()), radius_, problem.clock);
    result.linear_iterations += gradients_.iterations();
    curvature_ = gradients_.curvature(b, p);
    length_ = gradients_.length();
    steepest_ = gradients_.iterations() <= 1;
    return p.allFinite() && !(p.dot(b) < 0) ? MinimizerStatus::converged : MinimizerStatus::factorization_failed;
  }

  void stepped(const MinimizerProblem& problem, const Step& step) override {
    constexpr double poor = 0.25, good = 0.75, smaller = 0.25, larger = 2;  // Nocedal and Wright, algorithm 4.1
    const double t = step.length, predicted = -t * (step.slope + t / 2 * curvature_);
    const double ratio = std::abs(step.decrease) <= problem.objective.value_noise() ? 1 : step.decrease / predicted;
    if (step.evaluations > 1) radius_ = length_ * t / step.feasible;
    else if (ratio < poor) radius_ = smaller * length_;
    else if (end_ != BoundedGradients::End::solved && step.feasible == 1) radius_ = ratio > good ? larger * length_ : length_;
  }

  // Half the first iterate: the preconditioned steepest descent.
  bool restart(const MinimizerProblem&) override {
    radius_ = gradients_.first_length() / 2;
    return !steepest_;
  }

 private:
  // Makes the preconditioner of the clamped Hessian, shifted where nothing holds a block. The shift
  // is relative to the largest diagonal entry of the model's.
  bool precondition_by_clamped(const MinimizerProblem& problem) {
    double largest = 0;
    for (int c = 0; c < hessian_->columns(); ++c) largest = std::max(largest, hessian_->block(hessian_->column_start[c]).diagonal().cwiseAbs().maxCoeff());
    clamped_ = problem.objective.hessian({Projection::clamp});
    for (const double shift : {0.0, 1e-8, 1e-4, 1.0}) {
      for (int c = 0; c < clamped_.columns(); ++c) clamped_.block(clamped_.column_start[c]).diagonal().array() += shift * largest;
      if (gradients_.factorize(clamped_, problem.clock)) return true;
    }
    return false;
  }
  HessianRequest request() const {
    switch (projection_) {
      case Hessian::none: return {};
      case Hessian::contacts: return {.dynamic_projection = Projection::clamp};
      default: return {Projection::clamp};
    }
  }

  Hessian projection_ = Hessian::none;
  ForcingTerm forcing_;
  BoundedGradients gradients_;
  DirectionCheck check_;
  const BlockMatrix* hessian_ = nullptr;  // of the last model
  BlockMatrix clamped_;                   // that the preconditioner is made of, where it is not the model's
  BoundedGradients::End end_ = BoundedGradients::End::solved;
  double radius_ = unbounded;         // in the norm of the preconditioner
  double length_ = 0, curvature_ = 0;  // of the last direction p: |p|_M, p . H p
  bool steepest_ = false;             // it is the preconditioned gradient
};

TACK_REGISTER(Minimizer, TrustRegionNewton, "trust_region_newton",
              "Newton's method with exact Hessians: conjugate gradients in a trust region.",
              "Steihaug 1983; Nocedal and Wright, Numerical Optimization, algorithm 7.2");

}  // namespace
}  // namespace tack
