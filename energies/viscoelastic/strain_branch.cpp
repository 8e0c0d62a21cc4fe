#include "energies/viscoelastic/strain_branch.hpp"

#include <cmath>

#include "energies/viscoelastic/relaxing_term.hpp"

namespace tack {
namespace {

// Factors a and b of a step h (strain_branch.hpp).
double end_factor(double h, double time) { return -std::expm1(-h / time) * time / h; }
double start_factor(double h, double time) { return std::exp(-h / time) / end_factor(h, time); }

}  // namespace

StrainBranch::StrainBranch(std::string name, std::string history_name, std::unique_ptr<Term> spring, double time, ShiftedTimes times)
    : Term(std::move(name)), history_name_(std::move(history_name)), term_(std::move(spring)), spring_(dynamic_cast<StrainSpring&>(*term_)), time_(time),
      times_(std::move(times)), unstrained_(spring_.rest_strains()), committed_(unstrained_) {
  for (const StencilBatch& b : term_->batches()) {
    gradient_slots_ += 3 * static_cast<size_t>(b.arity) * b.count;
    hessian_slots_ += 9 * static_cast<size_t>(hessian_blocks(b.arity)) * b.count;
  }
}

void StrainBranch::load_history(const History& history) {
  term_->load_history(history);
  const std::vector<double>* values = history_values(history, history_name_, 1, static_cast<int>(unstrained_.size()));
  committed_ = values ? VecX(Eigen::Map<const VecX>(values->data(), unstrained_.size())) : unstrained_;
  spring_.set_rest_strains(committed_);
  h_ = 0;
  factor_ = 1;
}

void StrainBranch::begin_step(const StepStart& start) {
  term_->begin_step(start);
  h_ = start.h;
  if (h_ == 0) {
    factor_ = 1;
    return spring_.set_rest_strains(committed_);
  }
  const std::vector<double> shifts = times_.at(start.time + h_ / 2);
  shift_ = shifts.empty() ? 1 : shifts.front();
  first_ = spring_.spring_strains(start.x) - committed_;
  factor_ = end_factor(h_, time());
  spring_.set_rest_strains(committed_ + (1 - start_factor(h_, time())) * first_);
}

void StrainBranch::commit(const VecX& x, History& history) const {
  term_->commit(x, history);
  const VecX rest = spring_.rest_strains();
  const VecX next = rest + (1 - factor_) * (spring_.spring_strains(x) - rest);
  history[history_name_] = {1, {next.begin(), next.end()}, {}};
}

void StrainBranch::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  term_->derivatives(x, projection, gradient, hessian);
  for (size_t i = 0; i < gradient_slots_; ++i) gradient[i] *= factor_;
  for (size_t i = 0; hessian && i < hessian_slots_; ++i) hessian[i] *= factor_;
}

void StrainBranch::publish(Records& records) const {
  Term::publish(records);
  publish_relaxation(records, name(), [this](const VecX& x) { return dissipated(x); });
}

// As Relaxation::dissipated: the integral of 2 psi(e) / time along e = steady + (first - steady) exp(-t / time).
double StrainBranch::dissipated(const VecX& x) const {
  if (h_ == 0) return 0;
  const double steps = h_ / time();
  const VecX trial = spring_.spring_strains(x) - spring_.rest_strains();
  const VecX steady = (trial - start_factor(h_, time()) * first_) / steps, rest = first_ - steady;
  const double of_steady = spring_.energy_of(steady), of_rest = spring_.energy_of(rest), mixed = (spring_.energy_of(steady + rest) - of_steady - of_rest) / 2;
  return 2 * (steps * of_steady - 2 * std::expm1(-steps) * mixed - std::expm1(-2 * steps) / 2 * of_rest);
}

}  // namespace tack
