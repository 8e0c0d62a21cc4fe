#include "solvers/path_following/path_equations.hpp"

#include <cmath>

#include "framework/stepping/fixed_vertices.hpp"

namespace tack {
namespace {

// Difference of load times over the step size. The error of a derivative is of second order in it, and
// its rounding error of first order in its inverse: with displacements of 1e-6 of an object's size per step,
// both are below 1e-5.
constexpr double time_difference = 1e-3;

}  // namespace

PathEquations::PathEquations(World& world, const Step& step, double load_time)
    : world_(world), step_(step), start_x_(step.state.x), load_time_(std::nan("")), total_mass_(world.mass.sum()) {
  start_.load_time = load_time;
  world_.dofs.gather(start_x_, start_.q);
  const std::vector<ObjectivePart> parts = step_.potential.parts();
  for (size_t i = 0; i < parts.size(); ++i)
    if (parts[i].dynamic) dynamic_parts_.push_back(static_cast<int>(i));
  move_to(start_);
  start_energy_ = dynamic_energy();
}

VecX PathEquations::configuration(const PathPoint& point) const {
  VecX x = start_x_, q = point.q;
  step_.fixed.set_positions(point.load_time, x);
  world_.dofs.copy_fixed_directions(x, q);
  world_.dofs.scatter(q, x);
  return x;
}

void PathEquations::move_to(const PathPoint& point) {
  if (point.load_time != load_time_) {
    load_time_ = point.load_time;
    VecX x = start_x_;
    step_.fixed.set_positions(load_time_, x);
    world_.load_term.begin_step({start_x_, load_time_, 0});
    step_.potential.begin_step(x, step_.prediction.x, step_.prediction.scales(), false);
  }
  step_.potential.move_to(point.q);
}

double PathEquations::dynamic_energy() {
  double sum = 0;
  for (const int part : dynamic_parts_) sum += step_.potential.part_value(part);
  return sum;
}

double PathEquations::distance(const VecX& x) const {
  double sum = 0;
  for (Eigen::Index v = 0; v < world_.mass.size(); ++v)
    sum += world_.mass(v) * (vertex(x, static_cast<int>(v)) - vertex(start_x_, static_cast<int>(v))).squaredNorm();
  return std::sqrt(sum / total_mass_);
}

double PathEquations::value(PathConstraint constraint, const PathPoint& point) {
  switch (constraint) {
    case PathConstraint::load_time: return point.load_time - start_.load_time;
    case PathConstraint::dissipation: return dynamic_energy() - start_energy_;
    case PathConstraint::arc_length: return distance(configuration(point));
  }
  return 0;
}

PathEquations::Derivatives PathEquations::derivatives(PathConstraint constraint, const PathPoint& point) {
  Derivatives d;
  d.constraint_by_q = VecX::Zero(point.q.size());
  const VecX x = configuration(point);
  VecX weighted;  // derivative of the arc length by all positions
  if (constraint == PathConstraint::dissipation) {
    for (const int part : dynamic_parts_) d.constraint_by_q += step_.potential.part_gradient(part);
  } else if (constraint == PathConstraint::arc_length) {
    weighted = x - start_x_;
    const double scale = total_mass_ * distance(x);
    for (Eigen::Index v = 0; v < world_.mass.size(); ++v) vertex(weighted, static_cast<int>(v)) *= world_.mass(v) / scale;
    VecX full = weighted;
    d.constraint_by_q = world_.dofs.to_unknowns(full);
  }
  const double delta = time_difference * step_.h;
  const PathPoint after{point.q, point.load_time + delta}, before{point.q, point.load_time - delta};
  move_to(after);
  d.gradient_by_time = step_.potential.gradient();
  const double energy = constraint == PathConstraint::dissipation ? dynamic_energy() : 0;
  move_to(before);
  d.gradient_by_time = (d.gradient_by_time - step_.potential.gradient()) / (2 * delta);
  switch (constraint) {
    case PathConstraint::load_time: d.constraint_by_time = 1; break;
    case PathConstraint::dissipation: d.constraint_by_time = (energy - dynamic_energy()) / (2 * delta); break;
    case PathConstraint::arc_length: d.constraint_by_time = weighted.dot(configuration(after) - configuration(before)) / (2 * delta); break;
  }
  return d;
}

}  // namespace tack
