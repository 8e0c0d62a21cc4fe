// Time loop: opens a step, has it solved and validated (stepper.hpp), and accepts or rejects it.
//
// Step cutback: if a solve fails, or its result is rejected, the state is left unchanged, h is
// halved, and substeps run until the end of the step is reached.
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

// A solved step before it is accepted. All participants are still in the state of the step.
struct SolvedStep {
  const State& start;
  double h;  // s
  const TimeIntegrator& integrator;
  bool damped;  // true if `integrator` is the fallback of the scene's integrator
  const SolveResult& result;
  StepPotential& potential;
  int unknowns;  // number of changes of the unknowns so far
};

class TimeStepper {
 public:
  // Continues from world.start with a stepper of its own. `warn` receives failed solves and other
  // warnings.
  TimeStepper(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver,
              PhaseClock& clock, WarningFunction warn);

  // Advances by one accepted step. Throws SimulationError if the smallest step fails too.
  StepReport advance();
  // Sets further times at which adaptive steps end: next(t) is the first one after t [s].
  void stop_at(std::function<double(double t)> next) {
    if (control_) control_->stop_at(std::move(next));
  }
  bool finished() const;
  bool interrupted() const { return interrupted_; }
  const State& state() const { return state_; }
  // Returns the size that advance() tries first [s].
  double next_step_size() const;

  // The stages of advance(), for studies of single steps.
  // Opens a step from the present time to h later. It is valid until another one is opened or this
  // one is committed.
  Step open(double h);
  // Opens and solves a step. guess: its start (3n), feasible and with prescribed vertices at their
  // target positions; null: the stepper's own.
  SolveResult solve(double h, const VecX* guess = nullptr);
  // Returns the reason to reject a result, or "".
  std::string fault(const SolveResult& result);
  void commit(const VecX& x, double h);
  // Returns the incremental potential of the latest step over beta h^2, at x (3n) [J].
  double potential_at(const VecX& x);
  void observe(StepObservers observers) { stepper_->observe(std::move(observers)); }
  // Receives each solved step before it is accepted. Some of them are undone afterwards and
  // repeated.
  using SolvedObserver = std::function<void(const SolvedStep&)>;
  void observe_solved(SolvedObserver solved) { solved_ = std::move(solved); }

  // For studies of steps that were solved elsewhere (framework/sensitivity): open(), then
  // commit_solution() instead of commit().
  void use_fallback_integrator(bool fallback) {
    integrator_ = fallback ? time_.integrator->fallback() : time_.integrator.get();
  }
  // Returns the names of the groups of EnergyFlows::groups, known once a step has begun.
  const std::vector<std::string>& energy_groups() const { return balance_.group_names(); }
  // Switches the energy account on or off.
  void keep_account(bool kept) { accounts_ = kept; }
  // Commits the solution x of an open step with its energy account. All participants must be at x.
  void commit_solution(const VecX& x, double h);
  // Replaces the state by one with equal time and fixed vertices.
  void set_state(State state);

 private:
  Validation validate(const SolveResult& result);
  void check_wall_limit(const std::string& fault) const;
  void begin_without_history();
  void fix_vertices(double h);
  void begin_records();
  void set_accelerations(double t, const std::vector<int>& vertices);
  void lag_impulses(Step& step);
  bool velocities_matter() const;
  VecX accelerations_by(const VecX& force) const;
  VecX dynamic_accelerations(const VecX& x) const;
  void update_fixed_directions(const VecX& x, double h, VecX& v, VecX& a) const;
  StepReport report(const SolveResult& result, double h) const;
  double smallest_refined() const;
  bool resolves_impact(double h) const;
  void request_refinement(double h, bool lasting);
  bool rejects_error(const SolveResult& result, double h);
  double whole_step() const;
  bool accept(const SolveResult& result, double h, StepReport& report);
  void warn_of(const SolveResult& result, const StepReport& report);
  void warn_of_unbonded();
  void warn_of_joints();
  double smallest_size() const;
  bool tolerates(double h, const Validation& validation) const;
  void reject(double h, const Validation& validation);

  World& world_;
  const SceneConfig& scene_;
  const TimeConfig& time_;
  Minimizer& solver_;
  PhaseClock& clock_;
  WarningFunction warn_;
  State state_;
  FixedVertices fixed_;
  EnergyBalance balance_;
  // The scene's integrator, or its fallback while a step is repeated.
  const TimeIntegrator* integrator_;
  std::optional<LaggedImpulses> impulses_;  // if friction lags by a step
  bool warned_of_strain_ = false;
  std::optional<StepPotential> potential_;
  std::vector<const Term*> dynamic_terms_;  // empty if the integrator does not use their forces
  std::unique_ptr<Stepper> stepper_;
  std::optional<StepControl> control_;  // in adaptive steps
  // Numbers of failed solves and of solves with too large errors in the present step.
  int cutbacks_ = 0, repeats_ = 0;
  double first_size_ = 0;  // first step size tried, before any cutback [s]
  double error_ = 0;       // error of the last solve, in adaptive steps [m]
  // Found in the solves of the present step.
  struct ValidationCounts {
    int intersections = 0, inverted_tets = 0;
  } counts_;
  bool interrupted_ = false;
  bool refined_ = false;  // the present steps are shorter, to conserve energy
  bool accounts_ = true;
  int unknowns_ = 0;  // number of changes of the unknowns
  SolvedObserver solved_;
};

}  // namespace tack
