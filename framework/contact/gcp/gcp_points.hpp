// Contact points of the Geometric Contact Potential: one for each stencil, with the normal force
// -w Gamma phi' and the area w Gamma, on which friction acts. Directional factors add no friction.
#pragma once

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/gcp/gcp_term.hpp"

namespace tack {

// Returns the contact points of the stencils found at x. wanted: per law.
ContactPoints gcp_points(const GcpContacts& contacts, const GcpTerm& term,
                         const std::vector<char>& wanted, const VecX& x);

// Returns the coefficients of the closest points, sum_i c_i x_i = gap n, of the core vertices.
std::array<double, 4> gcp_coefficients(GcpKind kind, const std::array<Vec3, gcp_arity_max>& x);

}  // namespace tack
