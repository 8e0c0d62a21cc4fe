// The minimisation of a step, for a minimiser in Python.
#pragma once

#include <memory>
#include <optional>

#include "framework/core/minimizer.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"
#include "python/bindings/arrays.hpp"
#include "solvers/minimizers/convergence_judge.hpp"

namespace tack::python {

// Valid during its step; afterwards every call throws RuntimeError.
class Problem {
 public:
  // start: feasible unknowns at which the minimisation begins (3m). The objective is an
  // IncrementalPotential of the world, which must outlive the step.
  Problem(MinimizerProblem problem, const World& world, VecX start)
      : problem_(std::move(problem)), world_(world), start_(std::move(start)) {
    judge_.begin();
  }

  void end() { problem_.reset(); }
  // Clears stored results, because the state shared with the simulation has moved.
  void leave() { q_.resize(0), judged_.reset(), feasible_.reset(); }

  int size();
  py::array start() const { return copy(start_, 0); }
  double value(const Numbers& q);
  py::array gradient(const Numbers& q);
  py::object hessian(const Numbers& q, const std::string& projection);
  // Returns a dictionary per part: name, value, gradient, dynamic, stores.
  py::list parts(const Numbers& q);
  // Returns a dictionary per pair: kind, first, second, weights_first, weights_second, gap,
  // distance, normal, objects.
  py::list pairs(const Numbers& q, double reach);
  double feasible_step(const Numbers& q, const Numbers& p);
  double stopping_norm(const Numbers& p, const Numbers& gradient);
  // Returns a dictionary per cut: kind, step, vertices, blocks, bodies.
  py::list cuts(const Numbers& q, const Numbers& p, double below);
  py::array block_bounds(const Numbers& q, const Numbers& p, const std::string& kind);
  // Returns true if projected Newton would end at q.
  bool converged(const Numbers& q);

  MinimizerResult& work() { return work_; }
  // Names what intersects or is inverted at q; "" if nothing does.
  std::string fault_at(const Numbers& q);
  // Names the convergence criterion that q, which is not converged, fails; stopping: of the
  // minimiser.
  std::string unmet_criterion(const Numbers& q, Stopping stopping);

 private:
  MinimizerProblem& there();
  Objective& at(const Numbers& q);
  bool feasible();

  std::optional<MinimizerProblem> problem_;
  const World& world_;
  VecX start_, q_;
  ConvergenceJudge judge_;
  std::optional<bool> judged_;    // at q_; stored because the judge answers only once
  std::optional<bool> feasible_;  // at q_
  MinimizerResult work_;
};

// Returns a minimiser of steps of `world` that calls a Python function: q = function(problem),
// feasible as the start is. Tolerances are those of `like`.
std::unique_ptr<Minimizer> minimizer_of(py::function function, const Minimizer& like,
                                        const World& world);

// Throws the exception of Python that is nested in `error`, with the text of `error` as its note,
// if there is one.
void rethrow_python(const SimulationError& error);

void bind_problem(py::module_& module);

}  // namespace tack::python
