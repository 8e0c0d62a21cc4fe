#include "energies/shell/von_mises_membrane.hpp"

#include <fmt/format.h>

#include "energies/plasticity/flow_parameters.hpp"
#include "energies/plasticity/plastic_records.hpp"

namespace tack {
namespace {

class VonMisesMembraneTerm : public MembraneTerm<VonMisesMembrane> {
 public:
  VonMisesMembraneTerm(std::string name, const VonMisesMembrane& material, const Body& body, const VecX& rest, Fibres fibres)
      : MembraneTerm(std::move(name), material, body, rest, std::move(fibres)),
        history_name_(fmt::format("{}/energies/{}/", body.name, body.energy)), rest_shapes_(rest_) {
    load_history({});
  }

  // Within a step the yield surface and Fp stand still: F Fp^-1 = edges (edges_rest^-1 Fp^-1).
  void load_history(const History& history) override {
    const int n = count();
    material_.h = 0;
    if (const auto* values = history_values(history, history_name_ + inverse_name, 4, n)) inverse_ = *values;
    else inverse_ = identities(n);
    if (const auto* values = history_values(history, history_name_ + strain_name, 1, n)) strain_ = *values;
    else strain_.assign(static_cast<size_t>(n), 0.0);
    rest_ = rest_shapes_;
    material_.yields.resize(rest_.size());
    for (size_t p = 0; p < rest_.size(); ++p)
      for (int l = 0; l < pack_width; ++l) {
        const int t = std::min(static_cast<int>(p) * pack_width + l, n - 1);
        set_lane<2, 2>(rest_[p].shape, l, get_lane<2, 2>(rest_[p].shape, l) * inverse(t));
        material_.yields[p].set(l, material_.yield(strain_[t]));
      }
  }

  void begin_step(const StepStart& start) override { material_.h = start.h; }

  // The return mapping.
  void commit(const VecX& x, History& history) const override {
    HistoryArray inverses{4, inverse_, {}}, strains{1, strain_, {}};
    for_each_flow(x, 0, static_cast<int>(rest_.size()), [&](int t, int l, const PlaneStretch& trial, const PlaneFlow& flow) {
      strains.values[t] += flow.amount[l];
      const Mat2 v = get_lane<2, 2>(trial.v, l);
      const Vec2 back(std::exp(-flow.strain(0)[l]), std::exp(-flow.strain(1)[l]));
      Eigen::Map<Mat2>(&inverses.values[4 * static_cast<size_t>(t)]) = inverse(t) * v * back.asDiagonal() * v.transpose();
    });
    history[history_name_ + inverse_name] = std::move(inverses);
    history[history_name_ + strain_name] = std::move(strains);
  }

  // Plastic work: the amount by which a commit reduces the value.
  double dissipated(const VecX& x) const {
    return over_flows(x, [&](int t, double added) { return material_.work(strain_[t], added); });
  }
  double viscous(const VecX& x) const {
    return over_flows(x, [&](int, double added) { return material_.viscous_work(added); });
  }

  void publish(Records& records) const override {
    MembraneTerm::publish(records);
    PlasticFlows flows{[this](const VecX& x) { return dissipated(x); }};
    if (material_.viscosity > 0) flows.viscous = [this](const VecX& x) { return viscous(x); };
    publish_plasticity(records, name(), std::move(flows), strain_);
  }

 private:
  static constexpr const char* inverse_name = "plastic_inverse";
  static constexpr const char* strain_name = "plastic_strain";

  // act(triangle, lane, trial deformation, flow) for each triangle of the packs first .. last - 1 that flows.
  template <class Act>
  void for_each_flow(const VecX& x, int first, int last, const Act& act) const {
    for (int p = first; p < last; ++p) {
      const int t = p * pack_width, n = std::min(pack_width, count() - t);
      const PlaneStretch trial = plane_stretch(deformation_gradient(rest_[p], &triangles_[t], n, x));
      const PlaneFlow flow = material_.at(p).flow(trial.s);
      for (int l = 0; l < n; ++l)
        if (flow.amount[l] > 0) act(t + l, l, trial, flow);
    }
  }

  // The sum of volume times density(triangle, plastic strain that is added) over all that flow.
  template <class Density>
  double over_flows(const VecX& x, const Density& density) const {
    return sum_chunks(static_cast<int>(rest_.size()), [&](int first, int last) {
      double sum = 0;
      for_each_flow(x, first, last, [&](int t, int l, const PlaneStretch&, const PlaneFlow& flow) {
        sum += rest_[t / pack_width].volume[l] * density(t, flow.amount[l]);
      });
      return sum;
    });
  }

  static std::vector<double> identities(int n) {
    std::vector<double> all(4 * static_cast<size_t>(n), 0.0);
    for (size_t i = 0; i < all.size(); i += 4) all[i] = all[i + 3] = 1;
    return all;
  }
  Mat2 inverse(int t) const { return Eigen::Map<const Mat2>(&inverse_[4 * static_cast<size_t>(t)]); }

  std::string history_name_;                        // prefix of its history arrays
  std::vector<SheetRest<Pack>> rest_shapes_;  // before plastic flow; rest_ is with it
  std::vector<double> inverse_, strain_;      // per triangle: Fp^-1 in its frame, column by column, and the accumulated plastic strain
};

class VonMisesMembraneEnergy : public MembraneEnergy {
 public:
  void fields(Fields& f) override {
    MembraneEnergy::fields(f);
    flow_.fields(f, "strip");
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    Fibres along = fibres(body, rest);
    return std::make_unique<VonMisesMembraneTerm>(std::string(type()),
                                                  VonMisesMembrane(plane_stress(young_, poisson_), flow_.yield_stress, flow_.hardening, flow_.viscosity), body,
                                                  rest, std::move(along));
  }

 private:
  FlowParameters flow_;
};

TACK_REGISTER(Energy, VonMisesMembraneEnergy, "von_mises_membrane",
              "Elastoplastic membrane in Hencky strain with the von Mises yield criterion, in plane stress.",
              "Li, Li, Jiang 2022, Energetically Consistent Inelasticity; Simo and Taylor 1986 for plane stress");

}  // namespace
}  // namespace tack
