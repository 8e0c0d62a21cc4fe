// A perturbed scene: a scene with a small difference in one parameter, stepped beside a run. Its
// steps are not solved, but corrected from those of the run by
//     x' <- x' - H^-1 (g'(x') - g(x)),
// where g and g' are the gradients of the two incremental potentials, and H is the Hessian at the
// end x of the run's step. The residual that the solver leaves at x is in both gradients and
// cancels.
//
// (x' - x) / (difference of the parameter) is the derivative of x, including that of all initial
// data of the step: areas, friction, history variables, velocities. The rest of the step is done as
// in any run.
#pragma once

#include <memory>

#include "framework/experiment/built_experiment.hpp"
#include "framework/output/gradient_config.hpp"
#include "framework/sensitivity/tangent_system.hpp"

namespace tack {

class PerturbedScene {
 public:
  // Builds the perturbed scene of a built experiment. Throws InputError, with the source location,
  // for a parameter that cannot be changed: it does not exist, or another value changes meshes or
  // unknowns.
  PerturbedScene(const BuiltExperiment& run, const GradientConfig& config);

  double difference() const { return difference_; }  // of the parameter [SI]
  // Returns the derivatives of the probes. of_run: probe values of the run at the same state.
  std::vector<double> derivatives(const std::vector<double>& of_run);

  void start();
  // Follows a solved step of the run, which may still be rejected. gradient: of the run's potential
  // at the end of the step.
  void solve(const SolvedStep& step, const VecX& gradient, TangentSystem& system);
  // Accepts the step, which ended at `state`.
  void accept(const State& state);

  // Stores, between steps, its state beside that of the run, under names of its own; start_from()
  // continues from it.
  void store(History& history) const;
  void start_from(const State& run, const History& history);

  // Steps whose end was not found to the wanted accuracy.
  int unconverged() const { return unconverged_; }
  // History entries that were taken from the run.
  int jumps() const { return jumps_; }
  const std::string& name() const { return name_; }

 private:
  void begin();
  void extrapolate(Eigen::Index unknowns, bool nearly_singular);
  bool converge(const Step& own, const SolveResult::LaggedSolve& run, TangentSystem& system);

  std::string name_;
  double difference_ = 0;
  std::unique_ptr<BuiltExperiment> built_;
  std::unique_ptr<Minimizer> solver_;
  std::optional<StepStages> stepper_;
  std::optional<ProbeSet> probes_;
  bool needs_dissipation_ = false;
  // Displacement from the end of the run's step to the end of this one, in the unknowns: of the
  // present step and of the last three accepted ones.
  VecX displacement_, last_, before_, older_;
  VecX end_;         // 3n: end of the present step
  double rate_ = 1;  // convergence rate of the corrections with the present Hessian
  double h_ = 0, h_last_ = 0;
  int unknowns_ = -1, unknowns_last_ = -1;
  int unconverged_ = 0, jumps_ = 0;
};

}  // namespace tack
