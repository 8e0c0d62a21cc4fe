// What bonds are like at the vertices that they hang on, on either side.
#pragma once

#include "framework/bond/bond_term.hpp"

namespace tack {

// Their mean intensity, by area, of so many vertices; not a number where there is none.
VecX bond_intensities(const BondTerm& bonds, Eigen::Index vertices);
// The magnitude of their force per area [Pa]; 0 where there is none.
VecX bond_tractions(const BondTerm& bonds, const VecX& x);

}  // namespace tack
