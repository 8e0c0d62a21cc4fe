// The gradient methods of NLopt on the guarded problem (guarded_problem.hpp). NLopt has no notion
// of an invalid point and stops or hangs on infinities: a trial with a blocked path gets the finite
// quadratic penalty of evaluate_penalty() instead. (A box around each round's start in which nothing
// can collide would shrink with the gaps, to micrometres in contact, and a step would take
// thousands of rounds.) NLopt does not report accepted points, so every trial lower than all before
// becomes the accepted point: one iteration.
#include <fmt/format.h>
#include <nlopt.h>

#include <memory>

#include "framework/config/field.hpp"
#include "geometry/errors.hpp"
#include "solvers/minimizers/guarded_problem.hpp"

namespace tack {
namespace {

struct Callback {
  GuardedProblem& guarded;
  nlopt_opt opt;
};

// Called by C code; must not throw.
double guarded_value(unsigned, const double* z, double* gradient, void* data) noexcept {
  auto& [guarded, opt] = *static_cast<Callback*>(data);
  double f = guarded.accepted_value();
  try {
    if (guarded.evaluate(z, f, gradient) == GuardedProblem::Trial::usable) {
      if (f < guarded.accepted_value()) guarded.accept(z);
    } else {
      guarded.evaluate_penalty(z, f, gradient);
    }
  } catch (...) {
    guarded.fail(std::current_exception());
  }
  if (guarded.over() || guarded.makes_no_progress()) nlopt_force_stop(opt);
  return f;
}

}  // namespace

class Nlopt : public Minimizer {
 public:
  void fields(Fields& f) override {
    Minimizer::fields(f);
    f.choice("algorithm", algorithm_,
             {{"lbfgs", NLOPT_LD_LBFGS, "limited-memory BFGS"},
              {"tnewton", NLOPT_LD_TNEWTON, "truncated Newton"},
              {"tnewton_restart", NLOPT_LD_TNEWTON_RESTART, "restarted with the steepest descent"},
              {"tnewton_precond", NLOPT_LD_TNEWTON_PRECOND, "preconditioned by limited-memory BFGS"},
              {"tnewton_precond_restart", NLOPT_LD_TNEWTON_PRECOND_RESTART, "preconditioned and restarted"},
              {"var1", NLOPT_LD_VAR1, "shifted limited-memory variable metric, rank 1"},
              {"var2", NLOPT_LD_VAR2, "shifted limited-memory variable metric, rank 2"},
              {"mma", NLOPT_LD_MMA, "moving asymptotes; first order"},
              {"ccsaq", NLOPT_LD_CCSAQ, "conservative separable quadratic approximations; first order"},
              {"slsqp", NLOPT_LD_SLSQP, "sequential quadratic programming with dense matrices"}},
             "the method");
    f.integer("memory", memory_, "curvature pairs that limited-memory methods store").at_least(1);
  }

  void admit(const std::vector<const Term*>&, int unknowns) const override {
    if (algorithm_ == NLOPT_LD_SLSQP && unknowns > most_dense)
      throw InputError(fmt::format("nlopt: slsqp takes time in proportion to the cube of the unknowns, and {} are "
                                   "more than {}; use algorithm: lbfgs", unknowns, most_dense));
  }

  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) override {
    return minimize_in_rounds(problem, judge_, max_iterations_, q,
                              [this](GuardedProblem& guarded) { round(guarded); });
  }

 private:
  static constexpr int most_dense = 600;      // unknowns: half a second per iteration
  static constexpr int longest_round = 1000;  // evaluations per round, before rescaling

  void round(GuardedProblem& guarded) const {
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> opt(nlopt_create(algorithm_, guarded.size()),
                                                                nlopt_destroy);
    if (!opt) throw std::bad_alloc();
    Callback callback{guarded, opt.get()};
    nlopt_set_min_objective(opt.get(), guarded_value, &callback);
    nlopt_set_maxeval(opt.get(), longest_round);
    nlopt_set_vector_storage(opt.get(), memory_);
    VecX z = VecX::Zero(guarded.size());
    double f = 0;
    // Its status is ignored: the accepted points are the result.
    nlopt_optimize(opt.get(), z.data(), &f);
  }

  nlopt_algorithm algorithm_ = NLOPT_LD_LBFGS;
  int memory_ = 20;
  ConvergenceJudge judge_;
};

TACK_REGISTER(Minimizer, Nlopt, "nlopt",
              "Gradient methods of NLopt, preconditioned by the Hessian's diagonal: hundreds of cheap iterations if "
              "contact is stiff, too many under prescribed motion. slsqp takes at most 600 unknowns; mma and ccsaq, "
              "of first order, seldom reach a tight tolerance.",
              "Johnson, The NLopt nonlinear-optimization package 2.7");

}  // namespace tack
