// Bond intensity and bond traction as fields over the vertices of both sides.
#pragma once

#include "framework/bond/bond_term.hpp"

namespace tack {

/// Returns the area-weighted mean intensity of the bonds per vertex; NaN at vertices without bonds.
VecX bond_intensities(const BondTerm& bonds, Eigen::Index vertices);
/// Returns the magnitude of the bond force per area at each vertex [Pa]; 0 without bonds.
VecX bond_tractions(const BondTerm& bonds, const VecX& x);

}  // namespace tack
