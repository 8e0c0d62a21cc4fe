// A step with constraints: linearised (linearized_step.hpp), contact with friction and bonds as
// rows (contact_rows.hpp), projected Gauss-Seidel (gauss_seidel.hpp). Contacts have rows once they
// are violated. The end of the step is searched for contacts that were met on linear trajectories
// (impact_rows.hpp).
#pragma once

#include <optional>

#include "solvers/lcp/contact_rows.hpp"
#include "solvers/lcp/gauss_seidel.hpp"
#include "solvers/lcp/impact_rows.hpp"

namespace tack {

struct LcpSettings {
  double margin = 0;      // gap that surfaces keep [m]
  double tolerance = 0;   // largest change of a velocity in the last sweep [m/s]
  int sweeps = 0;         // most sweeps of a step
  int dense_rows = 0;     // rows of a dense block
  double recovery = 0;    // fraction of a violation that a step corrects
};

class LcpStep {
 public:
  LcpStep(World& world, PhaseClock& clock, LinearSolver& solver, const LcpSettings& settings);

  void new_unknowns() { linear_.new_unknowns(); }
  // Leaves where it ends in attempt.x.
  void solve(const Step& step, Attempt& attempt);

  // The step that was solved last: its contacts with their forces, what the next one is to know,
  // and how deep anything is at the end behind what it was in front of [m].
  const std::vector<ContactRow>& contacts() const { return contacts_.rows; }
  const HeldContacts& held() const { return held_; }
  double deepest() const { return deepest_; }
  int rows() const { return rows_.count(); }
  int sweeps() const { return sweeps_ ? sweeps_->sweeps() : 0; }
  double residual() const { return residual_; }  // m/s
  double slid() const { return slid_; }          // what friction dissipated: force times slip [J]

 private:
  // By how much a contact may still close, or, if below zero, what of its gap is to be taken back
  // in the step [m].
  double room(const ContactRow& contact) const;
  void add_contact(int contact, const VecX& way);
  void add_bonds(const VecX& x, const VecX& end);
  int add_violated(const VecX& way, double tolerated, bool first);
  int add_impacts(const VecX& x, const VecX& end);
  void take_forces();
  void look_back(const VecX& x, const VecX& end);
  VecX end() const;

  World& world_;
  PhaseClock& clock_;
  LcpSettings settings_;
  LinearizedStep linear_;
  std::optional<ContactFinder> finder_;
  std::optional<ImpactFinder> impacts_;
  ContactRows contacts_;
  HeldContacts held_;
  std::vector<char> taken_;  // per contact: it has rows
  bool met_ = false;         // what the end meets on the way to it is among them
  VecX free_;                // 3n: the way without impulses [m]
  Rows rows_;
  std::optional<GaussSeidel> sweeps_;
  double residual_ = 0, slid_ = 0, deepest_ = 0;
};

}  // namespace tack
