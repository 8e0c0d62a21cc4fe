#include "framework/scene/derivative_check.hpp"

#include <algorithm>
#include <random>

#include "framework/contact/friction_term.hpp"
#include "framework/core/incremental_potential.hpp"

namespace tack {
namespace {

class RandomDirections {
 public:
  VecX operator()(Eigen::Index n) {
    return VecX::NullaryExpr(n, [this] { return component_(generator_); });
  }

 private:
  std::mt19937 generator_{1};
  std::uniform_real_distribution<double> component_{-1, 1};
};

DerivativeCheck check_term(const Term& term, World& world, const VecX& q, double step, PhaseClock& clock) {
  IncrementalPotential potential({&term}, world.dofs, VecX::Zero(world.mass.size()), clock, [&](const VecX& x) {
    if (world.contact) world.contact->move_to(x);
  });
  potential.begin_step(world.start.x, world.start.x, {}, false);
  RandomDirections random;
  DerivativeCheck check{term.name()};
  for (int trial = 0; trial < 3; ++trial) {
    const VecX d = random(q.size());
    potential.move_to(q);
    VecX hd;
    potential.hessian(SpdFilter::none).multiply(d, hd);
    const VecX gradient = potential.gradient();
    potential.move_to(q + step * d);
    const double up = potential.value(), noise = potential.value_noise();
    const VecX gradient_up = potential.gradient();
    potential.move_to(q - step * d);
    const VecX differences = (gradient_up - potential.gradient()) / (2 * step);
    const double slope = gradient.dot(d), slope_error = (up - potential.value()) / (2 * step) - slope;
    // What the differences themselves cannot tell: rounding, and the curvature's part in the slope.
    const double scale = std::abs(slope) + std::abs(d.dot(hd)) * step + noise / step;
    const double rounding = 1e-10 * gradient_up.lpNorm<Eigen::Infinity>() / step;
    const double curvature = std::max(hd.lpNorm<Eigen::Infinity>(), differences.lpNorm<Eigen::Infinity>());
    if (scale > 0) check.gradient_error = std::max(check.gradient_error, std::abs(slope_error) / scale);
    if (curvature > 0)
      check.hessian_error = std::max(
          check.hessian_error, (differences - hd).lpNorm<Eigen::Infinity>() / (curvature + rounding));
  }
  return check;
}

}  // namespace

std::vector<DerivativeCheck> check_derivatives(World& world, double h, PhaseClock& clock) {
  const VecX& start = world.start.x;
  double amplitude = 1e-4 * std::max(world.rest.lpNorm<Eigen::Infinity>(), 1e-3);
  if (world.contact) {
    world.contact->begin_step(start);
    world.contact->move_to(start);
    amplitude = std::min(amplitude, 0.01 * world.contact->smallest_distance(start));
    if (world.friction) world.friction->begin_step(start, h);
  }
  VecX q;
  world.dofs.gather(start, q);
  q += amplitude * RandomDirections()(q.size());
  std::vector<DerivativeCheck> checks;
  for (const Term* term : world.terms) {
    const DerivativeCheck check = check_term(*term, world, q, 1e-3 * amplitude, clock);
    const auto same = std::find_if(checks.begin(), checks.end(),
                                   [&](const DerivativeCheck& c) { return c.term == check.term; });
    if (same == checks.end()) {
      checks.push_back(check);
    } else {
      same->gradient_error = std::max(same->gradient_error, check.gradient_error);
      same->hessian_error = std::max(same->hessian_error, check.hessian_error);
    }
  }
  return checks;
}

}  // namespace tack
