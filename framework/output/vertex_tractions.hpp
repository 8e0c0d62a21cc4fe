// Vertex forces as tractions: force per contact area of the vertex. The area is the sum over
// quadrature points of w |c|, with the weight w of a point and the fraction c of its force that the
// vertex gets, so that a uniform pressure gives one value on any mesh. Forces without such an area,
// of safety barrier pairs, are divided by the tributary area of the vertex.
#pragma once

#include <string_view>

#include "geometry/types.hpp"

namespace tack {

struct World;

// Returns, per vertex [Pa], the normal traction of normal forces or one term of them (3n [N],
// collected on meshes): positive in compression, negative in tension:
//    solids              along their own normal
//    sheets              towards and away from the opposite object, sum over both sides
//    rods, particles     towards and away from the opposite object
//    no force            0
//    inside of solids    NaN
// Throws logic_error if contact is at another configuration.
VecX normal_pressures(const World& world, const VecX& x, const VecX& forces,
                      std::string_view summand);

// Returns the magnitude of the force per contact area.
VecX tangential_tractions(const World& world, const VecX& x, const VecX& forces);

}  // namespace tack
