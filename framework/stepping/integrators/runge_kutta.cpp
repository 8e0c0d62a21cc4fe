#include "framework/stepping/integrators/runge_kutta.hpp"

namespace tack {
namespace {

double entry(const std::vector<double>& row, size_t j) { return j < row.size() ? row[j] : 0; }

}  // namespace

RungeKutta::RungeKutta(std::vector<double> ends, Matrix rows, std::vector<double> embedded)
    : ends_(std::move(ends)), rows_(std::move(rows)), embedded_(std::move(embedded)) {
  rows_.insert(rows_.begin(), std::vector<double>{});
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
