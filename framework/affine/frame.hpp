// Frame of an affine body (Lan et al. 2022, Affine Body Dynamics): four vertices with a quarter of
// the mass each, placed so that they have the mass, centroid and second moments of the body. All
// other vertices are affine functions of them, so that the kinetic energy and the weight of any
// affine motion are exactly those of the four masses:
//     p_i = c + sum_k sigma_ik s_k e_k,   s_k^2 = M_k / volume,
//     sigma = (+++), (+--), (-+-), (--+),
// M_k, e_k the principal second moments and their axes.
#pragma once

#include <array>

#include "geometry/mesh/mass_properties.hpp"
#include "geometry/tet_coordinates.hpp"

namespace tack {

struct BodyFrame {
  std::array<Vec3, 4> vertices;  // of a tet of positive volume [m]

  // Returns the weights of the four vertices for a point; they add up to one.
  std::array<double, 4> weights(const Vec3& point) const {
    return tet_coordinates(vertices, point);
  }
};

// Throws InputError if the body is flat.
BodyFrame body_frame(const MassProperties& body);

}  // namespace tack
