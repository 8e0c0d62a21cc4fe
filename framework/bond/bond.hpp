// A bond: a place on one surface, the anchor on another where it was closest when they bonded, and an area. With the coefficients c
// of the two, r = sum_i c_i x_i leads from the anchor to the place; n is the unit normal of the anchor's triangle towards the place, and
//     d = n . r - rest,   u = r - (n . r) n     the opening and the slip since they bonded [m].
// Both are places of the material: nothing is added up from step to step, and a rigid motion of the two changes nothing.
// The frame turns with the anchor's triangle: of a displacement dx_j of its corner j, with the gradients g_j of its barycentric coordinates,
//     dn = - sum_j g_j (n . dx_j),   and r seen from the frame changes by   sum_i c_i dx_i + sum_j v_j (n . dx_j),
//     v_j = (n . r) g_j - (u . g_j) n.
// n and the v_j are those of the start of the step (or of its latest solution, where it is solved again), held in it, so that d and u are
// linear in x: bonds have neither a net force nor, there, a moment.
#pragma once

#include <array>

#include "geometry/types.hpp"

namespace tack {

struct Bond {
  static constexpr int most = 6;  // vertices

  int rule = 0;           // of the bond table
  int a = 0, b = 0;       // the objects of the place and of the anchor
  int triangle = -1;      // of the contact surface that the place is in; -1: it is the vertex vertices[0]
  int anchor = 0;         // the anchor's triangle
  int leading = 3;        // how many of the vertices are the place's: 3 or 1; three more are the anchor's
  std::array<int, most> vertices{};
  std::array<double, most> c{};
  double area = 0;        // m^2
  double rest = 0;        // n . r of the unstressed bond [m]
  double side = 1;        // -1: the place is behind the anchor's triangle, on a sheet
  Vec3 normal = Vec3::Zero();
  std::array<Vec3, 3> turns{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // v_j
  Vec3 shift = Vec3::Zero();  // - sum_j v_j (n . x_j) where they are held [m]

  int count() const { return leading + 3; }
  bool between(int first, int second) const { return (a == first && b == second) || (a == second && b == first); }
};

struct Opening {
  double d;  // m; below zero where the surfaces are closer than as they bonded
  double s;  // |u|^2 [m^2]
  Vec3 u;    // m
};

// Takes the frame of the anchor at x.
void hold_frame(Bond& bond, const VecX& x);

inline Opening opening_of(const Bond& bond, const VecX& x) {
  Vec3 r = Vec3::Zero();
  for (int i = 0; i < bond.count(); ++i) r += bond.c[i] * vertex(x, bond.vertices[i]);
  for (int j = 0; j < 3; ++j) r += bond.turns[j] * bond.normal.dot(vertex(x, bond.vertices[bond.leading + j]));
  r += bond.shift;
  const double along = bond.normal.dot(r);
  const Vec3 u = r - along * bond.normal;
  return {along - bond.rest, u.squaredNorm(), u};
}

}  // namespace tack
