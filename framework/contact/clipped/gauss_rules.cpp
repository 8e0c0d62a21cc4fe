#include "framework/contact/clipped/gauss_rules.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace tack {

GaussRules gauss_rules(int points) {
  GaussRules rules;
  SegmentRule& line = rules.segment;
  for (int i = 0; i < points; ++i) {
    // Newton's method on the Legendre polynomial, from Tricomi's estimate of its root.
    double z = std::cos(std::numbers::pi * (i + 0.75) / (points + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double value = z, last = 1;
      for (int k = 2; k <= points; ++k) {
        const double next = ((2 * k - 1) * z * value - (k - 1) * last) / k;
        last = value;
        value = next;
      }
      slope = points * (z * value - last) / (z * z - 1);
      z -= value / slope;
    }
    line.at.push_back(0.5 * (1 - z));
    line.weight.push_back(1 / ((1 - z * z) * slope * slope));
  }
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j) {
      // On the line to the fraction v of the opposite edge, at the fraction u of the way.
      const double u = line.at[i], v = line.at[j];
      rules.triangle.first.push_back(u * (1 - v));
      rules.triangle.second.push_back(u * v);
      rules.triangle.weight.push_back(2 * u * line.weight[i] * line.weight[j]);
    }
  return rules;
}

namespace {

// Degrees 2, 6, 10, 14 on a triangle, 3, 7, 11, 15 on a segment.
const std::array<GaussRules, 4> in_strips{gauss_rules(2), gauss_rules(4), gauss_rules(6), gauss_rules(8)};

}  // namespace

const GaussRules& rules_in_strips(int strips) { return in_strips[strips]; }

}  // namespace tack
