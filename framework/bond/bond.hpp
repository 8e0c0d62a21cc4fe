// A bond joins a bond site on one surface to an attachment point on the opposite surface, and has
// an area. The interface between the surfaces lies in the middle of the gap. Site and attachment
// point both carry one point of the interface: at the lever l_S above the plane of their triangle
// S, along its unit normal n_S. Both normals point from the attachment point to the site. With the
// barycentric coefficients c_i of the site (positive) and of the attachment point (negative),
//     r = sum_i c_i x_i - sum_S l_S n_S   vector from the interface point of the opposite side to
//                                         that of the site; 0 where they bonded
//     n = (n_1 + n_2) / L, |n| = 1        normal of the interface; for rods and particles the
//                                         normal of the opposite triangle
//     d = n . r,   u = r - (n . r) n      opening and slip since the surfaces bonded [m]
// A traction at the interface has a moment about each surface, over contact offset and gap. It acts
// on each side as a couple on its triangle. A vertex of a rod or of a particle has no normal and no
// lever: the opposite triangle takes the whole moment.
//
// Frames are lagged. With the gradients g_j of a triangle's barycentric coordinates, its normal at
// x is
//     n_S (1 - q/2 - q^2/8) - b_S,   b_S = sum_j g_j (n_S . x_j),   q = |b_S|^2,
// with an error of a^6/16 for a tilt by an angle a. In the lagged frame, with r_0 and u_0 where the
// frame was taken, r is
//     r + G sum_S b_S,   G = ((n . r_0) (I - n n^T) - n u_0^T) / L.
// Bonds have no net force. Where their frames were taken they have no net moment.
// Limits: a tilt by a in a step changes d and u by an error of a^2/2; a spin by b about the normal
// in the same step adds an error of about a b / 2 of the lever, along the surface. Triangles face
// each other by less than 168 degrees.
#pragma once

#include <array>

#include "geometry/types.hpp"

namespace tack {

/// A bond and its lagged frame.
struct Bond {
  static constexpr int most = 6;  // vertices

  int rule = 0;               // index in the bond table
  int a = 0, b = 0;           // objects of the site and of the attachment point
  int triangle = -1;          // of the contact surface, at the site; -1: the vertex vertices[0]
  int opposite_triangle = 0;  // of the contact surface, at the attachment point
  int site_count = 3;         // vertices of the site, 3 or 1; those of the opposite triangle follow
  std::array<int, most> vertices{};
  std::array<double, most> c{};
  double area = 0;  // m^2
  double rest = 0;  // distance of the unstressed site from the opposite triangle's plane [m]
  // Per side: the site's, then the opposite one.
  std::array<double, 2> lever{0, 0};  // l_S [m]
  std::array<double, 2> side{1, 1};   // -1: n_S is opposite to the normal by the order of vertices
  /// The lagged frame.
  Vec3 normal = Vec3::Zero();
  std::array<Vec3, 2> normals{Vec3::Zero(), Vec3::Zero()};
  std::array<Vec3, most> gradients{};  // g_j by vertex [1/m]; 0 for a site at a vertex
  Mat3 turn = Mat3::Zero();            // G [m]

  int count() const { return site_count + 3; }
  int side_of(int i) const { return i < site_count ? 0 : 1; }  // of vertex i
  bool between(int first, int second) const {
    return (a == first && b == second) || (a == second && b == first);
  }
};

/// Opening and slip of a bond since its surfaces bonded.
struct Opening {
  double d;                   // m; negative if the surfaces are closer than when they bonded
  double s;                   // |u|^2 [m^2]
  Vec3 u;                     // m
  std::array<Vec3, 2> tilts;  // b_S
};

/// Stores the frame of both sides at x.
void lag_frame(Bond& bond, const VecX& x);

/// Returns opening and slip at x. Called for each bond of each evaluation: sums are written by
/// components, because assembling small vectors stalls the processor.
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
    const double along = 1 - q / 2 - q * q / 8, l = bond.lever[side];
    for (int k = 0; k < 3; ++k) r[k] += l * (b[k] - along * n[k]);
  };
  add_side(0, 0, bond.site_count);
  add_side(1, bond.site_count, bond.site_count + 3);
  for (int j = 0; j < 3; ++j) {
    const double b = tilt[0][j] + tilt[1][j];
    for (int k = 0; k < 3; ++k) r[k] += bond.turn(k, j) * b;
  }
  const Vec3& n = bond.normal;
  const double d = n[0] * r[0] + n[1] * r[1] + n[2] * r[2];
  const double u[3] = {r[0] - d * n[0], r[1] - d * n[1], r[2] - d * n[2]};
  return {d,
          u[0] * u[0] + u[1] * u[1] + u[2] * u[2],
          Vec3(u[0], u[1], u[2]),
          {Vec3(tilt[0][0], tilt[0][1], tilt[0][2]), Vec3(tilt[1][0], tilt[1][1], tilt[1][2])}};
}

/// Returns M of the derivative of r by x_i in the lagged frame, c_i I + (M g_i) n_S^T.
inline Mat3 turn_of(const Bond& bond, const Opening& o, int side) {
  const Vec3& tilt = o.tilts[side];
  const double stretch = 1 + tilt.squaredNorm() / 2;
  Mat3 m = bond.turn + bond.lever[side] * stretch * bond.normals[side] * tilt.transpose();
  m.diagonal().array() += bond.lever[side];
  return m;
}

/// Distributes the force f, conjugate to r, over the vertices: calls act(i, force at vertex i).
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
