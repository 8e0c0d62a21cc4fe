#include "energies/plasticity/von_mises_composite.hpp"

#include "energies/plasticity/plastic_records.hpp"

namespace tack {

CompositeVonMises::CompositeVonMises(std::string name, const VonMises& material, const Body& body, const VecX& rest)
    : CompositeTerm(std::move(name), material, body, rest), material_(material), history_(body) {
  load_history({});
}

void CompositeVonMises::load_history(const History& history) {
  set_step(0);
  history_.load_history(history, composite_samples * count());
  tets_.turn([&](int i) { return history_.inverse(i); });
  const size_t all = static_cast<size_t>(composite_samples) * static_cast<size_t>(tets_.packs());
  split_.shape.limits.resize(all);
  split_.part.limits.resize(all);
  for (int at = 0; at < static_cast<int>(all); ++at)
    for (int l = 0; l < pack_width; ++l) {
      const int k = at % composite_samples, tet = std::min(at / composite_samples * pack_width + l, count() - 1);
      (k < composite_points ? split_.shape : split_.part).limits[at].set(l, material_.limit(history_.strain()[composite_samples * tet + k]));
    }
}

void CompositeVonMises::commit(const VecX& x, History& history) const {
  history_.commit(material_, [&](int i) { return tets_.deformation(i, x); }, history);
}

double CompositeVonMises::dissipated(const VecX& x) const {
  return history_.dissipated(material_, [&](int i) { return tets_.deformation(i, x); },
                            [&](int i) { return tets_.volume_of_sample(i); });
}

double CompositeVonMises::viscous(const VecX& x) const {
  return history_.viscous(material_, [&](int i) { return tets_.deformation(i, x); },
                         [&](int i) { return tets_.volume_of_sample(i); });
}

void CompositeVonMises::publish(Records& records) const {
  CompositeTerm::publish(records);
  PlasticFlows flows{[this](const VecX& x) { return dissipated(x); }};
  if (material_.viscosity > 0) flows.viscous = [this](const VecX& x) { return viscous(x); };
  publish_plasticity(records, name(), std::move(flows), [this] { return plastic_strain(); }, &tets_.parts());
}

VecX CompositeVonMises::plastic_strain() const {
  VecX strain(static_cast<Eigen::Index>(tets_.parts().size()));
  for (int t = 0; t < count(); ++t) {
    const double* const points = &history_.strain()[static_cast<size_t>(composite_samples) * t];
    for (int s = 0; s < composite_parts; ++s)
      strain(composite_parts * t + s) = s < composite_points ? points[s] : (points[0] + points[1] + points[2] + points[3]) / 4;
  }
  return strain;
}

}  // namespace tack
