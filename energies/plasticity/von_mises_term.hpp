// Term of tets with plastic flow, each with its own flow.
#pragma once

#include "energies/plasticity/plastic_history.hpp"
#include "energies/plasticity/plastic_records.hpp"
#include "energies/solid/solid_term.hpp"

namespace tack {

// Base: SolidTerm<VonMises>, or an equivalent term with pressures of patches.
template <class Base>
class VonMisesTerm : public Base {
 public:
  template <class... Args>
  explicit VonMisesTerm(const Body& body, Args&&... args)
      : Base(std::forward<Args>(args)...),
        body_(body.elements == Elements::linear ? body.name : ""), history_(body),
        rest_shapes_(rest_) {
    load_history({});
  }

  // The yield surface and Fp are lagged: F Fp^-1 = edges (edges_rest^-1 Fp^-1).
  void load_history(const History& history) override {
    const int n = count();
    material_.h = 0;
    history_.load_history(history, n);
    rest_ = rest_shapes_;
    material_.limits.resize(rest_.size());
    for (size_t p = 0; p < rest_.size(); ++p)
      for (int l = 0; l < pack_width; ++l) {
        const int t = std::min(static_cast<int>(p) * pack_width + l, n - 1);
        set_lane<3, 3>(rest_[p].shape, l, get_lane<3, 3>(rest_[p].shape, l) * history_.inverse(t));
        material_.limits[p].set(l, material_.limit(history_.strain()[t]));
      }
  }

  void begin_step(const StepStart& start) override { material_.h = start.h; }

  void commit(const VecX& x, History& history) const override {
    history_.commit(
        material_, [&](int t) { return deformation(t, x); }, history);
  }

  double dissipated(const VecX& x) const {
    return history_.dissipated(
        material_, [&](int t) { return deformation(t, x); },
        [&](int t) { return rest_of(t).volume; });
  }

  double viscous(const VecX& x) const {
    return history_.viscous(
        material_, [&](int t) { return deformation(t, x); },
        [&](int t) { return rest_of(t).volume; });
  }

  void publish(Records& records) const override {
    Base::publish(records);
    PlasticFlows flows{[this](const VecX& x) { return dissipated(x); }};
    if (material_.viscosity > 0) flows.viscous = [this](const VecX& x) { return viscous(x); };
    const auto strain = [this] {
      return VecX(Eigen::Map<const VecX>(history_.strain().data(), count()));
    };
    publish_plasticity(records, this->name(), std::move(flows), strain, &tets_);
    if (!body_.empty()) records.add(exchangeable());
  }

 private:
  using Base::count, Base::deformation, Base::material_, Base::rest_, Base::rest_of, Base::tets_;

  ExchangeableTets exchangeable() const {
    const auto volumes = [this] {
      std::vector<double> all;
      for (int t = 0; t < count(); ++t) all.push_back(rest_of(t).volume);
      return all;
    };
    const auto elastic = [this](const VecX& x) {
      std::vector<Mat3> all;
      for (int t = 0; t < count(); ++t) all.push_back(deformation(t, x));
      return all;
    };
    return {body_,
            &tets_,
            volumes,
            elastic,
            [this] { return history_.strain(); },
            history_.strain_array()};
  }

  std::string body_;  // body whose tets may be exchanged; "": none
  PlasticHistory history_;
  std::vector<TetRest<Pack>> rest_shapes_;  // without plastic flow; rest_ includes it
};

// Material of grouped tets (Body::elements).
std::unique_ptr<Term> make_grouped_von_mises(const std::string& name, const VonMises& material,
                                             const Body& body, const VecX& rest);

}  // namespace tack
