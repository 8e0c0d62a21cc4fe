// The potential of bonds, P = sum_k w_k phi(d_k, |u_k|^2; m_k, h) (bond.hpp, bond_law.hpp), with
//     gradient by x_i:       w B_i^T f,    f = phi_d n + 2 phi_s u,
//     Hessian block (i, j):  w B_i^T H B_j,
//     B_i = c_i I + v_i n_S^T  for a vertex i of the side S,
//     H = phi_dd n n^T + 2 phi_ds (n u^T + u n^T) + 4 phi_ss u u^T + 2 phi_s (I - n n^T),
// which is projected in closed form: 2x2 in the plane of n and u, and 2 phi_s across it. The levers
// of each side S add terms with the factor l_S (f . n_S) to the Hessian. Bonds with d < 0 push
// (bond_law.hpp), beside the barrier. Friction counts the pressure of the barrier alone.
// One term covers both directions, as both change the same history variables.
// Bonds are history variables: a step begins with the stored bonds and the new ones that its start
// allows. When the step is accepted, its bonds are stored.
#pragma once

#include <set>

#include "framework/bond/bond_list.hpp"
#include "framework/bond/environment.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/core/force_point.hpp"
#include "framework/core/records.hpp"
#include "framework/core/term.hpp"

namespace tack {

/// Potential of all bonds of a world.
class BondTerm : public Term, public ForcePoints {
 public:
  // The system must outlive the term, and begin steps before it.
  BondTerm(ContactSystem& system, BondTable table);
  /// Sets what laws that depend on the state of their site read: the temperature, which must
  /// outlive the term (null: room temperature), and the names of the objects.
  void set_environment(const Environment* environment, std::vector<std::string> object_names);

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  bool lags() const override { return true; }  // frames, and at the start of a step the bonds
  void lag(const VecX& x) override;
  void commit(const VecX& x, History& history) const override;

  /// Returns the stored energy if no step is open.
  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override;
  bool dynamic() const override { return true; }
  bool lagged_stencils() const override { return true; }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  std::vector<double> abrupt_times() const override;
  void mark_debonding(const VecX& from, const VecX& to, std::vector<char>& marks) const override;

  /// Sets the contact pressure at each bond of the list in this step [Pa], for steppers that know
  /// it; otherwise the barrier gives it.
  void set_pressures(std::vector<double> pressures) { pressures_ = std::move(pressures); }

  // Energies of the step to x [J]: dissipation by debonding; energy that healing takes from the
  // bonds (below zero: puts in); energy that the environment puts in.
  struct Changes {
    double dissipated = 0, healed = 0;
    double environment = 0;  // what time and temperature have added to the stored energy
  };
  Changes changes(const VecX& x) const;
  /// Calls `visit` for each bond with its dissipation and healing.
  void visit_changes(const VecX& x, const EnergyVisitor& visit) const;
  bool visit_energies(const VecX& x, const EnergyVisitor& visit) const override;
  void publish(Records& records) const override;

  /// Returns the force of each bond of the list on its site [N]. The opposite force acts on the
  /// attachment point. Compressive forces belong to the barrier, all others to adhesion.
  std::vector<Vec3> site_forces(const VecX& x, LawTerm term = LawTerm::all) const;
  /// Returns the bond forces on every vertex (3n) [N]; with a pair, of its bonds only.
  VecX forces(const VecX& x, LawTerm term, std::optional<ObjectPair> only = std::nullopt) const;
  /// Visits the bonds of the list: site, attachment point and force (bond_fields.cpp).
  void visit_points(const VecX& x, std::string_view summand,
                    const ForcePointVisitor& visit) const override;
  /// Returns forces like ContactTerm::compressions; below zero where bonds pull.
  VecX compressions(const VecX& x, LawTerm term) const;
  /// Returns the force of object b on object a [N].
  Vec3 force_between(const VecX& x, LawTerm term, ObjectPair pair) const;

  const BondList& list() const { return list_; }
  /// Returns the opening of each bond of the list.
  std::vector<Opening> openings(const VecX& x) const;
  /// Rules that should have made bonds at the start of the run, but made none in its first step.
  const std::vector<int>& unbonded() const { return unbonded_; }
  const BondTable& table() const { return table_; }
  const BondLaw& law_of(int bond) const { return *table_.rules()[list_.bonds()[bond].rule].law; }
  /// Returns the site of a bond of the list in the present step; null if its law does not depend on
  /// it.
  const SiteState* site(int bond) const {
    return sites_.empty() || !law_of(bond).sees_site() ? nullptr : &sites_[bond];
  }
  double intensity(int bond) const { return law_of(bond).intensity_of(list_.variables(bond)); }

 private:
  // A site of bonds: triangle of the contact surface, or -1 and the vertex, and the other object.
  using SiteKey = std::array<int, 3>;
  static SiteKey key_of(int triangle, int vertex, int object) {
    return {triangle, triangle < 0 ? vertex : -1, object};
  }
  bool may_form(const Bond& bond, const VecX& x) const;
  void read_bonded_once(const History& history);
  void write_bonded_once(History& history) const;
  // A few bonds of one rule with equal numbers of vertices.
  struct Block {
    int first, last;
  };
  static constexpr int most_in_block = 32;
  void make_blocks();
  void lag_frames(const VecX& x) const;
  void ensure_frames(const VecX& x) const;
  void make_bonds(const VecX& x);
  BondState state_of(int bond, const VecX& x) const;
  // Returns the effect of the step to x on a bond, and writes its history variables at the end of
  // the step into `variables`.
  BondChange advance(int bond, const VecX& x, std::vector<double>& variables) const;
  bool slid_off(const Bond& bond, const VecX& x) const;
  void find_sites(const VecX& x) const;
  void set_tangents(const Bond& bond, const VecX& x, SiteState& site) const;
  bool directed(const Block& block) const { return directs_ && law_of(block.first).directed(); }
  Vec3 jump_of(int bond, const Opening& o) const;  // opening and components of the slip
  DirectedSample directed_sample(int bond, const Opening& o) const;
  char directed_marks(int bond, const VecX& from, const VecX& to) const;
  SiteState site_at(const Bond& bond, double time, const VecX& x) const;
  void find_environment_work(const VecX& x);
  BondStepStates step_of(int first) const { return {h_, site(first)}; }

  ContactSystem& system_;
  BondTable table_;
  mutable BondList list_;  // frames are taken when they are first needed
  mutable bool framed_ = false;
  BondList stored_;
  std::set<SiteKey> bonded_once_;  // sites that have bonded, of rules that let a site bond once
  bool once_ = false;              // some rule lets a site bond once
  bool begun_ = false;             // the run has: bonds of the start are made
  bool begins_ = false;            // a step
  double h_ = 0;                   // 0 between steps
  bool sees_sites_ = false;        // some law does
  bool directs_ = false;           // some law is directed
  const Environment* environment_ = nullptr;
  std::vector<std::string> object_names_;
  double start_time_ = 0, end_time_ = 0;  // of the present step, or of the last one [s]
  mutable double state_time_ = 0;         // s
  mutable std::vector<SiteState> sites_;  // per bond; empty if no law sees them
  std::vector<double> environment_work_;  // per bond, of the present step [J]
  std::vector<int> unbonded_;
  std::vector<double> pressures_;  // empty: those of the barrier
  std::vector<Block> blocks_;
  std::array<std::vector<int>, 2> batch_vertices_;  // of bonds of 4 vertices, and of 6
};

}  // namespace tack
