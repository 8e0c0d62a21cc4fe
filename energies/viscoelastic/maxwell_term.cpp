#include "energies/viscoelastic/maxwell_term.hpp"

namespace tack {

void publish_relaxation(Records& records, const std::string& term, std::function<double(const VecX& x)> dissipated) {
  records.add(FlowRecord{term, {{"dissipated_viscous"}}, [dissipated = std::move(dissipated)](const VecX& x, double* amounts) { amounts[0] = dissipated(x); }});
}

MaxwellTets::MaxwellTets(std::string name, const MaxwellParameters& parameters, const Body& body, const VecX& rest)
    : RelaxingTerm(ViscousHistory<3>(body, parameters.relaxation()), ShiftedTimes(parameters.shift, body, body.tets, rest), std::move(name), parameters.potential(1), body,
                   rest),
      parameters_(parameters), rest_shapes_(rest_) {
  load_history({});
}

void MaxwellTets::apply_history() {
  material_ = parameters_.potential(material_factor());
  for_each(static_cast<int>(rest_.size()), [&](int p) {
    for (int l = 0; l < pack_width; ++l) {
      const int t = std::min(p * pack_width + l, count() - 1);
      set_lane<3, 3>(rest_[p].shape, l, get_lane<3, 3>(rest_shapes_[p].shape, l) * history_.inverse(t));
      rest_[p].volume.set(l, volume_of(t) * volume_factor(t));
    }
  }, chunk_size / pack_width);
}

CompositeMaxwell::CompositeMaxwell(std::string name, const MaxwellParameters& parameters, const Body& body, const VecX& rest)
    : RelaxingTerm(ViscousHistory<3>(body, parameters.relaxation()), ShiftedTimes(parameters.shift, body, composite_tets_of(body.tets), rest), std::move(name),
                   parameters.potential(1), body, rest),
      parameters_(parameters) {
  load_history({});
}

void CompositeMaxwell::apply_history() {
  split_.shape = split_.part = parameters_.potential(material_factor());
  tets_.turn([&](int i) { return history_.inverse(i); });
  if (history_.uniform()) tets_.clear_factors();
  else tets_.set_factors([&](int tet) { return volume_factor(composite_samples * tet); });
}

std::vector<Mat3> CompositeMaxwell::cauchy_stress(const VecX& x) const {
  std::vector<Mat3> stress = CompositeTerm::cauchy_stress(x);
  if (!history_.uniform())
    for (size_t i = 0; i < stress.size(); ++i) stress[i] *= volume_factor(composite_samples * static_cast<int>(i / composite_parts));
  return stress;
}

}  // namespace tack
