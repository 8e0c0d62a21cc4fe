#include "energies/viscoelastic/maxwell_term.hpp"

namespace tack {

void publish_relaxation(Records& records, const std::string& term, std::function<double(const VecX& x)> dissipated) {
  records.add(FlowRecord{term, {{"dissipated_viscous"}}, [dissipated = std::move(dissipated)](const VecX& x, double* amounts) { amounts[0] = dissipated(x); }});
}

MaxwellTets::MaxwellTets(std::string name, const MaxwellParameters& parameters, const Body& body, const VecX& rest)
    : SolidTerm(std::move(name), parameters.potential(1), body, rest), parameters_(parameters), history_(body, parameters.relaxation()), rest_shapes_(rest_) {
  load_history({});
}

void MaxwellTets::load_history(const History& history) {
  history_.load_history(history, count());
  apply_history();
}

void MaxwellTets::begin_step(const StepStart& start) {
  history_.rewind();
  apply_history();
  if (start.h == 0) return;
  history_.begin_step(start.h, [&](int t) { return strain(t, start.x); });
  apply_history();
}

void MaxwellTets::apply_history() {
  material_ = parameters_.potential(history_.end_factor());
  for_each(static_cast<int>(rest_.size()), [&](int p) {
    for (int l = 0; l < pack_width; ++l)
      set_lane<3, 3>(rest_[p].shape, l, get_lane<3, 3>(rest_shapes_[p].shape, l) * history_.inverse(std::min(p * pack_width + l, count() - 1)));
  }, chunk_size / pack_width);
}

void MaxwellTets::commit(const VecX& x, History& history) const {
  history_.commit([&](int t) { return strain(t, x); }, history);
}

double MaxwellTets::dissipated(const VecX& x) const {
  return history_.dissipated([&](int t) { return strain(t, x); }, [&](int t) { return rest_of(t).volume; });
}

void MaxwellTets::publish(Records& records) const {
  SolidTerm::publish(records);
  publish_relaxation(records, name(), [this](const VecX& x) { return dissipated(x); });
}

// Kirchhoff's stress per det F: that of the elastic part has det F_e.
StressRecord MaxwellTets::stress_record() const {
  return StressRecord{[this](const VecX& x) {
    std::vector<Mat3> all = cauchy_stress(x);
    for (int t = 0; t < count(); ++t) all[t] *= history_.inverse(t).determinant();
    return all;
  }};
}

CompositeMaxwell::CompositeMaxwell(std::string name, const MaxwellParameters& parameters, const Body& body, const VecX& rest)
    : CompositeTerm(std::move(name), parameters.potential(1), body, rest), parameters_(parameters), history_(body, parameters.relaxation()) {
  load_history({});
}

void CompositeMaxwell::load_history(const History& history) {
  history_.load_history(history, composite_samples * count());
  apply_history();
}

void CompositeMaxwell::begin_step(const StepStart& start) {
  history_.rewind();
  apply_history();
  if (start.h == 0) return;
  history_.begin_step(start.h, [&](int i) { return strain(i, start.x); });
  apply_history();
}

void CompositeMaxwell::apply_history() {
  split_.shape = split_.part = parameters_.potential(history_.end_factor());
  tets_.turn([&](int i) { return history_.inverse(i); });
}

void CompositeMaxwell::commit(const VecX& x, History& history) const {
  history_.commit([&](int i) { return strain(i, x); }, history);
}

double CompositeMaxwell::dissipated(const VecX& x) const {
  return history_.dissipated([&](int i) { return strain(i, x); }, [&](int i) { return volume_of(i); });
}

void CompositeMaxwell::publish(Records& records) const {
  CompositeTerm::publish(records);
  publish_relaxation(records, name(), [this](const VecX& x) { return dissipated(x); });
}

}  // namespace tack
