// Bonds that a motion takes past the peak of their traction. The traction is taken along the
// opening (d, u) of the bond, with length lambda:
//     d phi / d lambda,   d^2 phi / d lambda^2   with d = lambda cos(theta), |u| = lambda
//     sin(theta).
#include <algorithm>
#include <array>
#include <cmath>

#include "framework/bond/bond_term.hpp"
#include "framework/core/concurrent_maximum.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// A bond softens if its tangent stiffness is below -softening times its secant stiffness: round-off is smaller.
constexpr double softening = 1e-6;
// A bond that softens at this multiple of its opening at the start has reached its limit, as bonds at a crack tip have.
constexpr double at_limit = 1.01;

struct AlongOpening {
  double traction, stiffness;  // Pa, Pa/m
};

bool softens(const AlongOpening& at, double length) { return at.stiffness * length < -softening * at.traction; }

// Opening of a bond along a direction whose component along the normal is `cosine`.
struct Path {
  double length, cosine;  // m
  double across() const { return 1 - cosine * cosine; }  // sin^2

  double d(double opening) const { return opening * cosine; }
  double s(double opening) const { return opening * opening * across(); }
  // Returns slope and curvature of the law along the opening, from its sample there.
  AlongOpening along(const BondSample& s, double opening) const {
    return {s.by_d * cosine + 2 * s.by_s * opening * across(),
            s.by_dd * cosine * cosine + 4 * s.by_ds * cosine * across() * opening + 4 * s.by_ss * opening * opening * across() * across() +
                2 * s.by_s * across()};
  }
};

double length_of(const Opening& o) { return std::hypot(std::max(o.d, 0.0), std::sqrt(o.s)); }

}  // namespace

void BondTerm::mark_debonding(const VecX& from, const VecX& to, std::vector<char>& vertices) const {
  ensure_frames(from);
  constexpr int blocks_at_once = 8;
  for_each(static_cast<int>(blocks_.size()), [&](int k) {
    // No structured binding: the lambda below would capture it, which Clang 14 does not support.
    const int first = blocks_[k].first, last = blocks_[k].last;
    if (directed(blocks_[k])) return mark_directed(blocks_[k], from, to, vertices);
    std::array<double, most_in_block> length_before, d{}, s{};  // at the end
    std::array<Path, most_in_block> paths;
    std::array<BondSample, most_in_block> ends{};
    const auto widens = [&](int i) { return paths[i].length > length_before[i]; };
    for (int i = 0; i < last - first; ++i) {
      const Bond& bond = list_.bonds()[first + i];
      const Opening after = opening_of(bond, to);
      const double length = length_of(after);
      paths[i] = {length, std::max(after.d, 0.0) / length};
      length_before[i] = length_of(opening_of(bond, from));
      if (widens(i)) d[i] = paths[i].d(length), s[i] = paths[i].s(length);
    }
    const BondLaw& law = law_of(first);
    law.add_samples(last - first, d.data(), s.data(), list_.variables(first), step_of(first), ends.data());
    for (int i = 0; i < last - first; ++i) {
      if (!widens(i)) continue;
      const Path& path = paths[i];
      const AlongOpening end = path.along(ends[i], path.length);
      if (end.traction > 0 && !softens(end, path.length)) continue;
      // Few bonds are past their peak. Bonds that were past it at the start are not marked.
      const auto at = [&](double opening) { return path.along(law.at(path.d(opening), path.s(opening), list_.variables(first + i), step_of(first + i)), opening); };
      const double soon = std::min(at_limit * length_before[i], path.length);
      if (!(at(length_before[i]).stiffness > 0) || softens(at(soon), soon)) continue;
      const Bond& bond = list_.bonds()[first + i];
      for (int v = 0; v < bond.count(); ++v) mark(vertices[bond.vertices[v]]);
    }
  }, blocks_at_once);
}

void BondTerm::mark_directed(const Block& block, const VecX& from, const VecX& to, std::vector<char>& vertices) const {
  for (int i = block.first; i < block.last; ++i) {
    const Bond& bond = list_.bonds()[i];
    const auto jump_at = [&](const VecX& x) {
      Vec3 jump = jump_of(i, opening_of(bond, x));
      jump[0] = std::max(jump[0], 0.0);
      return jump;
    };
    const Vec3 end = jump_at(to);
    const double length = end.norm(), before = jump_at(from).norm();
    if (!(length > before)) continue;
    const Vec3 along = end / length;
    const auto at = [&](double opening) {
      DirectedSample sample;
      const Vec3 jump = opening * along;
      law_of(i).add_directed_samples(1, &jump, list_.variables(i), step_of(i), &sample);
      return AlongOpening{sample.gradient.dot(along), along.dot(sample.hessian * along)};
    };
    const AlongOpening there = at(length);
    if (there.traction > 0 && !softens(there, length)) continue;
    const double soon = std::min(at_limit * before, length);
    if (!(at(before).stiffness > 0) || softens(at(soon), soon)) continue;
    for (int v = 0; v < bond.count(); ++v) mark(vertices[bond.vertices[v]]);
  }
}

}  // namespace tack
