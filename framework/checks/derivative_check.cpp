#include "framework/checks/derivative_check.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include "framework/contact/terms/friction_term.hpp"
#include "framework/world/local_lengths.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {
namespace {

// Distances of the examined states from the start, over the local lengths.
constexpr double distances[] = {3e-2, 1e-3};
constexpr int directions = 2;  // at each
// Largest scale of a term that is zero but for rounding, over that without constraints.
constexpr double rounding_scale = 1e-9;

class RandomDirections {
 public:
  VecX operator()(Eigen::Index n) {
    return VecX::NullaryExpr(n, [this] { return component_(generator_); });
  }

 private:
  std::mt19937 generator_{1};
  std::uniform_real_distribution<double> component_{-1, 1};
};

// Row sums of |H_ij d_j|.
VecX absolute_product(const BlockMatrix& matrix, const VecX& d) {
  VecX sum = VecX::Zero(d.size());
  for (int c = 0; c < matrix.columns(); ++c)
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) {
      const int r = matrix.row[k];
      const Mat3 block = matrix.block(k).cwiseAbs();
      sum.segment<3>(3 * r) += block * d.segment<3>(3 * c).cwiseAbs();
      if (r != c) sum.segment<3>(3 * c) += block.transpose() * d.segment<3>(3 * r).cwiseAbs();
    }
  for (const GlobalMode& mode : matrix.modes)
    sum += std::abs(mode.coefficient) * mode.vector.cwiseAbs().dot(d.cwiseAbs()) * mode.vector.cwiseAbs();
  return sum;
}

// Returns the unknowns less their mean position: terms take differences of positions, whose round-off is that of the distances.
VecX centred(const VecX& q) {
  Vec3 mean = Vec3::Zero();
  for (Eigen::Index i = 0; i < q.size(); i += 3) mean += 3 * q.segment<3>(i) / static_cast<double>(q.size());
  return q - mean.replicate(q.size() / 3, 1);
}

// Returns the Hessian without the multiples of the identity that stand for fixed directions.
BlockMatrix without_fixed_directions(BlockMatrix hessian, const DofMap& dofs) {
  for (const DofMap::PartlyFixedBlock& h : dofs.partly_fixed_blocks())
    for (int k = hessian.column_start[h.block]; k < hessian.column_start[h.block + 1]; ++k) {
      if (hessian.row[k] != h.block) continue;
      const Mat3 free = Mat3::Identity() - h.projection;
      if (hessian.block(k) == h.projection) hessian.block(k).setZero();  // without rounding, where there is nothing else
      else hessian.block(k) = (free * hessian.block(k) * free).eval();
    }
  return hessian;
}

// One term as a function of the unknowns.
class TermStudy {
 public:
  TermStudy(const Term& term, World& world, PhaseClock& clock)
      : potential_(world, clock, {&term}, world.dofs, VecX::Zero(world.mass.size())),
        check_{term.name(), {}, {}} {
    potential_.begin_step(world.start.x, world.start.x, {}, false);
  }

  void examine(const VecX& q, const VecX& direction) {
    potential_.move_to(q);
    const BlockMatrix hessian = without_fixed_directions(potential_.hessian({Projection::none}), potential_.dofs());
    const VecX gradient = potential_.gradient();
    const VecX rows = absolute_product(hessian, direction);
    const VecX gradient_round_off = std::numeric_limits<double>::epsilon() * absolute_product(hessian, centred(q));
    std::vector<VecX> slope_errors, curvature_errors;
    std::vector<VecX> moved, products;
    double step = DifferenceStudy::first_step;
    for (int k = 0; k < DifferenceStudy::steps; ++k, step /= DifferenceStudy::ratio) {
      // The floating-point displacement differs from 2 step d near small gaps and far from the
      // origin.
      const VecX up = q + step * direction, down = q - step * direction;
      moved.push_back(up - down);
      products.emplace_back();
      hessian.multiply(moved.back(), products.back());
    }
    step = DifferenceStudy::first_step;
    for (int k = 0; k < DifferenceStudy::steps; ++k, step /= DifferenceStudy::ratio) {
      potential_.move_to(q + step * direction);
      const double value_up = potential_.value();
      const VecX gradient_up = potential_.gradient();
      potential_.move_to(q - step * direction);
      const double slope = potential_.value() - value_up + gradient.dot(moved[k]);
      slope_errors.push_back(VecX::Constant(1, -slope / (2 * step)));
      curvature_errors.push_back((gradient_up - potential_.gradient() - products[k]) / (2 * step));
    }
    const VecX slope_scale = VecX::Constant(1, gradient.cwiseProduct(direction).norm());
    const VecX slope_round_off = VecX::Constant(1, direction.cwiseAbs().dot(gradient_round_off));
    check_.gradient.merge(study_differences(slope_errors, slope_scale, gradient_tolerance, slope_round_off));
    // In units of energy, so that rows of different local lengths are comparable.
    const VecX unit = direction.cwiseAbs();
    for (VecX& e : curvature_errors) e = e.cwiseProduct(unit);
    check_.hessian.merge(study_differences(curvature_errors, rows.cwiseProduct(unit), hessian_tolerance));
  }

