// Anisotropic friction by the grain of a surface, a direction of the material. The admissible
// friction of a contact is an ellipse, (f_1 / mu_1)^2 + (f_2 / mu_2)^2 <= N^2, along the grain (1)
// and across it (2), with the potential N |(mu_1 u_1, mu_2 u_2)| of the slip u: the elliptic model
// with an associated flow rule (Michalowski and Mroz 1978, Associated and non-associated sliding
// rules in contact friction problems; Goyal, Ruina and Papadopoulos 1991, Planar sliding with dry
// friction). Tangents that are scaled by mu_2 / mu_1 across the grain make it of isotropic friction
// with mu_1: that is all that is done here.
#pragma once

#include <vector>

#include "framework/contact/contact_system.hpp"
#include "framework/contact/points/contact_points.hpp"

namespace tack {

// Sets the tangents of the points whose laws differ across the grain: the first one along the grain
// at x, the second one scaled. grains: per object, at rest; 0: none. Where the grain is
// perpendicular to the contact, friction is that along the grain in all directions.
void scale_across_grain(const ContactSystem& system, const std::vector<Vec3>& grains, const VecX& x,
                        ContactPoints& points);

}  // namespace tack
