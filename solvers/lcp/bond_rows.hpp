// Bonds as constraint rows: frames are those of the start of the step (framework/bond/bond.hpp),
// stiffnesses those of the bond's law at the end of the step; that of rcc_explicit, whose intensity
// is lagged, is constant.
#pragma once

#include "framework/bond/bond_term.hpp"
#include "solvers/lcp/contact_rows.hpp"
#include "solvers/lcp/gauss_seidel.hpp"

namespace tack {

// Adds the rows of bond i, which is at x when the step starts and at `end` (3n) without impulses;
// nothing for one without strength.
void add_bond_rows(const BondTerm& bonds, int i, const VecX& x, const VecX& end,
                   const LinearizedStep& step, Rows& rows, GaussSeidel& sweeps);
// at: opening and slip in the bond's rows [m].
BondStiffness bond_stiffness(const BondTerm& bonds, int i, const Vec3& at, double h);
// Returns the pressure on the surfaces at each bond [Pa], by the forces of contacts on the vertices
// of its place.
std::vector<double> bond_pressures(const BondTerm& bonds, const std::vector<ContactRow>& contacts,
                                   const ContactSystem& system);

}  // namespace tack
