// Marks bonds by how far a motion takes their laws. The traction is taken along the
// opening (d, u) of the bond, with length lambda:
//     d phi / d lambda,   d^2 phi / d lambda^2   with d = lambda cos(theta), |u| = lambda
//     sin(theta).
#include <algorithm>
#include <array>
#include <cmath>

#include "framework/bond/bond_term.hpp"
#include "framework/core/concurrent_maximum.hpp"
#include "framework/core/debonding.hpp"
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

// Returns whether a bond that is past its peak at the end was not at the start of a motion from the opening `start` to `end`.
// at(opening): AlongOpening.
template <class At>
bool passes_from(double start, double end, const At& at) {
  const double soon = std::min(at_limit * start, end);
  return at(start).stiffness > 0 && !softens(at(soon), soon);
}

// Returns the work from the opening `start` to `end` by the trapezoidal rule, along the opening at the end [J/m^2].
template <class At>
double trapezoid(double start, double end, const At& at) {
  return (std::max(at(start).traction, 0.0) + std::max(at(end).traction, 0.0)) / 2 * (end - start);
}

double length_of(const Opening& o) { return std::hypot(std::max(o.d, 0.0), std::sqrt(o.s)); }

}  // namespace

void BondTerm::mark_debonding(const VecX& from, const VecX& to, std::vector<char>& marks) const {
  ensure_frames(from);
  constexpr int blocks_at_once = 8;
  for_each(static_cast<int>(blocks_.size()), [&](int k) {
    // No structured binding: the lambda below would capture it, which Clang 14 does not support.
    const int first = blocks_[k].first, last = blocks_[k].last;
    const auto add = [&](int i, char found) {
      const Bond& bond = list_.bonds()[i];
      for (int v = 0; v < bond.count(); ++v) mark(marks[bond.vertices[v]], found);
    };
    for (int i = first; i < last; ++i) add(i, adheres);
    if (directed(blocks_[k])) {
      for (int i = first; i < last; ++i) add(i, directed_marks(i, from, to));
      return;
    }
    std::array<double, most_in_block> d{}, s{};  // at the end
    std::array<Opening, most_in_block> before;
    std::array<Path, most_in_block> paths;
    std::array<BondSample, most_in_block> ends{};
    const auto widens = [&](int i) { return paths[i].length > length_of(before[i]); };
    for (int i = 0; i < last - first; ++i) {
      const Bond& bond = list_.bonds()[first + i];
      const Opening after = opening_of(bond, to);
      const double length = length_of(after);
      paths[i] = {length, std::max(after.d, 0.0) / length};
      before[i] = opening_of(bond, from);
      if (widens(i)) d[i] = paths[i].d(length), s[i] = paths[i].s(length);
    }
    const BondLaw& law = law_of(first);
    law.add_samples(last - first, d.data(), s.data(), list_.variables(first), step_of(first), ends.data());
    for (int i = 0; i < last - first; ++i) {
      if (!widens(i)) continue;
      const Path& path = paths[i];
      const AlongOpening end = path.along(ends[i], path.length);
      if (end.traction > 0 && !softens(end, path.length)) continue;
      // Few bonds are past their peak.
      const auto sample = [&](double opening_d, double opening_s) { return law.at(opening_d, opening_s, list_.variables(first + i), step_of(first + i)); };
      const auto at = [&](double opening) { return path.along(sample(path.d(opening), path.s(opening)), opening); };
      const double start = length_of(before[i]);
      if (passes_from(start, path.length, at)) add(first + i, passes_peak);
      const double taken = ends[i].value - sample(std::max(before[i].d, 0.0), before[i].s).value;
      if (std::max(taken, trapezoid(start, path.length, at)) > debonding_work_max * law.work_of_adhesion()) add(first + i, passes_over);
    }
  }, blocks_at_once);
}

// Returns the marks of a bond with a directed law, but for `adheres`.
char BondTerm::directed_marks(int bond, const VecX& from, const VecX& to) const {
  const auto jump_at = [&](const VecX& x) {
    Vec3 jump = jump_of(bond, opening_of(list_.bonds()[bond], x));
    jump[0] = std::max(jump[0], 0.0);
    return jump;
  };
  const Vec3 start = jump_at(from), end = jump_at(to);
  const double length = end.norm(), before = start.norm();
  if (!(length > before)) return 0;
  const auto sample = [&](const Vec3& jump) {
    DirectedSample s;
    law_of(bond).add_directed_samples(1, &jump, list_.variables(bond), step_of(bond), &s);
    return s;
  };
  const Vec3 along = end / length;
  const auto at = [&](double opening) {
    const DirectedSample s = sample(opening * along);
    return AlongOpening{s.gradient.dot(along), along.dot(s.hessian * along)};
  };
  const AlongOpening there = at(length);
  if (there.traction > 0 && !softens(there, length)) return 0;
  char marks = passes_from(before, length, at) ? passes_peak : 0;
  const double taken = std::max(sample(end).value - sample(start).value, trapezoid(before, length, at));
  if (taken > debonding_work_max * law_of(bond).work_of_adhesion()) marks |= passes_over;
  return marks;
}

}  // namespace tack
