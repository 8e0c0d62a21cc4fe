// The time loop: open a step, have it solved (stepper.hpp), commit or roll back.
// A step whose solve fails, or whose result the stepper refuses, leaves no trace: the state
// is untouched, h is halved, and the halves run until the step's end is reached.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/stepping/energy_balance.hpp"
#include "framework/stepping/fixed_vertices.hpp"
#include "framework/stepping/lagged_impulses.hpp"
#include "framework/stepping/step_control.hpp"
#include "framework/stepping/step_report.hpp"
#include "framework/stepping/stepper.hpp"
#include "framework/stepping/time_config.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

struct SceneConfig;

// A solved step that is about to be kept; all participants are still in the state of the step.
struct SolvedStep {
  const State& start;
  double h;  // s
  const TimeIntegrator& integrator;
  bool damped;  // whether that is the fallback of the scene's
  const Attempt& attempt;
  StepPotential& potential;
  int unknowns;  // number of changes of the unknowns so far
};

class TimeStepper {
 public:
  // Continues from world.start with its own stepper. `warn` receives failed solves and other
  // warnings.
  TimeStepper(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver,
              PhaseClock& clock, WarningFunction warn);

  // Advances by one accepted step. Throws SimulationError when no step small enough succeeds.
  StepReport advance();
  // Sets further times at which adaptive steps end: next(t) is the first one after t [s].
  void stop_at(std::function<double(double t)> next) {
    if (control_) control_->stop_at(std::move(next));
  }
  bool finished() const;
  bool interrupted() const { return interrupted_; }
  const State& state() const { return state_; }
  double next_step_size() const;  // the size that advance() tries first [s]

  // The stages of advance(), for studies of single steps. Begins the step from now to now + h,
  // valid until another one is opened or this one committed.
  Step open(double h);
  // Opens and solves a step. guess: its start (3n), feasible and with prescribed vertices at their
  // target positions.
  Attempt solve(double h, const VecX* guess = nullptr);
  std::string verdict(const Attempt& attempt);  // "" if the attempt may be kept
  void commit(const VecX& x, double h);
  // Returns the incremental potential of the latest step over beta h^2, at x (3n) [J].
  double potential_at(const VecX& x);
  void observe(StepObservers observers) { stepper_->observe(std::move(observers)); }
  // Receives each step before it is kept. Some are undone after that, and repeated.
  using SolvedObserver = std::function<void(const SolvedStep&)>;
  void observe_solved(SolvedObserver solved) { solved_ = std::move(solved); }

  // For studies of steps that were solved elsewhere (framework/sensitivity): open(), then follow()
  // instead of commit().
  void damp(bool damped) {
    integrator_ = damped ? time_.integrator->fallback() : time_.integrator.get();
  }
  // Returns the names of the groups of EnergyFlows::groups, known once a step has begun.
  const std::vector<std::string>& energy_groups() const { return balance_.group_names(); }
  void keep_account(bool kept) { accounts_ = kept; }  // energy account
  void follow(const VecX& x, double h);  // all participants must be at x
  void set_state(State state);           // another state with equal time and holds

 private:
  Verdict judge(const Attempt& attempt);
  void check_wall_limit(const std::string& wrong) const;
  void begin_anew();
  void hold(double h);
  void begin_records();
  void set_accelerations(double t, const std::vector<int>& vertices);
  void lag_impulses(Step& step);
  bool velocities_matter() const;
  VecX accelerations_by(const VecX& force) const;
  VecX dynamic_accelerations(const VecX& x) const;
  void update_held_directions(const VecX& x, double h, VecX& v, VecX& a) const;
  StepReport report(const Attempt& attempt, double h) const;
  double smallest_refined() const;
  bool resolves_impact(double h) const;
  void refine(double h, bool lasting);
  bool off_by_too_much(const Attempt& attempt, double h);
  double whole_step() const;
  bool keep(const Attempt& attempt, double h, StepReport& report);
  void warn_of(const Attempt& attempt, const StepReport& report);
  void warn_of_unbonded();
  void warn_of_joints();
  double smallest_tried() const;
  bool tolerates(double h, const Verdict& verdict) const;
  void halve(double h, const Verdict& verdict);

  World& world_;
  const SceneConfig& scene_;
  const TimeConfig& time_;
  Minimizer& solver_;
  PhaseClock& clock_;
  WarningFunction warn_;
  State state_;
  FixedVertices held_;
  EnergyBalance balance_;
  const TimeIntegrator* integrator_;  // the scene's, or its fallback while a step is repeated
  std::optional<LaggedImpulses> impulses_;  // of friction; none if it does not lag by a step
  bool told_of_strain_ = false;
  std::optional<StepPotential> potential_;
  std::vector<const Term*> dynamic_terms_;  // empty if the integrator does not follow their forces
  std::unique_ptr<Stepper> stepper_;
  std::optional<StepControl> control_;  // if steps adapt
  int halvings_ = 0, repeats_ = 0;      // of the present step: failed solves, too large errors
  double begun_ = 0;                    // s: size to be tried first, before any halving
  double error_ = 0;                    // m: of the latest attempt, if steps adapt
  struct Found {
    int intersections = 0, inverted_tets = 0;
  } found_;  // by the stepper, in the solves of the present step
  bool interrupted_ = false;
  bool refined_ = false;  // the present steps are short to conserve energy
  bool accounts_ = true;
  int unknowns_ = 0;  // number of changes of the unknowns
  SolvedObserver solved_;
};

}  // namespace tack
