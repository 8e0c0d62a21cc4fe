// Bonds over a step: how their history variables change, with the energy that this dissipates or
// takes, and what becomes of them when the step is accepted.
#include <algorithm>

#include "framework/bond/bond_attachment.hpp"
#include "framework/bond/bond_term.hpp"
#include "framework/contact/surface/lagged_surface.hpp"

namespace tack {

// Sets what the change of time and temperature adds to the stored energy of each bond at the start x of a step.
void BondTerm::find_environment_work(const VecX& x) {
  if (!sees_sites_) return;
  environment_work_.assign(list_.size(), 0);
  for (int i = 0; i < list_.size(); ++i) {
    if (!law_of(i).sees_site()) continue;
    const Bond& bond = list_.bonds()[i];
    const Opening o = opening_of(bond, x);
    const SiteState before = site_at(bond, start_time_, x);
    BondState at{o.d, o.s, 0, 0, sites_[i], jump_of(i, o).tail<2>()};
    environment_work_[i] = bond.area * law_of(i).stored(at, list_.variables(i));
    at.site = before;
    environment_work_[i] -= bond.area * law_of(i).stored(at, list_.variables(i));
  }
}

BondState BondTerm::state_of(int i, const VecX& x) const {
  const Bond& bond = list_.bonds()[i];
  const Opening o = opening_of(bond, x);
  const BondRule& rule = table_.rules()[bond.rule];
  double pressure = pressures_.empty() ? std::max(0.0, -rule.barrier.at(o.d + bond.rest).slope) : pressures_[i];
  if (o.d < 0) pressure -= law_of(i).directed() ? directed_sample(i, o).gradient[0] : rule.law->at(o.d, o.s, list_.variables(i), step_of(i)).by_d;
  BondState state{o.d, o.s, h_, pressure};
  if (const SiteState* site = this->site(i)) {
    state.site = *site;
    state.slip = jump_of(i, o).tail<2>();
  }
  return state;
}

BondChange BondTerm::advance(int bond, const VecX& x, std::vector<double>& variables) const {
  variables.assign(list_.variables(bond), list_.variables(bond) + law_of(bond).width());
  BondState at = state_of(bond, x);
  BondChange change = law_of(bond).advance(at, variables.data());
  if (!change.gone && slid_off(list_.bonds()[bond], x)) {
    change.gone = true;
    if (at.d > 0) at.d *= change.kept;
    at.s *= change.kept * change.kept;
    at.slip *= change.kept;
    change.dissipated += law_of(bond).stored(at, variables.data());
  }
  return change;
}

// Returns whether the site has slid off the opposite surface and no longer faces it. Slips up to the
// width of the bond's area are not examined.
bool BondTerm::slid_off(const Bond& bond, const VecX& x) const {
  if (opening_of(bond, x).s <= bond.area) return false;
  return !facing_triangle(system_.lagged_surface().topology(), system_.surface().mesh, x, bond.opposite_triangle, site_position(bond, x));
}

BondTerm::Changes BondTerm::changes(const VecX& x) const {
  Changes sum;
  std::vector<double> variables;
  for (int i = 0; i < list_.size(); ++i) {
    const double area = list_.bonds()[i].area;
    const BondChange change = advance(i, x, variables);
    sum.dissipated += area * change.dissipated;
    sum.healed += area * change.healed;
    if (!environment_work_.empty()) sum.environment += environment_work_[i];
  }
  return sum;
}

void BondTerm::visit_changes(const VecX& x, const EnergyVisitor& visit) const {
  std::vector<double> variables;
  for (int i = 0; i < list_.size(); ++i) {
    const Bond& bond = list_.bonds()[i];
    const BondChange change = advance(i, x, variables);
    visit(std::span(bond.vertices).first(bond.count()), bond.area * (change.dissipated + change.healed) - (environment_work_.empty() ? 0 : environment_work_[i]));
  }
}

void BondTerm::commit(const VecX& x, History& history) const {
  state_time_ = end_time_;
  BondList remaining = list_.none();
  std::vector<double> variables;
  for (int i = 0; i < list_.size(); ++i) {
    const BondChange change = advance(i, x, variables);
    if (change.gone) continue;
    Bond bond = list_.bonds()[i];
    if (change.kept < 1) {
      lag_frame(bond, x);
      move_attachment(bond, system_.lagged_surface().topology(), system_.surface().mesh, x, change.kept);
    }
    remaining.add(bond, variables.data());
  }
  remaining.write(history);
  if (once_) write_bonded_once(history);
}

}  // namespace tack
