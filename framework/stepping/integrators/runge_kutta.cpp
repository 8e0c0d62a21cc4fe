#include "framework/stepping/integrators/runge_kutta.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numeric>

#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double tableau_round_off = 1e-9;  // of sums of entries and of amplification factors; digits that publications give

double entry(const std::vector<double>& row, size_t j) { return j < row.size() ? row[j] : 0; }

double sum(const std::vector<double>& row) { return std::accumulate(row.begin(), row.end(), 0.0); }

// Returns the amplification of y' = i omega y in a step, |y| after it over that before. theta: omega h.
double amplification(const std::vector<std::vector<double>>& rows, double theta) {
  std::vector<std::complex<double>> nodes;
  for (const std::vector<double>& row : rows) {
    std::complex<double> known = 1;
    for (size_t j = 0; j < nodes.size(); ++j) known += std::complex<double>(0, theta * row[j]) * nodes[j];
    nodes.push_back(known / std::complex<double>(1, nodes.empty() ? 0 : -theta * row.back()));
  }
  return std::abs(nodes.back());
}

void refuse_tableau(bool refused, const std::string& fault) {
  if (refused) throw InputError("Runge-Kutta tableau: " + fault);
}

}  // namespace

// rows_[0] is the start of the step.
void RungeKutta::check_tableau() const {
  refuse_tableau(ends_.empty() || ends_.size() + 1 != rows_.size(), "expects a row per stage");
  for (size_t i = 1; i < rows_.size(); ++i) {
    const std::vector<double>& row = rows_[i];
    refuse_tableau(!(length_fraction(i) > 0), "ends of stages must be positive and ascend");
    refuse_tableau(row.size() != i + 1, fmt::format("row {} has {} entries instead of {}, from column 0, the start of the step, to its own stage", i, row.size(), i + 1));
    refuse_tableau(!(row.back() > 0), fmt::format("the diagonal of row {} must be positive: each stage is a minimisation", i));
    refuse_tableau(!(std::abs(sum(row) - ends_[i - 1]) <= tableau_round_off), fmt::format("row {} adds up to {}, and its stage ends at {} of the step", i, sum(row), ends_[i - 1]));
  }
  refuse_tableau(ends_.back() != 1, "the last stage must end at 1");
  refuse_tableau(!embedded_.empty() && (embedded_.size() != rows_.size() || !(std::abs(sum(embedded_) - 1) <= tableau_round_off)),
                 fmt::format("embedded weights must be {} numbers that add up to 1", rows_.size()));
  double largest = 0, at = 0;
  for (double decades = -2; decades <= 4; decades += 1.0 / 32)
    if (const double theta = std::pow(10, decades), factor = amplification(rows_, theta); !(factor <= largest)) largest = factor, at = theta;
  refuse_tableau(!(largest <= 1 + tableau_round_off), fmt::format("the method is not A-stable: an oscillation of omega h = {:.3g} grows by a factor of {:.4g} per step", at, largest));
}

void RungeKutta::set_tableau(std::vector<double> ends, Matrix rows, std::vector<double> embedded) {
  ends_ = std::move(ends);
  rows_ = std::move(rows);
  embedded_ = std::move(embedded);
  rows_.insert(rows_.begin(), std::vector<double>{});
  check_tableau();
  squares_.clear();
  for (const std::vector<double>& row : rows_) {
    std::vector<double> square(row.size());
    for (size_t k = 0; k < row.size(); ++k)
      for (size_t j = 0; j < rows_[k].size(); ++j) square[j] += row[k] * rows_[k][j];
    squares_.push_back(std::move(square));
  }
  // The position after a step of a force linear in time misses (sum_j (A A)_sj c_j - 1/6) h^3 x'''.
  double third = 0;
  for (size_t j = 1; j < rows_.size(); ++j) third += squares_.back()[j] * ends_[j - 1];
  error_constant_ = (third - 1.0 / 6) / third;
}

// Returns the weight of b_j in x_i - x_{i-1} - H v_{i-1}, over h^2.
double RungeKutta::position_weight(size_t node, size_t j) const {
  return squares_[node][j] - entry(squares_[node - 1], j) - length_fraction(node) * entry(rows_[node - 1], j);
}

