#include "energies/solid/composite_von_mises.hpp"

#include "energies/plasticity/plastic_records.hpp"

namespace tack {

CompositeVonMises::CompositeVonMises(std::string name, const VonMises& material, const Body& body, const VecX& rest)
    : CompositeTerm(std::move(name), material, body, rest), material_(material), memory_(body) {
  remember({});
}

void CompositeVonMises::remember(const History& history) {
  const int n = count();
  memory_.remember(history, composite_samples * n);
  const size_t all = static_cast<size_t>(composite_samples) * static_cast<size_t>(packs());
  turned_.resize(all);
  split_.shape.limits.resize(all);
  split_.part.limits.resize(all);
  for (int p = 0; p < packs(); ++p)
    for (int k = 0; k < composite_samples; ++k)
      for (int l = 0; l < pack_width; ++l) {
        const int sample = composite_samples * std::min(p * pack_width + l, n - 1) + k, at = composite_samples * p + k;
        set_lane<3, 3>(turned_[at], l, get_lane<3, 3>(shape_[p], l) * memory_.inverse(sample));
        (k < composite_points ? split_.shape : split_.part).limits[at].set(l, material_.limit(memory_.strain()[sample]));
      }
}

void CompositeVonMises::commit(const VecX& x, History& history) const {
  memory_.commit(material_, [&](int i) { return deformation(i / composite_samples, i % composite_samples, x); }, history);
}

double CompositeVonMises::dissipated(const VecX& x) const {
  return memory_.dissipated(
      material_, [&](int i) { return deformation(i / composite_samples, i % composite_samples, x); },
      [&](int i) { return weight(i % composite_samples) * volume(i / composite_samples); });
}

void CompositeVonMises::publish(Records& records) const {
  CompositeTerm::publish(records);
  publish_plasticity(records, name(), [this](const VecX& x) { return dissipated(x); }, [this] { return plastic_strain(); }, &parts_);
}

VecX CompositeVonMises::plastic_strain() const {
  VecX strain(static_cast<Eigen::Index>(parts_.size()));
  for (int t = 0; t < count(); ++t) {
    const double* const points = &memory_.strain()[static_cast<size_t>(composite_samples) * t];
    for (int s = 0; s < composite_parts; ++s)
      strain(composite_parts * t + s) = s < composite_points ? points[s] : (points[0] + points[1] + points[2] + points[3]) / 4;
  }
  return strain;
}

}  // namespace tack
