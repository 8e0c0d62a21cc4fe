// A time step with contact constraints: linearisation (linearized_step.hpp), rows of contacts with
// friction and of bonds (contact_rows.hpp), projected Gauss-Seidel (gauss_seidel.hpp). A contact
// gets rows once it is violated. The end of the step is searched for contacts that were met during
// the step (impact_rows.hpp).
#pragma once

#include <optional>

#include "solvers/lcp/contact_rows.hpp"
#include "solvers/lcp/gauss_seidel.hpp"
#include "solvers/lcp/impact_rows.hpp"

namespace tack {

struct LcpSettings {
  double margin = 0;     // gap that surfaces keep [m]
  double tolerance = 0;  // limit of the change of a velocity in the last sweep [m/s]
  int sweeps = 0;        // limit per step
  int dense_rows = 0;    // limit of the rows of a dense block
  double recovery = 0;   // fraction of a missing gap that is restored per step
};

class LcpStep {
 public:
  LcpStep(World& world, PhaseClock& clock, LinearSolver& solver, const LcpSettings& settings);

  void new_unknowns() { linear_.new_unknowns(); }
  // Solves the step; the end configuration is attempt.x.
  void solve(const Step& step, SolveResult& result);

  // Results of the last step: contacts with forces, the history for the next step, and the greatest
  // depth of a point behind its side at the end [m].
  const std::vector<ContactRow>& contacts() const { return contacts_.rows; }
  const StoredContacts& stored() const { return stored_; }
  double deepest() const { return deepest_; }
  int rows() const { return rows_.count(); }
  int sweeps() const { return sweeps_ ? sweeps_->sweeps() : 0; }
  double residual() const { return residual_; }  // m/s
  double slid() const { return slid_; }          // dissipation by friction: force times slip [J]

 private:
  // Returns the distance that a contact may still close [m]. Negative: the distance to restore in
  // this step.
  double gap_excess(const ContactRow& contact) const;
  void add_contact(int contact, const VecX& displacement);
  void add_bonds(const VecX& x, const VecX& end);
  int add_violated(const VecX& displacement, double tolerated, bool first);
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
  StoredContacts stored_;
  std::vector<char> taken_;  // per contact: it has rows
  bool met_ = false;         // contacts met during the step have been added
  VecX free_;                // displacements without impulses (3n) [m]
  Rows rows_;
  std::optional<GaussSeidel> sweeps_;
  double residual_ = 0, slid_ = 0, deepest_ = 0;
};

}  // namespace tack