double RungeKutta::smooth_weight(size_t node) const {
  double sum = 0;
  for (size_t j = 0; j <= node; ++j) sum += position_weight(node, j);
  return sum / (length_fraction(node) * length_fraction(node));
}

double RungeKutta::length_fraction(size_t node) const { return ends_[node - 1] - (node > 1 ? ends_[node - 2] : 0); }

ContactImpulse RungeKutta::contact_impulse(const StepStage& stage) const {
  const size_t node = stage.index() + 1, before = node > 1 ? node - 1 : ends_.size();
  return {stage.state, stage.h, node > 1 ? stage.state.h_before : stage.step * length_fraction(before)};
}

StageEnd RungeKutta::without_unknowns(const StepStage& stage) const {
  const State& s = stage.state;
  const size_t node = stage.index() + 1;
  const double h = stage.step, H = stage.h;
  StageEnd end{s.x + H * s.v, s.v, {}, {}};
  for (size_t j = 0; j < node; ++j) {
    const double of_x = position_weight(node, j);
    const double of_v = rows_[node][j] - entry(rows_[node - 1], j);
    if (of_x == 0 && of_v == 0) continue;
    const VecX b = j == 0 ? without_contact(stage.start.a, stage.start.contact) : without_contact(stage.ends[j - 1].a, stage.ends[j - 1].contact);
    end.x += h * h * of_x * b;
    end.v += h * of_v * b;
  }
  const ContactImpulse impulse = contact_impulse(stage);
  impulse.add_to_prediction(H, contact_weight(node), smooth_weight(node), end.x);
  if (impulse.shift.size() > 0) end.v += H * impulse.shift;
  return end;
}

TimeIntegrator::Prediction RungeKutta::predict(const StepStage& stage) const {
  const double implicit = diagonal(stage) * stage.step;
  return {without_unknowns(stage).x, implicit * implicit, contact_weight(stage.index() + 1) * stage.h * stage.h, true, stage.h};
}

void RungeKutta::update(const StepStage& stage, const VecX& x, const VecX& contact, VecX& v, VecX& a) const {
  const StageEnd known = without_unknowns(stage);
  const double implicit = diagonal(stage) * stage.step;
  a = x - known.x;
  if (contact.size() > 0) a -= contact_weight(stage.index() + 1) * stage.h * stage.h * contact;
  v = known.v + a / implicit;
  a /= implicit * implicit;
  if (contact.size() == 0) return;
  a += contact;
  v += stage.h * contact;
}

EndVelocity RungeKutta::end_velocity(const StepStage& stage) const {
  const StageEnd known = without_unknowns(stage);
  const double implicit = diagonal(stage) * stage.step, H = stage.h;
  EndVelocity end{1 / implicit, known.x - implicit * known.v};
  // The impulse of lasting contact, which changes the velocity by another factor of its displacement.
  const ContactImpulse impulse = contact_impulse(stage);
  if (impulse.smooth.size() > 0) end.still -= (implicit * H - contact_weight(stage.index() + 1) * H * H) * impulse.smooth;
  return end;
}

TimeIntegrator::LocalError RungeKutta::local_error(const StepStage& stage, const VecX& x, const VecX& contact) const {
  const State& start = stage.start;
  const double h = stage.step;
  if (embedded_.empty()) return {error_constant_ * (x - start.x - h * start.v - h * h / 2 * start.a), 3};
  VecX v, a;
  update(stage, x, contact, v, a);
  const std::vector<double>& weights = rows_.back();
  VecX error = h * (weights[0] - embedded_[0]) * start.v + h * (weights.back() - embedded_.back()) * v;
  for (size_t i = 0; i < stage.ends.size(); ++i) error += h * (weights[i + 1] - embedded_[i + 1]) * stage.ends[i].v;
  return {std::move(error), 3};
}

std::string RungeKutta::energy_advice(bool gain, bool contact) const {
  if (gain) return energy_gain_advice(contact);
  return contact ? short_contact_advice
                 : std::string(type()) + " damps what is fast for its steps: refine time.step, or time.integrator: newmark";
}

}  // namespace tack
