#include "framework/stepping/integrators/contact_change.hpp"

#include <cmath>

namespace tack {
namespace {

bool equal_sizes(double a, double b) { return std::abs(a - b) <= 1e-12 * b; }

}  // namespace

double contact_change(const VecX& before, const VecX& contact) {
  if (contact.size() == 0 || before.size() == 0) return 0;
  const double now = smooth_contact_change * contact.lpNorm<Eigen::Infinity>();
  const double change = (contact - before).lpNorm<Eigen::Infinity>();
  return change < now ? change / now : (change > 0 ? 1 : 0);
}

double step_ratio(const State& s, double h) {
  if (s.h_before > 0 && equal_sizes(s.h_before, h)) return 1;
  return s.adapts && s.h_before > 0 ? h / s.h_before : 0;
}

ContactImpulse::ContactImpulse(const State& s, double h, double usual_before) {
  if (s.contact.size() == 0 || s.contact_before.size() == 0 || s.h_before == 0) return;
  if (!s.adapts && !equal_sizes(s.h_before, usual_before)) return;
  const double smoothness = 1 - contact_change(s);
  if (smoothness == 0) return;
  shift = -0.5 * h / s.h_before * smoothness * (s.contact - s.contact_before);
  smooth = smoothness * s.contact;
}

void ContactImpulse::add_to_prediction(double h, double weight, double smooth_weight, VecX& x) const {
  if (shift.size() > 0) x += h * h * (weight * shift + (smooth_weight - weight) * smooth);
}

std::string energy_gain_advice(bool contact) {
  return contact ? "surfaces moved by much of the range of contact or adhesion in a step: refine time.step"
                 : "what turns or deforms is too fast for the step: refine time.step";
}

}  // namespace tack
