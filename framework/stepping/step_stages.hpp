// The parts of a time step: open, solve, validate, commit. The time loop (time_stepper.hpp) runs
// them and decides what is accepted; studies of single steps call them one by one.
//
// With an integrator of several stages (time_integrator.hpp) they concern the next stage of a step
// of size h. All stages but the last are committed to the state; restore_step_start() undoes them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/stepping/accelerations.hpp"
#include "framework/stepping/energy_balance.hpp"
#include "framework/stepping/fixed_vertices.hpp"
#include "framework/stepping/lagged_impulses.hpp"
#include "framework/stepping/stepper.hpp"
#include "framework/stepping/time_config.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

struct SceneConfig;

class StepStages {
 public:
  // Continues from world.start with a stepper of its own.
  StepStages(World& world, const SceneConfig& scene, const TimeConfig& time, Minimizer& solver,
             PhaseClock& clock);

  const State& state() const { return state_; }

  // Opens a step from the present time to h later. It is valid until another one is opened or this
  // one is committed.
  Step open(double h);
  // Opens and solves a step. guess: its start (3n), feasible and with prescribed vertices at their
  // target positions; null: the stepper's own.
  SolveResult solve(double h, const VecX* guess = nullptr);
  Validation validate(const SolveResult& result) { return stepper_->validate(result); }
  void commit(const VecX& x, double h);
  // Returns the incremental potential of the latest step over beta h^2, at x (3n) [J].
  double potential_at(const VecX& x);
  void observe(StepObservers observers) { stepper_->observe(std::move(observers)); }

  // For studies of steps that were solved elsewhere (framework/sensitivity): open(), then
  // commit_solution() instead of commit().
  void use_fallback_integrator(bool fallback) {
    integrator_ = fallback ? time_.integrator->fallback() : time_.integrator.get();
    stage_ends_ = integrator_->stages();
  }
  // Returns the names of the groups of EnergyFlows::groups, known once a step has begun.
  const std::vector<std::string>& energy_groups() const { return balance_.group_names(); }
  // Switches the energy account on or off.
  void keep_account(bool kept) { accounts_ = kept; }
  // Commits the solution x of an open step with its energy account. All participants must be at x.
  void commit_solution(const VecX& x, double h);
  // Replaces the state by one with equal time and fixed vertices.
  void set_state(State state);

 protected:
  // Returns the energy flows of the committed stage, which ended with these energies.
  EnergyFlows close_account(const EnergyBalance::Energies& energies) {
    const double h = state_.h_before;
    return balance_.close(state_, energies, h, stepper_->load_times(state_, h), fixed_.may_move(),
                          *potential_);
  }
  // Returns the next stage of a step of size h.
  StepStage stage(double h) const;
  bool at_last_stage() const { return solved_stages_.size() + 1 == stage_ends_.size(); }
  // Returns the state at the start of the step.
  const State& step_start() const { return step_start_ ? *step_start_ : state_; }
  // Commits a stage that is not the last one of its step. Its energy flows are kept for the step.
  void commit_stage(const VecX& x, double h);
  // Returns the energy flows of the step, given those of its last stage.
  EnergyFlows with_stages(EnergyFlows last);
  // Undoes the committed stages of the step; the state of the step size controller stays.
  void restore_step_start();
  bool uses_fallback_integrator() const { return integrator_ != time_.integrator.get(); }

  World& world_;
  const TimeConfig& time_;
  Minimizer& solver_;
  PhaseClock& clock_;
  State state_;
  EnergyBalance balance_;
  // The scene's integrator, or its fallback while a step is repeated.
  const TimeIntegrator* integrator_;
  std::vector<double> stage_ends_;  // TimeIntegrator::stages()
  Accelerations accelerations_;
  std::optional<LaggedImpulses> impulses_;  // if friction lags by a step
  std::optional<StepPotential> potential_;
  int unknowns_ = 0;  // number of changes of the unknowns

 private:
  void begin_without_history();
  void begin_records();
  void fix_vertices(double h);
  void lag_impulses(Step& step, const StepStage& stage);
  double stage_end() const { return stage_ends_[solved_stages_.size()]; }
  bool velocities_matter() const;
  void update_fixed_directions(const StepStage& stage, const VecX& x, VecX& v, VecX& a) const;

  // Once a stage but the last was committed: the state at the start of the step, the ends of its
  // stages, and their energy flows.
  std::optional<State> step_start_;
  std::vector<StageEnd> solved_stages_;
  std::optional<EnergyFlows> stage_flows_;

  FixedVertices fixed_;
  std::unique_ptr<Stepper> stepper_;
  bool accounts_ = true;
};

// Suspends the wall time limit during its lifetime: a step is begun and accepted as a whole.
class DeadlineSuspension {
 public:
  DeadlineSuspension(PhaseClock& clock, const TimeConfig& time) : clock_(clock), time_(time) {
    clock_.deadline().limit_run(clock_.begun(), std::nullopt);
  }
  ~DeadlineSuspension() { clock_.deadline().limit_run(clock_.begun(), time_.wall_limit); }
  DeadlineSuspension(const DeadlineSuspension&) = delete;
  DeadlineSuspension& operator=(const DeadlineSuspension&) = delete;

 private:
  PhaseClock& clock_;
  const TimeConfig& time_;
};

}  // namespace tack
