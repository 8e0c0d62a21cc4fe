#include "framework/app/derivative_check.hpp"

#include <random>

#include "framework/core/incremental_potential.hpp"

namespace tack {

DerivativeCheck check_derivatives(World& world, PhaseClock& clock) {
  IncrementalPotential potential(world.terms, world.dofs, world.mass, clock, [&](const VecX& x) {
    if (world.contact) world.contact->move_to(x);
  });
  // A scale of 1 weighs energies as they are; the inertia is that of a step of one second.
  potential.begin_step(world.start.x, world.start.x, 1.0, true);
  VecX q;
  world.dofs.gather(world.start.x, q);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> component(-1, 1);
  DerivativeCheck check;
  const double size = world.rest.lpNorm<Eigen::Infinity>();
  const double step = 1e-7 * std::max(size, 1e-3);
  for (int trial = 0; trial < 3; ++trial) {
    const VecX d = VecX::NullaryExpr(q.size(), [&] { return component(random); });
    potential.move_to(q);
    const BlockMatrix& matrix = potential.hessian(SpdFilter::none);
    VecX hd;
    matrix.multiply(d, hd);
    const double slope = potential.gradient().dot(d);
    potential.move_to(q + step * d);
    const double up = potential.value();
    const VecX gradient_up = potential.gradient();
    potential.move_to(q - step * d);
    const double down = potential.value();
    const VecX gradient_down = potential.gradient();
    const double curvature = d.dot(hd);
    const double rounding = 1e-14 * (std::abs(up) + potential.value_noise() * 1e14) / step;
    const double scale = std::abs(slope) + std::abs(curvature) * step + rounding;
    check.gradient_error = std::max(check.gradient_error, std::abs((up - down) / (2 * step) - slope) / scale);
    const VecX differences = (gradient_up - gradient_down) / (2 * step);
    check.hessian_error = std::max(check.hessian_error, (differences - hd).lpNorm<Eigen::Infinity>() /
                                                            hd.lpNorm<Eigen::Infinity>());
  }
  return check;
}

}  // namespace tack
