// A scene that has a little more of one number, stepped beside a run: its steps are not solved but found from those of the run, by
//     x' = x - H^-1 (g'(x') - g(x)),
// g and g' the gradients of the incremental potentials of both, H the Hessian of the run's at its end x. What x leaves of a gradient
// counts in both and cancels. So x' - x over the difference of the number is the derivative of x by it, with all that depends on where the
// step began: areas, friction, what is remembered, velocities. Everything else of the step is done as in any run.
#pragma once

#include <memory>

#include "framework/experiment/built_experiment.hpp"
#include "framework/output/gradient_config.hpp"
#include "framework/sensitivity/tangent_system.hpp"

namespace tack {

class Neighbour {
 public:
  // Of an experiment that is built. Throws InputError, with the place, for a number that it cannot have more or less of: there is none, or
  // another one would make other meshes or unknowns.
  Neighbour(const BuiltExperiment& run, const GradientConfig& config);

  double difference() const { return difference_; }  // in the number [SI]
  // Its probes at the run's state, as the run's were sampled there; over the difference: their derivatives.
  std::vector<double> derivatives(const std::vector<double>& of_run);

  void start();
  // A step of the run is solved, and may be undone. gradient: of its potential, where it ends.
  void solve(const SolvedStep& step, const VecX& gradient, TangentSystem& system);
  // It was kept, and this is where it ended.
  void keep(const State& state);

  // Between steps: all that it has to go on from there beside a state of the run, by names of its own; and to go on from there.
  void store(History& history) const;
  void start_from(const State& run, const History& history);

  int unsettled() const { return unsettled_; }  // steps whose end was not found to the accuracy that is wanted
  int jumps() const { return jumps_; }          // entries of what is remembered that were taken from the run
  const std::string& name() const { return name_; }

 private:
  void begin();
  void guess(Eigen::Index unknowns, bool loose);
  bool settle(const Step& own, const Attempt::Solved& run, TangentSystem& system);

  std::string name_;
  double difference_ = 0;
  std::unique_ptr<BuiltExperiment> built_;
  std::unique_ptr<Minimizer> solver_;
  std::optional<TimeStepper> stepper_;
  std::optional<ProbeSet> probes_;
  bool accounts_ = false;
  // In the unknowns: from where the run's step ends to where this one's does, in the present step and the last three that were kept.
  VecX way_, last_, before_, older_;
  VecX end_;           // 3n: where the present step ends here
  double rate_ = 1;    // by which corrections become smaller with the Hessian that there is
  double h_ = 0, h_last_ = 0;
  int unknowns_ = -1, unknowns_last_ = -1;
  int unsettled_ = 0, jumps_ = 0;
};

}  // namespace tack
