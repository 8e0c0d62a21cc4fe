#include "framework/stepping/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/stepping/free_bodies.hpp"
#include "geometry/parallel.hpp"

namespace tack {

namespace {

// Returns the mass of each block for the criterion [kg]: its own; for a block without inertia, the
// smallest mass of the others; if no block has mass, the smallest mass in `moved`.
VecX criterion_masses(VecX mass, const VecX& moved) {
  double lightest = std::numeric_limits<double>::infinity();
  for (const double m : mass)
    if (m > 0) lightest = std::min(lightest, m);
  if (!std::isfinite(lightest))
    for (const double m : moved)
      if (m > 0) lightest = std::min(lightest, m);
  for (double& m : mass)
    if (m == 0) m = std::isfinite(lightest) ? lightest : 1;
  return mass;
}

}  // namespace

Convergence::Convergence(const World& world, const Minimizer& solver, double whole_step)
    : world_(world), solver_(solver), whole_step_(whole_step), rounding_(rounding_forces(world)) {}

// Calls body(vertex) for each vertex that depends on several blocks.
template <class Body>
void Convergence::for_each_mixed(const Body& body) const {
  for (const int v : world_.dofs.dependents())
    if (world_.dofs.mixed(v)) body(v);
}

void Convergence::begin_step(const IncrementalPotential& potential, double h, bool inertia) {
  potential_ = &potential;
  h_ = h;
  inertia_ = inertia;
  force_residual_ = {};
  if (!unknowns_known_) set_unknowns(potential);
  groups_.begin_step(world_);
}

void Convergence::set_unknowns(const IncrementalPotential& potential) {
  unknowns_known_ = true;
  const DofMap& dofs = world_.dofs;
  mass_ = criterion_masses(dofs.own_masses(world_.mass), dofs.block_masses(world_.mass));
  groups_.begin_unknowns(world_, potential, rounding_);
  // With e = H^-1 r and M >= diag(mass): |w . e|^2 <= sum_b w_b^2 / m_b times r . M^-1 r.
  smallest_mass_ = mass_.size() > 0 ? mass_.minCoeff() : 0;
  for_each_mixed([&](int v) {
    double sum = 0;
    for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) sum += entry.weight * entry.weight / mass_(entry.index);
    smallest_mass_ = std::min(smallest_mass_, 1 / sum);
  });
}

// Returns the largest displacement of any vertex under the direction p [m].
double Convergence::largest_displacement(const VecX& p) const {
  double largest = p.lpNorm<Eigen::Infinity>();
  for_each_mixed([&](int v) {
    Vec3 displacement = Vec3::Zero();
    for (const DofMap::WeightedIndex& entry : world_.dofs.blocks(v)) displacement += entry.weight * p.segment<3>(3 * entry.index);
    largest = std::max(largest, displacement.lpNorm<Eigen::Infinity>());
  });
  return largest;
}

double Convergence::norm(const VecX& p, const VecX& gradient) {
  if (stopping() == Stopping::velocity) return largest_displacement(p) / h_ / solver_.velocity_tolerance();
  if (stopping() == Stopping::acceleration) {
    double largest = 0;
    for (Eigen::Index b = 0; b < mass_.size(); ++b)
      largest = std::max(largest, gradient.segment<3>(3 * b).lpNorm<Eigen::Infinity>() / mass_(b));
    return largest / potential_->scale() / solver_.acceleration_tolerance();
  }
  const ForceResidual worst = worst_residual(gradient);
  if (!inertia_ && !groups_.all_supported()) check_free_bodies(world_, groups_, potential_->configuration(), gradient / potential_->scale());
  return worst.residual == 0 ? 0 : worst.residual / worst.limit;
}

double Convergence::force_limit(int block) const {
  const auto floor = solver_.force_floor();
  const double rounding = groups_.rounding(block);  // nothing reduces a residual below it, whatever floor the scene gives
  if (stopping() == Stopping::force) return solver_.force_tolerance() * groups_.stencil_force(block) + std::max(rounding, floor.value_or(0));
  const double velocity_noise = inertia_ ? groups_.largest_mass(block) * solver_.velocity_tolerance() / whole_step_ : 0;
  return solver_.balance_tolerance() * groups_.reference_force(block) + std::max(rounding, floor.value_or(velocity_noise));
}

Convergence::ForceResidual Convergence::worst_residual(const VecX& gradient) {
  groups_.measure(*potential_);
  const auto at = [&](int b) { return ForceResidual{gradient.segment<3>(3 * b).lpNorm<Eigen::Infinity>() / potential_->scale(), force_limit(b)}; };
  const auto worse = [](const ForceResidual& a, const ForceResidual& b) { return a.residual * b.limit > b.residual * a.limit; };
  worst_of_chunk_.resize(chunk_count(groups_.blocks()));
  for_each_chunk(groups_.blocks(), [&](int c, int first, int last) {
    ForceResidual worst = at(first);
    for (int b = first + 1; b < last; ++b)
      if (const ForceResidual own = at(b); worse(own, worst)) worst = own;
    worst_of_chunk_[c] = worst;
  });
  if (worst_of_chunk_.empty()) return {};
  ForceResidual worst = worst_of_chunk_[0];
  for (const ForceResidual& of_chunk : worst_of_chunk_)
    if (worse(of_chunk, worst)) worst = of_chunk;
  return worst;
}

double Convergence::direction_error(const VecX& r) const {
  double sum = 0;
  for (Eigen::Index b = 0; b < mass_.size(); ++b) sum += r.segment<3>(3 * b).squaredNorm() / mass_(b);
  return std::sqrt(sum / smallest_mass_) / h_ / solver_.velocity_tolerance();
}

double Convergence::imbalance(const VecX& gradient) {
  force_residual_ = worst_residual(gradient);
  if (stopping() == Stopping::force || force_residual_.residual == 0) return 0;
  return force_residual_.residual / force_residual_.limit;
}

void Convergence::set_criteria(MinimizerProblem& problem) {
  problem.stopping_norm = [this](const VecX& p, const VecX& g) { return norm(p, g); };
  problem.norm_of_direction = stopping() == Stopping::velocity;
  problem.direction_error = [this](const VecX& r) { return direction_error(r); };
  problem.force_residual = [this](const VecX& g) { return imbalance(g); };
}

}  // namespace tack
