// Sizes of elements: volumes [m^3], areas [m^2], and inverted tets. Signs come from rounded
// determinants, not from exact predicates.
#pragma once

#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Returns (b-a) x (c-a) . (d-a) / 6, negative for an inverted tet.
double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
double tet_volume(const Mesh& mesh, int tet);

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c);
double triangle_area(const Mesh& mesh, int triangle);
double triangle_area(const VecX& x, const Triangle& triangle);

// Returns the indices of tets whose volume is not positive.
std::vector<int> inverted_tets(const Mesh& mesh);

// Return sums over the explicit tets and triangles.
double total_volume(const Mesh& mesh);
double total_area(const Mesh& mesh);

}  // namespace tack
