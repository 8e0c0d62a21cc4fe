// Forces of vertices as tractions: per area that the vertex has of the contact. That is the sum over the points of quadrature of w |c|, w a point's
// weight and c the part of its force that the vertex takes, so that what presses evenly has one pressure whatever the meshes.
// Forces where there is no such area, of guards, count per area around the vertex.
#pragma once

#include <string_view>

#include "geometry/types.hpp"

namespace tack {

struct World;

// One per vertex [Pa], of normal forces or a part of them (3n [N], collected on meshes): positive where they press, negative where they
// pull. Of solids, into and out of them; sheets, rods and particles have no inside: of them, towards and away from what is opposite, of
// sheets the sum over both sides. Zero where there is no force, not a number inside of solids. Contact must be at x.
VecX normal_pressures(const World& world, const VecX& x, const VecX& forces, std::string_view part);

// The magnitude of the force per the same area.
VecX tangential_tractions(const World& world, const VecX& x, const VecX& forces);

}  // namespace tack
