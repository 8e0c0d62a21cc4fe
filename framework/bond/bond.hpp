// A bond: a place on one surface, the anchor on another opposite it, and an area. Each of the two
// carries the same point of the interface between them: at the lever l_S above the plane of its
// triangle S, along the triangle's unit normal n_S. Normals of both sides look from the anchor to
// the place. With the coefficients c_i of the place (positive) and of the anchor (negative),
//     r = sum_i c_i x_i - sum_S l_S n_S   leads from the anchor's point to the place's, 0 where
//                                         they bonded;
//     n = (n_1 + n_2) / L, |n| = 1        is the normal of the interface (of rods and particles:
//                                         the anchor's);
//     d = n . r,   u = r - (n . r) n      are the opening and the slip since they bonded [m].
// The interface lies in the middle of the gap. So the moment that a traction has about a surface,
// over contact offset and gap, acts on either side as a couple on its own triangle. A vertex of a
// rod or a particle has no normal and no lever: the anchor takes the whole moment.
// Frames are lagged in a step. With the gradients g_j of a triangle's barycentric coordinates, its
// normal is at x
//     n_S (1 - q/2 - q^2/8) - b_S,   b_S = sum_j g_j (n_S . x_j),   q = |b_S|^2,
// which a tilt by an angle a gets right to a^6/16, and r seen from the frame, r_0 being that of
// where frames were taken, is
//     r + G sum_S b_S,   G = ((n . r_0) (I - n n^T) - n u_0^T) / L.
// Bonds have no net force, and where their frames were taken no moment.
// Limits: a tilt by a in a step is off by a^2/2 of d and u; with a spin by b about the normal in
// the same step by about a b / 2 of the lever, across. Triangles face each other by less than 168
// degrees.
#pragma once

#include <array>

#include "geometry/types.hpp"

namespace tack {

struct Bond {
  static constexpr int most = 6;  // vertices

  int rule = 0;           // of the bond table
  int a = 0, b = 0;       // the objects of the place and of the anchor
  int triangle = -1;      // of the contact surface, of the place; -1: it is the vertex vertices[0]
  int anchor = 0;         // the anchor's triangle
  int leading = 3;        // how many vertices are the place's, 3 or 1; the anchor's three follow
  std::array<int, most> vertices{};
  std::array<double, most> c{};
  double area = 0;        // m^2
  double rest = 0;        // distance of the unstressed place from the anchor's plane [m]
  // Per side: the place's, then the anchor's.
  std::array<double, 2> lever{0, 0};  // l_S [m]
  std::array<double, 2> side{1, 1};   // -1: n_S is opposite to the normal by the order of vertices
  // The lagged frame.
  Vec3 normal = Vec3::Zero();
  std::array<Vec3, 2> normals{Vec3::Zero(), Vec3::Zero()};
  std::array<Vec3, most> gradients{};  // g_j by vertex [1/m]; 0 of a place that is a vertex
  Mat3 turn = Mat3::Zero();            // G [m]

  int count() const { return leading + 3; }
  int side_of(int i) const { return i < leading ? 0 : 1; }  // of vertex i
  bool between(int first, int second) const {
    return (a == first && b == second) || (a == second && b == first);
  }
};

struct Opening {
  double d;  // m; below zero where the surfaces are closer than as they bonded
  double s;  // |u|^2 [m^2]
  Vec3 u;    // m
  std::array<Vec3, 2> tilts;  // b_S
};

// Takes the frame of both sides at x.
void hold_frame(Bond& bond, const VecX& x);

// Sums by numbers: it is called for each bond of each evaluation, and small vectors put together
// stall.
inline Opening opening_of(const Bond& bond, const VecX& x) {
  double r[3] = {0, 0, 0}, tilt[2][3] = {{0, 0, 0}, {0, 0, 0}};
  const auto add_side = [&](int side, int begin, int end) {
    const Vec3& n = bond.normals[side];
    double* b = tilt[side];
    for (int i = begin; i < end; ++i) {
      const double *at = x.data() + 3 * bond.vertices[i], c = bond.c[i];
      const double height = n[0] * at[0] + n[1] * at[1] + n[2] * at[2];
      const Vec3& g = bond.gradients[i];
      for (int k = 0; k < 3; ++k) r[k] += c * at[k], b[k] += height * g[k];
    }
    const double q = b[0] * b[0] + b[1] * b[1] + b[2] * b[2];
    const double stands = 1 - q / 2 - q * q / 8, l = bond.lever[side];
    for (int k = 0; k < 3; ++k) r[k] += l * (b[k] - stands * n[k]);
  };
  add_side(0, 0, bond.leading);
  add_side(1, bond.leading, bond.leading + 3);
  for (int j = 0; j < 3; ++j) {
    const double b = tilt[0][j] + tilt[1][j];
    for (int k = 0; k < 3; ++k) r[k] += bond.turn(k, j) * b;
  }
  const Vec3& n = bond.normal;
  const double d = n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
  const double u[3] = {r[0] - d * n[0], r[1] - d * n[1], r[2] - d * n[2]};
  return {d, u[0] * u[0] + u[1] * u[1] + u[2] * u[2], Vec3(u[0], u[1], u[2]),
          {Vec3(tilt[0][0], tilt[0][1], tilt[0][2]), Vec3(tilt[1][0], tilt[1][1], tilt[1][2])}};
}

// M of the derivative of r as seen from the frame by x_i, c_i I + (M g_i) n_S^T.
inline Mat3 turn_of(const Bond& bond, const Opening& o, int side) {
  const Vec3& tilt = o.tilts[side];
  const double stretch = 1 + tilt.squaredNorm() / 2;
  Mat3 m = bond.turn + bond.lever[side] * stretch * bond.normals[side] * tilt.transpose();
  m.diagonal().array() += bond.lever[side];
  return m;
}

// Distributes a vector conjugate to r over the vertices: calls act(i, its share of vertex i).
template <class Act>
void for_each_vertex(const Bond& bond, const Opening& o, const Vec3& f, const Act& act) {
  const std::array<Vec3, 2> couple = {turn_of(bond, o, 0).transpose() * f,
                                      turn_of(bond, o, 1).transpose() * f};
  for (int i = 0; i < bond.count(); ++i) {
    const int side = bond.side_of(i);
    act(i, Vec3(bond.c[i] * f + couple[side].dot(bond.gradients[i]) * bond.normals[side]));
  }
}

}  // namespace tack
