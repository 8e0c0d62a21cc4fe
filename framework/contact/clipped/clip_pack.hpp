// The clipped integral (clipped_pair.hpp) of several pairs of triangles side by
// side, for pairs that need no polygon: those that face each other well, in one
// band of gaps, in one strip at most, with no edges that cross at a small angle
// and no sliver along a line. All others are left to ClipIntegrator.
//
// Key idea: S is bounded by parts of the six edges: those of a within b and
// those of b within a. Moments are sums over these parts of the triangles that
// they form with a common point, and the parts are the sides of the shape
// derivative. No list of corners is kept, so lanes do not branch. The weight of
// a strip changes integrals of p by that of (rho - 1) p over the part of S in
// it. By Gauss's theorem this is a sum over the sides too: with e, the
// direction of the distance s from the boundary edge, (rho - 1) p is the
// divergence of e int from R to s of (rho - 1) p, which is zero where the strip
// ends.
#pragma once

#include "framework/contact/clipped/clipped_pair.hpp"
#include "geometry/pack.hpp"

namespace tack {

class ClipPack {
 public:
  static constexpr int hessian_slots = 9 * 21;  // lower triangle of 6 x 6 blocks, by rows

  // vertices: of the corners of a, then of b, in the positions x (3n) [m];
  // strip_b, boundary_a, owns_b as ClippedPair's; two_sided_b: a may lie on the other side of b.
  void set(int lane, const VecX& x, const std::array<int, 6>& vertices,
           const std::array<double, 3>& strip_b, const std::array<bool, 3>& boundary_a,
           const std::array<bool, 3>& owns_b, bool two_sided_b);
  // Clips the pairs in all lanes. Returns a bit per lane whose integral is
  // found here, also if it is zero.
  unsigned clip(const GapBands& bands);
  // The two gaps of each lane l at which the law is taken: l and pack_width + l [m].
  const double* gaps() const { return gaps_; }
  // Returns the energy of each lane, from the law at these gaps [J].
  Pack energy(const double* values) const;
  // Returns the integral of a lane with this energy [J].
  ClippedIntegral integral(int lane, double energy) const;
  // Writes derivatives: gradient[18], corners of a, then of b; unless null,
  // hessian[hessian_slots].
  void derivatives(const LawSample* samples, Pack* gradient, Pack* hessian) const;

 private:
  static Pack lesser(const Pack& a, const Pack& b) { return select(a < b, a, b); }
  static Pack greater(const Pack& a, const Pack& b) { return select(b < a, a, b); }
  // Part of an edge inside the other triangle, counter-clockwise around S. Where edges lie along
  // each other, it may reach beyond its ends.
  struct Side {
    Pack from, to;            // positions along the edge; equal: none
    Pack x, y;                // of the begin of the edge [m]
    Pack across_x, across_y;  // from the begin to the end of the edge [m]
    Pack gap, rise;           // at the begin, and to the end [m]
    Pack depth, deepening;    // distance from the boundary edge at the begin, and
                              // to the end [m]
    Pack strip_from,
        strip_to;  // positions of the part in the strip; equal: none
  };

  // Per corner and line of the other triangle.
  struct Outside {
    PackMask a[3][3], b[3][3];
  };

  // Calls act(side) for the edges that may have a part in S.
  template <class Act>
  void for_each_side(const Act& act) {
    for (Side& side : of_a_) act(side);
    if (a_inside_) return;
    for (Side& side : of_b_) act(side);
  }
  // Calls act(position along the edge, weight) at the points of a rule over the
  // part in the strip.
  template <class Act>
  static void for_strip_points(const Side& side, const Act& act);
  PackMask find_outside(const Pack* square_a, const Pack* square_b, const Pack (&of_a)[3][3],
                        const Pack (&of_b)[3][3], Outside& outside, PackMask& plain) const;
  PackMask cut_sides(PackMask& plain);
  void find_strip(PackMask& plain);
  void subtract_strip_moments(const Pack& o1, const Pack& o2, Pack* moments);
  void add_boundary_edges(const Pack* constants, const Pack (&in_b)[3][3], Pack* hessian) const;
  Pack h(const Pack* constants, const Pack& gap) const {
    const Pack from_mean = gap - mean_;
    return constants[0] + from_mean * (constants[1] + 0.5 * constants[2] * from_mean);
  }
  void shares(const Pack& x, const Pack& y, Pack& first, Pack& second) const;

  alignas(64) double corner_[18][pack_width];
  alignas(64) double strip_[3][pack_width], boundary_[3][pack_width], owns_[3][pack_width];
  alignas(64) double two_sided_b_[pack_width];
  Pack axes_[3][3];          // axis, coordinate
  Pack x_[3], y_[3], z_[3];  // local coordinates of a [m]
  Pack length_, foot_,
      height_;         // of b: corners (0, 0), (length, 0), (foot, height) [m]
  Pack by_projected_;  // of the projection of a: over twice its area [1/m^2]
  Side of_a_[3], of_b_[3];
  bool a_inside_;             // a lies inside b in all lanes: S is a
  Pack edge_length_b_[3];     // m
  PackMask in_strip_;         // whether a part of S lies in a strip
  PackMask strip_edge_[3];    // the boundary edge of that strip
  Pack inward_x_, inward_y_;  // of that edge: unit vector
  Pack width_;                // of the strip [m]
  Pack share_slope_1_,
      share_slope_2_;  // of the shares of corners 1 and 2, inward [1/m]
  Pack area_, first_, second_, first_first_, first_second_, second_second_, mean_, deviation_;
  alignas(64) double gaps_[2 * pack_width];
};

template <class Act>
void ClipPack::for_strip_points(const Side& side, const Act& act) {
  // Gauss-Legendre, exact for degree seven.
  constexpr double at[4] = {0.069431844202973712, 0.33000947820757187, 0.66999052179242813,
                            0.93056815579702629};
  constexpr double weight[4] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                0.17392742256872693};
  const Pack width = side.strip_to - side.strip_from;
  for (int i = 0; i < 4; ++i) act(side.strip_from + at[i] * width, weight[i] * width);
}

}  // namespace tack
