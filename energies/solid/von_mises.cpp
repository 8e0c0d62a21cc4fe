#include "energies/solid/von_mises.hpp"

#include <fmt/format.h>

#include "energies/plasticity/plastic_records.hpp"

namespace tack {
namespace {

// The return mapping leaves |dev e| so far within the yield surface that rounding does not cross it: what does not
// move does not flow.
constexpr double inside = 1e-13;

class VonMisesTerm : public SolidTerm<VonMises> {
 public:
  VonMisesTerm(std::string name, const VonMises& material, const Body& body, const VecX& rest)
      : SolidTerm(std::move(name), material, body, rest),
        memory_(fmt::format("{}/energies/{}/", body.name, body.energy)), rest_shapes_(rest_) {
    remember({});
  }

  // Within a step the yield surface and Fp stand still: F Fp^-1 = edges (edges_rest^-1 Fp^-1).
  void remember(const History& history) override {
    const int n = count();
    if (const auto* values = remembered(history, memory_ + inverse_name, 9, n)) inverse_ = *values;
    else inverse_ = identities(n);
    if (const auto* values = remembered(history, memory_ + strain_name, 1, n)) strain_ = *values;
    else strain_.assign(n, 0.0);
    rest_ = rest_shapes_;
    material_.limits.resize(rest_.size());
    for (size_t p = 0; p < rest_.size(); ++p)
      for (int l = 0; l < pack_width; ++l) {
        const int t = std::min(static_cast<int>(p) * pack_width + l, n - 1);
        set_lane<3, 3>(rest_[p].shape, l, get_lane<3, 3>(rest_[p].shape, l) * inverse(t));
        material_.limits[p].set(l, material_.limit(strain_[t]));
      }
  }

  // The return mapping.
  void commit(const VecX& x, History& history) const override {
    HistoryArray inverses{9, inverse_, {}}, strains{1, strain_, {}};
    for_each(count(), [&](int t) {
      const Trial trial(deformation(t, x));
      const double r = trial.norm - material_.limit(strain_[t]);
      if (!(r > 0)) return;
      const double added = material_.flow(r);
      strains.values[t] += added;
      const double back = std::min(std::sqrt(1.5) * added + inside, trial.norm) / trial.norm;
      const Vec3 flow = (-back * trial.deviator).array().exp();
      const Mat3 next = inverse(t) * trial.svd.v * flow.asDiagonal() * trial.svd.v.transpose();
      Eigen::Map<Mat3>(&inverses.values[9 * static_cast<size_t>(t)]) = next / std::cbrt(next.determinant());
    });
    history[memory_ + inverse_name] = std::move(inverses);
    history[memory_ + strain_name] = std::move(strains);
  }

  // Plastic work: what a commit takes off the value.
  double dissipated(const VecX& x) const {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int t = first; t < last; ++t) {
        const double added = material_.flow(Trial(deformation(t, x)).norm - material_.limit(strain_[t]));
        if (added > 0) sum += rest_of(t).volume * material_.work(strain_[t], added);
      }
      return sum;
    });
  }

  void publish(Records& records) const override {
    SolidTerm::publish(records);
    publish_plasticity(records, name(), [this](const VecX& x) { return dissipated(x); }, strain_);
  }

 private:
  static constexpr const char* inverse_name = "plastic_inverse";
  static constexpr const char* strain_name = "plastic_strain";

  struct Trial {
    explicit Trial(const Mat3& f) : svd(svd3(f)), deviator(svd.s.array().log()) {
      deviator.array() -= deviator.sum() / 3;
      norm = deviator.norm();
    }
    Svd3<double> svd;
    Vec3 deviator;
    double norm;
  };

  static std::vector<double> identities(int n) {
    std::vector<double> all(9 * static_cast<size_t>(n), 0.0);
    for (size_t i = 0; i < all.size(); i += 9) all[i] = all[i + 4] = all[i + 8] = 1;
    return all;
  }
  Mat3 inverse(int t) const { return Eigen::Map<const Mat3>(&inverse_[9 * static_cast<size_t>(t)]); }

  std::string memory_;                      // its arrays in the history begin so
  std::vector<TetRest<Pack>> rest_shapes_;  // before plastic flow; rest_ is with it
  std::vector<double> inverse_, strain_;    // per tet: Fp^-1, column by column, and the accumulated plastic strain
};

class VonMisesSolid : public SolidEnergy {
 public:
  void fields(Fields& f) override {
    SolidEnergy::fields(f);
    f.number("yield_stress", yield_stress_, units::pressure, "stress at which a bar in tension begins to flow").required().positive();
    f.number("hardening", hardening_, units::pressure,
             "H: what the yield stress grows by per accumulated plastic strain (equivalent, that of a bar); a bar in tension then "
             "has the tangent modulus E H / (E + H). 0: perfect plasticity").nonnegative();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    return std::make_unique<VonMisesTerm>(std::string(type()), VonMises{lame(), yield_stress_, hardening_}, body, rest);
  }

 private:
  double yield_stress_ = 1e3;  // Pa
  double hardening_ = 0;       // Pa
};

TACK_REGISTER(Energy, VonMisesSolid, "von_mises",
              "Solid in Hencky strain that flows plastically from a yield stress on, of von Mises.",
              "Li, Li, Jiang 2022, Energetically Consistent Inelasticity");

}  // namespace
}  // namespace tack
