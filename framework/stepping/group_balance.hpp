// Energy balance (energy_balance.hpp) of each group of bodies that do not interact with the others.
// In the sum over a scene, a heavy body that bounces would hide the losses of a small one. Groups
// are the meeting groups of the world. Some are joined:
//   - groups that one prescribed body may touch, or is attached to: its work belongs to all of
//     them,
//   - groups of one term that does not report the energies of its stencils (Term::visit_energies,
//     FlowRecord::visit_energies).
// Losses by contact areas and by the integrator are one sum here. A group that has been in contact
// with another group has no account of its own from then on.
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

  // Returns the names of the groups by their first bodies; empty: all bodies are one group, without
  // accounts.
  const std::vector<std::string>& names() const { return names_; }

  // Returns whether begin() evaluates contact, which then must be at the state.
  bool needs_contact(const State& state) const;
  // Begins a step from `state`. Finds the groups at the first call.
  void begin(const State& state);
  // Ends the step at x; the terms must still be in the state of the step.
  void end(const VecX& x);
  // Adds work on a vertex [J], of loads or of its prescribed motion. at_end: the work by the forces
  // at the end of the step instead of the mean forces.
  void add_load_work(int vertex, double work);
  void add_prescribed_work(int vertex, double work, double at_end);
  // Accepts the step of size h to `state`: sets the accounts in `state`, and returns the flows.
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
  std::vector<int> group_;  // per vertex; -1: of a fixed body without motion
  std::vector<GroupAccount> start_;
  std::vector<Step> step_;
  mutable std::vector<char> met_another_;
};

// Returns the kinetic energies of the motion of a body as a whole at the start and the end of a
// step of size h, if nothing but gravity acts on it: no vertex is fixed, and its mean velocity
// changes by g h to within `tolerance` [m/s]. Zeros otherwise.
std::array<double, 2> ballistic_energies(const World& world, int body, const State& state, double h,
                                         double tolerance);

}  // namespace tack
