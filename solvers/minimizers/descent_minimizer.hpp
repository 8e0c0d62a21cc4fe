// The loop that all descent methods share: direction, stopping norm, feasible step, line search. A
// new method is a direction().
#pragma once

#include <memory>

#include "framework/core/minimizer.hpp"
#include "solvers/line_search/line_search.hpp"
#include "solvers/minimizers/stagnation.hpp"
#include "solvers/minimizers/convergence_judge.hpp"

namespace tack {

class DescentMinimizer : public Minimizer {
 public:
  void fields(Fields& f) override;
  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) final;

 protected:
  // A step that was taken: q <- q + length * p.
  struct Step {
    const VecX& p;
    double length;    // [1]
    double feasible;  // the largest that the step filters allowed
    int evaluations;  // of the line search: 1 if it took the first length it tried
    double slope;     // p . gradient at the start
    double decrease;  // of the objective
  };

  // A minimisation starts; the objective is at its first point.
  virtual void begin(const MinimizerProblem&, MinimizerResult&) {}
  // p <- a direction of descent at the objective's present point. Anything but `converged` ends the
  // minimisation. (The gradient is checked to be finite: before the call unless newton_like, and
  // after.)
  virtual MinimizerStatus direction(const MinimizerProblem& problem, VecX& p,
                                    MinimizerResult& result) = 0;
  // The objective is at the new point.
  virtual void stepped(const MinimizerProblem&, const Step&) {}
  // Whether the length of p tells how far the minimum is, as a Newton direction's does.
  virtual bool newton_like() const { return false; }
  // The stopping norm of p, a direction that is newton_like, and of what p may miss of the exact
  // one.
  virtual double newton_norm(const MinimizerProblem& problem, VecX& p, MinimizerResult&) {
    return problem.stopping_norm(p, problem.objective.gradient());
  }
  // Whether p may be replaced by another one where no step along it decreases the objective: false
  // if there is nothing left to try.
  virtual bool restart(const MinimizerProblem&) { return false; }

 private:
  MinimizerResult descend(const MinimizerProblem& problem, VecX& q, MinimizerResult& result);
  MinimizerStatus advance(const MinimizerProblem& problem, const VecX& p, VecX& q,
                          MinimizerResult& result);
  bool advance_bent(const MinimizerProblem& problem, const VecX& p, VecX& q,
                    MinimizerResult& result);
  void conjugate(const MinimizerProblem& problem, const VecX& q, VecX& p, bool within);
  void extend(const MinimizerProblem& problem, const VecX& p, double first_slope, double before,
              VecX& q, MinimizerResult& result);

  std::unique_ptr<LineSearch> line_search_ = Registry<LineSearch>::make("backtracking");
  VecX gradient_before_, q_before_;  // of the last iteration of this minimisation
  bool too_stiff_ = false;  // Hessians of this minimisation, since some step, and none was cut
  bool cut_ = false;        // the last step
  bool unbalanced_ = false;  // after the last step, which was below the tolerance
  bool accelerated_ = false;  // the present one: conjugate to the last, and prolonged
  double room_ = 0;           // for it, in units of its direction
  ConvergenceJudge judge_;
  Stagnation stagnation_;
};

}  // namespace tack
