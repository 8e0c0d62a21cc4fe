#include "framework/assembly/incremental_potential.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/residual_view.hpp"
#include "framework/core/term_gradient.hpp"
#include "framework/core/term_times.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Relative rounding error that a sum of element energies may carry: energies are of second order in
// strains that are themselves small differences of positions.
constexpr double sum_noise = 1e-10;
constexpr int inertia_blocks_per_chunk = 2048;  // 5 to 10 us

std::vector<const Term*>& with_inertia(std::vector<const Term*>& terms, const MixedInertia& inertia) {
  if (!inertia.empty()) terms.push_back(&inertia);
  return terms;
}

}  // namespace

IncrementalPotential::IncrementalPotential(std::vector<const Term*> terms, const DofMap& dofs,
                                           const VecX& mass, PhaseClock& clock,
                                           std::function<void(const VecX&)> on_move)
    : mixed_inertia_(mass, dofs), terms_(std::move(terms)), dofs_(dofs), on_move_(std::move(on_move)), clock_(clock),
      assembler_(with_inertia(terms_, mixed_inertia_), dofs, clock), term_values_(terms_) {
  set_mass(mass);
}

void IncrementalPotential::set_mass(const VecX& mass) {
  settings_.mass = mass;
  free_mass_ = dofs_.own_masses(mass);
  mixed_inertia_.set_mass(mass);
}

void IncrementalPotential::begin_step(const VecX& x_start, const VecX& prediction,
                                      const TermScales& scales, bool inertia) {
  ++moves_;
  x_ = x_start;
  dofs_.update_dependents(x_);
  dofs_.gather(prediction, prediction_);
  dofs_.copy_fixed_directions(x_, prediction_);
  mixed_inertia_.set_prediction(prediction, scales.body, inertia);
  scales_ = scales;
  inertia_ = inertia;
  settings_.prediction = prediction;
  settings_.scales = scales;
  settings_.inertia = inertia;
  block_mass_ = inertia ? free_mass_ : VecX::Zero(free_mass_.size()).eval();
  value_known_ = gradient_known_ = false;
  first_x_.resize(0);
}

void IncrementalPotential::move_to(const VecX& q) {
  ++moves_;
  q_ = q;
  dofs_.copy_fixed_directions(x_, q_);
  dofs_.scatter(q_, x_);
  value_known_ = gradient_known_ = false;
  if (on_move_) on_move_(x_);
}

double IncrementalPotential::inertia_value() const {
  return sum_chunks(dofs_.block_count(), [&](int first, int last) {
    double sum = 0;
    for (int b = first; b < last; ++b)
      sum += block_mass_(b) * (q_.segment<3>(3 * b) - prediction_.segment<3>(3 * b)).squaredNorm();
    return 0.5 * sum;
  });
}

double IncrementalPotential::value_of(const Term& term) const {
  const TermScope scope(clock_.term_times(), &term, Evaluation::value);
  return term.value(x_);
}

double IncrementalPotential::value() {
  if (value_known_) return value_;
  ++value_count_;
  value_ = inertia_ ? inertia_value() : 0.0;
  noise_ = std::abs(value_);
  const bool first = first_x_.size() == 0;
  std::vector<double> values = term_values_.at(x_, clock_.term_times());
  for (size_t t = 0; t < terms_.size(); ++t) {
    const double scaled = scales_.of(*terms_[t]) * values[t];
    value_ += scaled;
    noise_ += std::abs(scaled);
  }
  if (first) first_x_ = x_, first_values_ = std::move(values);
  noise_ *= sum_noise;
  value_known_ = true;
  return value_;
}

double IncrementalPotential::value_noise() const { return noise_; }

double IncrementalPotential::inertial_force(int block) const {
  const double component = (q_.segment<3>(3 * block) - prediction_.segment<3>(3 * block)).lpNorm<Eigen::Infinity>();
  return block_mass_(block) * component / scales_.body;
}

void IncrementalPotential::set_inertia_gradient(VecX& gradient) const {
  gradient.resize(size());
  for_each(dofs_.block_count(), [&](int b) {
    gradient.segment<3>(3 * b) =
        block_mass_(b) * (q_.segment<3>(3 * b) - prediction_.segment<3>(3 * b));
  }, inertia_blocks_per_chunk);
}

const VecX& IncrementalPotential::gradient() {
  if (gradient_known_) return gradient_;
  set_inertia_gradient(gradient_);
  assembler_.add_gradient(x_, scales_, gradient_);
  gradient_known_ = true;
  return gradient_;
}

std::optional<double> IncrementalPotential::first_value(const Term* term, const VecX& x) const {
  const auto found = std::find(terms_.begin(), terms_.end(), term);
  if (found == terms_.end() || first_x_.size() != x.size() || first_x_ != x) return std::nullopt;
  return first_values_[found - terms_.begin()];
}

VecX IncrementalPotential::gradient_at_all_vertices(const VecX& x) {
  if (q_.size() != size() || x_ != x) {
    VecX q;
    dofs_.gather(x, q);
    move_to(q);
  }
  gradient();
  VecX sum = VecX::Zero(x.size());
  assembler_.add_last_gradients(sum);
  return sum;
}

const BlockMatrix& IncrementalPotential::hessian(const HessianRequest& request) {
  set_inertia_gradient(gradient_);
  assembler_.assemble(x_, scales_, request, block_mass_, gradient_, matrix_);
  gradient_known_ = true;
  return matrix_;
}

// Inertia first, then the terms. Inertia of vertices that several unknowns move is a term of its own.
std::vector<ObjectivePart> IncrementalPotential::parts() const {
  std::vector<ObjectivePart> parts = {{"inertia"}};
  for (const Term* term : terms_) parts.push_back({term->name(), term->dynamic(), term->stores()});
  return parts;
}

double IncrementalPotential::part_value(int part) {
  if (part == 0) return inertia_ ? inertia_value() : 0.0;
  return scales_.of(*terms_.at(part - 1)) * value_of(*terms_[part - 1]);
}

VecX IncrementalPotential::part_gradient(int part) {
  if (part == 0) {
    VecX gradient;
    set_inertia_gradient(gradient);
    return gradient;
  }
  const Term& term = *terms_.at(part - 1);
  VecX full = VecX::Zero(x_.size());
  add_term_gradient(term, x_, full);
  return scales_.of(term) * dofs_.to_unknowns(full);
}

LeastSquares IncrementalPotential::least_squares() const {
  std::vector<double> scales;
  for (const Term* term : terms_) scales.push_back(scales_.of(*term));
  return {residual_views(terms_, "the solver"), std::move(scales), dofs_, x_, block_mass_};
}

}  // namespace tack
