// Bonds that a motion takes past the peak of their traction. The traction is taken along the opening (d, u) of the bond, lambda its length:
//     d phi / d lambda,   d^2 phi / d lambda^2   with d = lambda cos(theta), |u| = lambda sin(theta).
#include <algorithm>
#include <cmath>

#include "framework/bond/bond_term.hpp"

namespace tack {
namespace {

constexpr double softening = 1e-6;  // the share of the secant stiffness by which a tangent is below zero for certain
constexpr double at_limit = 1.01;   // the opening over the present one from which on a bond that softens gives way already, as at a crack's tip

struct AlongOpening {
  double traction, stiffness;  // Pa, Pa/m
};

bool softens(const AlongOpening& at, double length) { return at.stiffness * length < -softening * at.traction; }

// At the opening `length` [m] along the direction whose part along the normal is `cosine`.
AlongOpening along_opening(const BondLaw& law, const double* memory, double h, double length, double cosine) {
  const double across = 1 - cosine * cosine;  // sin^2
  const BondSample s = law.at(length * cosine, length * length * across, memory, h);
  return {s.by_d * cosine + 2 * s.by_s * length * across,
          s.by_dd * cosine * cosine + 4 * s.by_ds * cosine * across * length + 4 * s.by_ss * length * length * across * across + 2 * s.by_s * across};
}

}  // namespace

void BondTerm::mark_letting_go(const VecX& from, const VecX& to, std::vector<char>& vertices) const {
  frame_at(from);
  for (int i = 0; i < list_.size(); ++i) {
    const Bond& bond = list_.bonds()[i];
    const Opening before = opening_of(bond, from), after = opening_of(bond, to);
    const double d = std::max(after.d, 0.0), length = std::hypot(d, std::sqrt(after.s));
    const double length_before = std::hypot(std::max(before.d, 0.0), std::sqrt(before.s));
    if (!(length > length_before)) continue;
    const double cosine = d / length;
    const auto at = [&](double opening) { return along_opening(law_of(i), list_.memory(i), h_, opening, cosine); };
    const double soon = std::min(at_limit * length_before, length);
    if (!(at(length_before).stiffness > 0) || softens(at(soon), soon)) continue;
    const AlongOpening end = at(length);
    if (end.traction > 0 && !softens(end, length)) continue;
    for (int v = 0; v < bond.count(); ++v) vertices[bond.vertices[v]] = 1;
  }
}

}  // namespace tack
