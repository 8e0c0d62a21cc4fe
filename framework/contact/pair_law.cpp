#include "framework/contact/pair_law.hpp"

#include <algorithm>
#include <cmath>

namespace tack {

double PairLaw::range() const {
  double range = 0;
  for (const auto& law : laws_) range = std::max(range, law->range());
  return range;
}

void PairLaw::samples(int n, const double* d, LawSample* out) const {
  std::fill(out, out + n, LawSample{});
  for (const auto& law : laws_) law->add_samples(n, d, out);
}

void PairLaw::values(int n, const double* d, double* out) const {
  std::fill(out, out + n, 0.0);
  for (const auto& law : laws_) law->add_values(n, d, out);
}

LawSample PairLaw::at(double d) const {
  LawSample sample;
  samples(1, &d, &sample);
  return sample;
}

PairLaw::Well PairLaw::well() const {
  // A scan on a logarithmic grid brackets the lowest point; golden section refines it.
  constexpr int points = 2000;
  constexpr double smallest = 1e-6;  // of the range
  const double end = range();
  const auto gap = [&](double u) { return end * std::pow(smallest, 1 - u); };
  const auto phi = [&](double u) { return at(gap(u)).value; };
  int best = points;
  for (int i = 0; i < points; ++i)
    if (phi(i / double(points)) < phi(best / double(points))) best = i;
  if (best == points) return {};
  double a = std::max(best - 1, 0) / double(points), b = (best + 1) / double(points);
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 80; ++i) {
    const double c = b - ratio * (b - a), d = a + ratio * (b - a);
    (phi(c) < phi(d) ? b : a) = phi(c) < phi(d) ? d : c;
  }
  const double u = (a + b) / 2;
  return {std::max(0.0, -phi(u)), gap(u)};
}

}  // namespace tack
