// The contacts of one configuration as friction needs them, to be held while a step is solved:
//     u = T^T sum_i c_i (x_i - x_i^n)
// with the coefficients c of the closest points (sum 0; sum c_i x_i is the gap vector), a tangent
// basis T, and the magnitudes
//     lambda = - sum w b'(d)      the barrier's repulsion alone: adhesion does not press   [N]
//     area   = sum w              the tangential adhesion is mu_a area max a'              [m^2]
// (the paper, section 3.1 and eq. 13).
//
// Inclusion-exclusion (point_features.hpp) gives a point several features with weights of both
// signs. Friction of each by itself would not be convex, and its magnitudes would not add up. So the
// features of (point, object) whose normals agree (dot > 0) are one contact: lambda is the net force
// along the normal of the strongest feature, area the net weight, neither below zero, and the closest
// point is the strongest feature's. Pairs of edges stay as they are.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/contact_system.hpp"

namespace tack {

using TangentBasis = Eigen::Matrix<double, 3, 2>;

template <int K>
struct LaggedContact {
  std::array<int, K> vertices;
  std::array<double, K> coefficients;
  TangentBasis tangents;
  int law;              // of the pair table
  int first_vertices;   // how many of the vertices belong to the first object
  double normal_force;  // lambda [N]
  double area;          // m^2
};

struct LaggedContacts {
  std::vector<LaggedContact<2>> twos;    // point-point
  std::vector<LaggedContact<3>> threes;  // point-edge
  std::vector<LaggedContact<4>> fours;   // point-triangle and sample-point, then edge-edge
  std::vector<LaggedContact<5>> fives;   // sample-edge
  std::vector<LaggedContact<6>> sixes;   // sample-triangle
};

struct LagRequest {
  const ContactSystem& system;           // must be at x
  const std::vector<PairLaw>& barriers;  // the repulsive part of each law of its pair table
  const std::vector<char>& wanted;       // per law: others are left out if 0
  const VecX& x;
};
LaggedContacts lag_contacts(const LagRequest& request);

// Its parts: a basis of the plane across a unit normal, and the contacts of points
// (lagged_points.cpp).
TangentBasis tangents_of(const Vec3& normal);
void lag_points(const LagRequest& request, LaggedContacts& out);

}  // namespace tack
