#include "energies/interactions/spring_term.hpp"

#include <algorithm>
#include <cmath>

#include "framework/core/records.hpp"
#include "geometry/parallel.hpp"

namespace tack {
void SpringTerm::add(Edge vertices, const Spring& spring) {
  vertices_.push_back(vertices);
  springs_.push_back(spring);
  broken_.push_back(0);
}

int SpringTerm::intact() const { return static_cast<int>(std::count(broken_.begin(), broken_.end(), 0)); }

Vec3 SpringTerm::force(const VecX& x) const {
  Vec3 sum = Vec3::Zero();
  for (int s = 0; s < count(); ++s) {
    const Vec3 d = span(s, x);
    const double l = d.norm();
    if (!broken_[s] && l > 0) sum += springs_[s].stiffness * (l - springs_[s].length) / l * d;
  }
  return sum;
}

void SpringTerm::load_history(const History& history) {
  const std::vector<double>* broken = history_values(history, history_, 1, count());
  for (int s = 0; s < count(); ++s) broken_[s] = broken && (*broken)[s] != 0;
}

bool SpringTerm::breaks(int s, const VecX& x) const {
  return !broken_[s] && springs_[s].stiffness * std::abs(span(s, x).norm() - springs_[s].length) > springs_[s].strength;
}

void SpringTerm::commit(const VecX& x, History& history) const {
  HistoryArray& array = history[history_];
  array = {1, {broken_.begin(), broken_.end()}, {}};
  for (int s = 0; s < count(); ++s)
    if (breaks(s, x)) array.values[s] = 1;
}

void SpringTerm::publish(Records& records) const {
  Term::publish(records);
  records.add(FlowRecord{name(), {{"dissipated_plastic"}}, [this](const VecX& x, double* amounts) { amounts[0] = dissipated(x); }});
}

double SpringTerm::dissipated(const VecX& x) const {
  double sum = 0;
  for (int s = 0; s < count(); ++s)
    if (breaks(s, x)) sum += energy(s, x);
  return sum;
}

double SpringTerm::energy(int s, const VecX& x) const {
  if (broken_[s]) return 0;
  return pair(s).energy(span(s, x));
}

double SpringTerm::value(const VecX& x) const {
  return sum_chunks(count(), [&](int first, int last) {
    double sum = 0;
    for (int s = first; s < last; ++s) sum += energy(s, x);
    return sum;
  });
}

void SpringTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  for_each(count(), [&](int s) {
    pair(s).derivatives(span(s, x), projection, gradient + 6 * static_cast<size_t>(s), hessian ? hessian + 27 * static_cast<size_t>(s) : nullptr);
  });
}

bool SpringTerm::residuals(const VecX& x, double* r, double* jacobian) const {
  for (int s = 0; s < count(); ++s) r[s] = pair(s).residual(span(s, x), jacobian ? jacobian + 6 * static_cast<size_t>(s) : nullptr);
  return true;
}

}  // namespace tack
