#include "framework/bond/bond_curve.hpp"

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

constexpr double slow_step = 1e12;  // step size without viscous resistance [s]
constexpr double traction_end = 1e-3;  // of the largest traction: the bond has failed
constexpr double opening_max = 1e4;  // times the work over the peak
constexpr double overshoot = 1.02;  // factor on the final opening, so that the failure lies within the path
constexpr double opening_per_step = 0.01;  // of the work over the peak, in the longest step of an integrated law
constexpr double substep = 0.05;  // of its longest step
constexpr double substeps_max = 500;

double size_of(const BondPoint& p) { return std::hypot(p.traction, p.shear); }

// Returns the order of magnitude of the opening over which a bond fails [m].
double scale_of(const BondLaw& law) { return law.peak_traction() > 0 ? law.work_of_adhesion() / law.peak_traction() : 0; }

}  // namespace

std::vector<BondPoint> trace_bond(const BondLaw& law, const std::vector<BondStep>& path, bool on_contact) {
  std::vector<BondPoint> points;
  std::vector<double> history(law.width());
  law.initialize(on_contact, history.data());
  double time = 0, dissipated = 0;
  double unstressed_opening = 0, unstressed_slip = 0;  // m; healing moves them
  bool gone = false;
  for (const BondStep& step : path) {
    const double slip = step.slip - unstressed_slip, s = slip * slip, h = step.time - time;
    const double d = step.opening - unstressed_opening;
    BondPoint p{step.time, step.opening, step.slip};
    if (gone) {
      p.intensity = 0;
    } else {
      if (law.directed()) {
        DirectedSample sample;
        const Vec3 jump(d, slip, 0);
        law.add_directed_samples(1, &jump, history.data(), h, &sample);
        p.traction = sample.gradient[0];
        p.shear = sample.gradient[1];
      } else {
        const BondSample sample = law.at(d, s, history.data(), h);
        p.traction = sample.by_d;
        p.shear = 2 * sample.by_s * slip;
      }
      BondState at = law.assumed_state(d, s, h, step.pressure);
      at.slip.x() = slip;
      const BondChange change = law.advance(at, history.data());
      const double healed = (1 - change.kept) * std::max(d, 0.0);
      dissipated += change.dissipated;
      gone = change.gone;
      p.intensity = law.intensity_of(history.data());
      at.d = d - healed;
      at.s *= change.kept * change.kept;
      at.slip *= change.kept;
      p.stored = gone ? 0 : law.stored(at, history.data());
      unstressed_opening += healed;
      unstressed_slip += (1 - change.kept) * slip;
    }
    p.dissipated = dissipated;
    time = step.time;
    points.push_back(p);
  }
  return points;
}

std::vector<BondPoint> pull_bond(const BondLaw& law, const std::vector<double>& turns, double angle, int points, double speed) {
  double length = 0, from = 0;
  for (const double turn : turns) length += std::abs(turn - from), from = turn;
  const double longest = law.longest_step(), part = length / points;
  double h = slow_step;
  if (speed > 0) h = part / speed;
  else if (std::isfinite(longest)) h = part * longest / (opening_per_step * scale_of(law));
  const int between = std::isfinite(longest) ? static_cast<int>(std::clamp(std::ceil(h / (substep * longest)), 1.0, substeps_max)) : 1;
  const double sine = std::sin(angle), cosine = std::abs(std::cos(angle)) < 1e-12 ? 0 : std::cos(angle);  // pi/2: slip alone
  std::vector<BondStep> path;
  double time = 0;
  from = 0;
  for (const double turn : turns) {
    const int steps = between * std::max(1, static_cast<int>(std::lround(std::abs(turn - from) / part)));
    for (int i = 1; i <= steps; ++i) {
      const double at = from + (turn - from) * i / steps;
      path.push_back({time += h / between, at * cosine, at * sine});
    }
    from = turn;
  }
  const std::vector<BondPoint> all = trace_bond(law, path);
  std::vector<BondPoint> kept;
  for (size_t i = between - 1; i < all.size(); i += between) kept.push_back(all[i]);
  return kept;
}

std::vector<BondPoint> separate_slowly(const BondLaw& law, double angle, int points) {
  const double scale = scale_of(law);
  if (!(scale > 0) || !std::isfinite(scale)) return {};
  // Widens the path until the traction has risen and gone; for brittle, stiff laws it also narrows
  // it.
  double far = scale;
  for (; far < opening_max * scale; far *= 2) {
    const auto curve = pull_bond(law, {far}, angle, 400);
    double most = 0;
    for (const BondPoint& p : curve) most = std::max(most, size_of(p));
    if (most > 0 && size_of(curve.back()) < traction_end * most) break;
  }
  auto curve = pull_bond(law, {overshoot * far}, angle, points);
  for (const BondPoint& p : curve)
    if (size_of(p) > 0) return curve;
  return {};
}

}  // namespace tack
