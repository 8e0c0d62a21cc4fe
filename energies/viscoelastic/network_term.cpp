#include "energies/viscoelastic/network_term.hpp"

#include "energies/viscoelastic/relaxing_term.hpp"

namespace tack {

NetworkTets::NetworkTets(std::string name, const NetworkFlow& flow, const TemperatureShift& shift, const Body& body, const VecX& rest)
    : SolidTerm(std::move(name), {flow}, body, rest), history_(body, flow), times_(shift, body, body.tets, rest), rest_shapes_(rest_) {
  load_history({});
}

void NetworkTets::load_history(const History& history) {
  history_.load_history(history, count());
  for_each(static_cast<int>(rest_.size()), [&](int p) {
    for (int l = 0; l < pack_width; ++l)
      set_lane<3, 3>(rest_[p].shape, l, get_lane<3, 3>(rest_shapes_[p].shape, l) * history_.inverse(std::min(p * pack_width + l, count() - 1)));
  }, chunk_size / pack_width);
  material_.log_factors.resize(rest_.size());
  set_log_factors();
}

void NetworkTets::begin_step(const StepStart& start) {
  start_ = start.x;
  // The temperature in the middle of the step.
  history_.begin_step(start.h, times_.at(start.time + start.h / 2));
  set_log_factors();
}

void NetworkTets::set_log_factors() {
  for (size_t p = 0; p < material_.log_factors.size(); ++p)
    for (int l = 0; l < pack_width; ++l) material_.log_factors[p].set(l, history_.log_factor(std::min(static_cast<int>(p) * pack_width + l, count() - 1)));
}

void NetworkTets::commit(const VecX& x, History& history) const {
  history_.commit([&](int t) { return deformation(t, x); }, history);
}

double NetworkTets::dissipated(const VecX& x) const {
  return history_.dissipated([&](int t) { return deformation(t, start_); }, [&](int t) { return deformation(t, x); }, [&](int t) { return rest_of(t).volume; });
}

void NetworkTets::publish(Records& records) const {
  SolidTerm::publish(records);
  publish_relaxation(records, name(), [this](const VecX& x) { return dissipated(x); });
}

CompositeNetwork::CompositeNetwork(std::string name, const NetworkFlow& flow, const TemperatureShift& shift, const Body& body, const VecX& rest)
    : CompositeTerm(std::move(name), BergstromBoyce{flow}, body, rest), history_(body, flow), times_(shift, body, composite_tets_of(body.tets), rest) {
  load_history({});
}

void CompositeNetwork::load_history(const History& history) {
  history_.load_history(history, composite_samples * count());
  tets_.turn([&](int i) { return history_.inverse(i); });
  const size_t all = static_cast<size_t>(composite_samples) * static_cast<size_t>(tets_.packs());
  split_.shape.log_factors.resize(all);
  split_.part.log_factors.resize(all);
  set_log_factors();
}

void CompositeNetwork::begin_step(const StepStart& start) {
  start_ = start.x;
  history_.begin_step(start.h, times_.at(start.time + start.h / 2));
  set_log_factors();
}

void CompositeNetwork::set_log_factors() {
  for (int p = 0; p < tets_.packs(); ++p)
    for (int k = 0; k < composite_samples; ++k)
      for (int l = 0; l < pack_width; ++l)
        (k < composite_points ? split_.shape : split_.part)
            .log_factors[composite_samples * p + k]
            .set(l, history_.log_factor(composite_samples * std::min(p * pack_width + l, count() - 1) + k));
}

void CompositeNetwork::commit(const VecX& x, History& history) const {
  history_.commit([&](int i) { return tets_.deformation(i, x); }, history);
}

double CompositeNetwork::dissipated(const VecX& x) const {
  return history_.dissipated([&](int i) { return tets_.deformation(i, start_); }, [&](int i) { return tets_.deformation(i, x); },
                             [&](int i) { return tets_.volume_of_sample(i); });
}

void CompositeNetwork::publish(Records& records) const {
  CompositeTerm::publish(records);
  publish_relaxation(records, name(), [this](const VecX& x) { return dissipated(x); });
}

}  // namespace tack
