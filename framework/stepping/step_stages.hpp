// The stages of a time step: open, solve, validate, commit. The time loop (time_stepper.hpp) runs
// them and decides what is accepted; studies of single steps call them one by one.
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
  // Returns the energy flows of the committed step, which ended with these energies.
  EnergyFlows close_account(const EnergyBalance::Energies& energies, double h) {
    return balance_.close(state_, energies, h, fixed_.may_move(), *potential_);
  }
  bool uses_fallback_integrator() const { return integrator_ != time_.integrator.get(); }

  World& world_;
  const TimeConfig& time_;
  Minimizer& solver_;
  PhaseClock& clock_;
  State state_;
  EnergyBalance balance_;
  // The scene's integrator, or its fallback while a step is repeated.
  const TimeIntegrator* integrator_;
  Accelerations accelerations_;
  std::optional<LaggedImpulses> impulses_;  // if friction lags by a step
  std::optional<StepPotential> potential_;
  int unknowns_ = 0;  // number of changes of the unknowns

 private:
  void begin_without_history();
  void begin_records();
  void fix_vertices(double h);
  void lag_impulses(Step& step);
  bool velocities_matter() const;
  void update_fixed_directions(const VecX& x, double h, VecX& v, VecX& a) const;

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
