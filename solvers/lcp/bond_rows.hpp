// Constraint rows of bonds. Frames are those of the start of the step (framework/bond/bond.hpp).
// The stiffness is that of the bond's law at the end of the step; it is constant for rcc_explicit,
// whose intensity is lagged.
#pragma once

#include "framework/bond/bond_term.hpp"
#include "solvers/lcp/contact_rows.hpp"
#include "solvers/lcp/gauss_seidel.hpp"

namespace tack {

// Adds the rows of bond i to `rows` and `sweeps`. x, end: configurations at the start of the step
// and at its end without impulses (3n) [m]. Adds nothing for a bond without strength.
void add_bond_rows(const BondTerm& bonds, int i, const VecX& x, const VecX& end,
                   const LinearizedStep& step, Rows& rows, GaussSeidel& sweeps);
// Returns the stiffness of bond i for a step of length h [s]. at: opening and slip along the bond's
// rows [m].
BondStiffness bond_stiffness(const BondTerm& bonds, int i, const Vec3& at, double h);
// Returns the contact pressure at each bond [Pa], from the contact forces on the vertices of its
// site.
std::vector<double> bond_pressures(const BondTerm& bonds, const std::vector<ContactRow>& contacts,
                                   const ContactSystem& system);

}  // namespace tack
