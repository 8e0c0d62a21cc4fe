// Gauss-Legendre rules on a segment, and their products on a triangle (Stroud 1971): n points are
// exact for polynomials of degree 2n - 1 on a segment; n x n points for degree 2n - 2 on a
// triangle.
#pragma once

#include <vector>

namespace tack {

struct SegmentRule {
  std::vector<double> at;      // in [0, 1]
  std::vector<double> weight;  // sum: 1
};

struct TriangleRule {
  static constexpr int points_max = 64;
  std::vector<double> first, second;  // barycentric coordinates of corners 1 and 2
  std::vector<double> weight;         // sum: 1
};

struct GaussRules {
  SegmentRule segment;
  TriangleRule triangle;
};

// Returns the rules of n points a direction.
GaussRules gauss_rules(int points);
// Returns the rules that are exact for a parabola of the gap times the weights of 0 to 3 strips, of
// degree four each, and on a segment times a linear function.
const GaussRules& rules_in_strips(int strips);

}  // namespace tack
