// Overhang: a segment of the overlap boundary (overlap_boundary_forces.hpp) close to the boundary
// of the own surface. The own surface sticks out beyond the edge of the other one by w, measured
// along the outward normal m of that edge. To first order in the displacements,
//     w = w_0 + sum_i g_i . (x_i - x_i^n)   with the gradients g_i of s in that file.
// A force that is constant through a step carries the own boundary past that edge, where it would
// have to change its sign, and two equal surfaces swing for ever. So the energy is a function of w,
//     E = W l (rho(w) - rho(w_0)),   rho(w) = w^2 / (2 R)   for |w| <= R
//                                             |w| - R / 2   otherwise     (Huber 1964),
// with the energy per area -W of the laws and the length l of the segment: the area that does not
// overlap grows on either side. R, the softening length, makes the force continuous. E is convex.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/types.hpp"

namespace tack {

// Softening length over the range of the law. Larger ones reduce the force of small overhangs,
// smaller ones leave blocks that swing over the softened part in one step: docs/log/contact.md.
constexpr double softening_per_range = 0.25;

struct Overhang {
  int object, other_object;
  std::array<int, 6> vertices;   // of the own triangle, then of the other one
  std::array<Vec3, 6> gradient;  // of w
  double energy;                 // W l [J/m]; negative for segments that cancel others
  double at_start;               // w_0 [m]
  double softening;              // R [m]

  // Returns w [m]. x, start: 3n, the configuration and that of the start of the step.
  double width(const VecX& x, const VecX& start) const {
    double w = at_start;
    for (int i = 0; i < 6; ++i)
      w += gradient[i].dot(vertex(x, vertices[i]) - vertex(start, vertices[i]));
    return w;
  }
  double value(double w) const { return energy * (softened(w) - softened(at_start)); }    // J
  double slope(double w) const { return energy * std::clamp(w / softening, -1.0, 1.0); }  // N
  double curvature(double w) const {
    return std::abs(w) < softening ? energy / softening : 0.0;  // N/m
  }

 private:
  double softened(double w) const {
    const double size = std::abs(w);
    return size < softening ? w * w / (2 * softening) : size - softening / 2;
  }
};

}  // namespace tack
