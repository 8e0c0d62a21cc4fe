// Energy balance (energy_balance.hpp) of each group of bodies that do not interact with the others.
// In the sum over a scene, a heavy body that bounces would hide the losses of a small one. Groups
// are the meeting groups of the world, joined where
//   - a body that a motion moves may touch, or is attached to, several of them: its work is theirs,
//   - a term has stencils of several of them, and does not tell their energies apart
//     (Term::visit_energies, FlowRecord::visit_energies).
// Losses by contact areas and by the integrator are one sum here. A group whose contact has ended
// in another group has no account of its own from then on.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "framework/stepping/energy_flows.hpp"
#include "framework/world/world.hpp"

namespace tack {

class GroupBalance {
 public:
  // velocity_tolerance: of the solver [m/s].
  GroupBalance(const World& world, double velocity_tolerance)
      : world_(world), tolerance_(velocity_tolerance) {}

  // Names of the groups by their first bodies; empty: all bodies are one group, nothing is counted.
  const std::vector<std::string>& names() const { return names_; }

  // Returns whether begin() evaluates contact, which has to be at the state.
  bool needs_contact(const State& state) const;
  // Starts a step from `state`. Finds the groups at the first call.
  void begin(const State& state);
  // Ends the step at x; the terms must still be in the state of the step.
  void end(const VecX& x);
  // Adds work on a vertex [J]: of loads; and of the motion that moves it, with the mean of the
  // forces and with those at the end of the step.
  void add_load_work(int vertex, double work);
  void add_prescribed_work(int vertex, double work, double at_end);
  // Keeps the step to `state` of size h: sets the accounts in `state`.
  std::vector<GroupFlow> close(State& state, double h);

 private:
  struct Step {
    double work = 0, prescribed = 0, prescribed_at_end = 0, dissipated = 0;  // J
  };

  void find(const VecX& x);
  int group_of(std::span<const int> vertices) const;
  std::vector<GroupAccount> accounts_at(const State& state) const;
  void add_stored(const VecX& x, std::vector<GroupAccount>& accounts) const;

  const World& world_;
  const double tolerance_;
  bool found_ = false;
  std::vector<std::string> names_;
  std::vector<int> group_;  // per vertex; -1: of a fixed body that nothing moves
  std::vector<GroupAccount> start_;
  std::vector<Step> step_;
  mutable std::vector<char> met_another_;
};

// Returns the kinetic energies of the motion of a body as a whole at the start and the end of a
// step of size h, if nothing but gravity acts on it: no vertex is fixed, and its mean velocity
// changes by g h to within `tolerance` [m/s]. Zeros otherwise.
std::array<double, 2> ballistic_energies(const World& world, int body, const State& state,
                                         double h, double tolerance);

}  // namespace tack
