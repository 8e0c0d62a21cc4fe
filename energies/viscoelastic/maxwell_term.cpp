#include "energies/viscoelastic/maxwell_term.hpp"

namespace tack {

void publish_relaxation(Records& records, const std::string& term, std::function<double(const VecX& x)> dissipated) {
  records.add(FlowRecord{term, {{"dissipated_viscous"}}, [dissipated = std::move(dissipated)](const VecX& x, double* amounts) { amounts[0] = dissipated(x); }});
}

MaxwellTets::MaxwellTets(std::string name, const MaxwellParameters& parameters, const Body& body, const VecX& rest)
    : RelaxingTerm(ViscousHistory<3>(body, parameters.relaxation()), std::move(name), parameters.potential(1), body, rest), parameters_(parameters), rest_shapes_(rest_) {
  load_history({});
}

void MaxwellTets::apply_history() {
  material_ = parameters_.potential(history_.end_factor());
  for_each(static_cast<int>(rest_.size()), [&](int p) {
    for (int l = 0; l < pack_width; ++l)
      set_lane<3, 3>(rest_[p].shape, l, get_lane<3, 3>(rest_shapes_[p].shape, l) * history_.inverse(std::min(p * pack_width + l, count() - 1)));
  }, chunk_size / pack_width);
}

CompositeMaxwell::CompositeMaxwell(std::string name, const MaxwellParameters& parameters, const Body& body, const VecX& rest)
    : RelaxingTerm(ViscousHistory<3>(body, parameters.relaxation()), std::move(name), parameters.potential(1), body, rest), parameters_(parameters) {
  load_history({});
}

void CompositeMaxwell::apply_history() {
  split_.shape = split_.part = parameters_.potential(history_.end_factor());
  tets_.turn([&](int i) { return history_.inverse(i); });
}

}  // namespace tack