  const DerivativeCheck& check() const { return check_; }

 private:
  StepPotential potential_;
  DerivativeCheck check_;
};

// Returns the largest row of |H_ij d_i d_j| [J] at the start over all vertices that move, as if
// constraints tied none of them to others. lengths: of all vertices (3n).
double unconstrained_scale(const Term& term, World& world, PhaseClock& clock, const VecX& lengths) {
  std::vector<char> movable(static_cast<size_t>(world.dofs.vertex_count()));
  for (int v = 0; v < world.dofs.vertex_count(); ++v) movable[static_cast<size_t>(v)] = world.dofs.moves(v);
  const DofMap all(movable);
  StepPotential potential(world, clock, {&term}, all, VecX::Zero(world.mass.size()));
  potential.begin_step(world.start.x, world.start.x, {}, false);
  VecX q, unit;
  all.gather(world.start.x, q);
  all.gather(lengths, unit);
  potential.move_to(q);
  const VecX rows = absolute_product(potential.hessian({Projection::none}), unit).cwiseProduct(unit);
  return rows.size() > 0 ? rows.maxCoeff() : 0;
}

void keep_worst(std::vector<DerivativeCheck>& checks, const DerivativeCheck& check) {
  const auto same = std::find_if(checks.begin(), checks.end(),
                                 [&](const DerivativeCheck& c) { return c.term == check.term; });
  if (same == checks.end()) return checks.push_back(check);
  same->gradient.merge(check.gradient);
  same->hessian.merge(check.hessian);
}

}  // namespace

std::vector<DerivativeCheck> check_derivatives(World& world, double h, PhaseClock& clock) {
  const VecX& start = world.start.x;
  world.participants.load_history(world.start.history);
  world.participants.begin_step({start, world.start.time, h});
  const VecX lengths = local_lengths(world, start);
  VecX all(start.size()), q, unit;
  for (Eigen::Index v = 0; v < lengths.size(); ++v) vertex(all, static_cast<int>(v)).setConstant(lengths(v));
  world.dofs.gather(start, q);
  world.dofs.gather(all, unit);
  const auto free_direction = [&](RandomDirections& random) {
    VecX d = unit.cwiseProduct(random(q.size()));
    world.dofs.copy_fixed_directions(VecX::Zero(start.size()), d);
    return d;
  };
  std::vector<DerivativeCheck> checks;
  for (const Term* term : world.terms) {
    TermStudy study(*term, world, clock);
    RandomDirections random;
    for (const double distance : distances) {
      const VecX state = q + distance * free_direction(random);
      for (int i = 0; i < directions; ++i) study.examine(state, free_direction(random));
    }
    DerivativeCheck check = study.check();
    // Constraints may leave a term none of its motions, as a slider leaves an affine body no strain:
    // it is zero but for rounding.
    if (check.wrong() && !world.dofs.plain() && check.hessian.scale < rounding_scale * unconstrained_scale(*term, world, clock, all))
      check = {term->name(), {}, {}};
    keep_worst(checks, check);
  }
  return checks;
}

}  // namespace tack
