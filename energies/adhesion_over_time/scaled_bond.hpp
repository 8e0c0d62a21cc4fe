// Base of modifiers of a bond law: a factor times the potential of another law,
//     phi(d, s; m, h) = g phi_0(d, s; m, h),
// where g depends on the state of the site (time, temperature) or on history variables of its own,
// and is constant within a step. Strength, work, stiffness and dissipation are g times those of the
// law; lengths, damage and its evolution are the law's. Modifiers may be nested.
//
// Energy balance. A factor of time or temperature changes the stored energy of a bond at the start
// of a step: work_environment (site_state.hpp). A factor of history variables changes it at the
// end: work_healing.
//
// A modifier derives from ScaledBondOf<Modifier> and defines
//     static constexpr int own_width;                            // own history variables
//     static constexpr bool of_site;                             // g depends on the site
//     double factor(const double* own, const SiteState& site) const;
//     double largest_factor() const;
//     void begin_own(bool on_contact, double* own) const;        // of a new bond
//     void advance_own(const BondState& at, double* own) const;  // after a step
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "framework/bond/bond_law.hpp"
#include "framework/bond/varying_strength.hpp"
#include "framework/config/field.hpp"
#include "geometry/errors.hpp"

namespace tack {

template <class Modifier>
class ScaledBondOf : public BondLaw, public VaryingStrength {
 public:
  ScaledBondOf() = default;
  ScaledBondOf(const ScaledBondOf& other)
      : BondLaw(other), VaryingStrength(other), given_(other.given_),
        law_(other.law_ ? other.law_->clone() : nullptr) {}
  ScaledBondOf& operator=(const ScaledBondOf&) = delete;

  std::unique_ptr<BondLaw> clone() const override { return std::make_unique<Modifier>(self()); }
  void prepare(const PairMaterials& materials) override {
    const auto* bonds = dynamic_cast<const BondLaw*>(given_.get());
    if (!bonds)
      throw InputError("adhesion " + std::string(type()) + ": its law '" +
                       std::string(given_->type()) +
                       "' is one of the gap, and bonds alone have a time of their own; take `law: "
                       "{type: damage, envelope: ...}` with that law as envelope");
    law_ = bonds->clone();
    law_->prepare(materials);
    if (law_->width() + Modifier::own_width > most_numbers)
      throw InputError("adhesion " + std::string(type()) +
                       ": too many laws are nested; take fewer");
  }
  double peak_traction() const override { return self().largest_factor() * law_->peak_traction(); }
  double work_of_adhesion() const override {
    return self().largest_factor() * law_->work_of_adhesion();
  }
  AdhesionTraits traits() const override {
    return {.reversible = false, .history_dependent = true, .normal = true, .tangential = true};
  }
  std::string note() const override { return law_->note(); }
  std::vector<std::string> warnings() const override { return law_->warnings(); }

  bool bonds_on_contact() const override { return law_->bonds_on_contact(); }
  bool resists_pressing() const override { return law_->resists_pressing(); }
  double longest_step() const override { return law_->longest_step(); }
  std::vector<double> abrupt_times() const override { return law_->abrupt_times(); }
  bool sees_site() const override { return Modifier::of_site || law_->sees_site(); }
  bool depends_on_temperature() const override { return law_->depends_on_temperature(); }
  bool directed() const override { return law_->directed(); }

  int width() const override { return Modifier::own_width + law_->width(); }
  void initialize(bool on_contact, double* history) const override {
    self().begin_own(on_contact, history);
    law_->initialize(on_contact, history + Modifier::own_width);
  }
  void add_samples(int n, const double* d, const double* s, const double* history,
                   const BondStepStates& step, BondSample* out) const override {
    std::array<BondSample, block> samples;
    in_blocks(n, history, step,
              [&](int first, int count, const double* own, const BondStepStates& at) {
                samples.fill({});
                law_->add_samples(count, d + first, s + first, own, at, samples.data());
                for (int i = 0; i < count; ++i) {
                  const double g = factor_of(first + i, history, step);
                  BondSample& sum = out[first + i];
                  const BondSample& of = samples[i];
                  sum.value += g * of.value;
                  sum.by_d += g * of.by_d, sum.by_s += g * of.by_s;
                  sum.by_dd += g * of.by_dd, sum.by_ds += g * of.by_ds, sum.by_ss += g * of.by_ss;
                }
              });
  }
  void add_values(int n, const double* d, const double* s, const double* history,
                  const BondStepStates& step, double* out) const override {
    std::array<double, block> values;
    in_blocks(n, history, step,
              [&](int first, int count, const double* own, const BondStepStates& at) {
                values.fill(0);
                law_->add_values(count, d + first, s + first, own, at, values.data());
                for (int i = 0; i < count; ++i)
                  out[first + i] += factor_of(first + i, history, step) * values[i];
              });
  }
  void add_directed_samples(int n, const Vec3* jumps, const double* history,
                            const BondStepStates& step, DirectedSample* out) const override {
    std::array<DirectedSample, block> samples;
    in_blocks(n, history, step,
              [&](int first, int count, const double* own, const BondStepStates& at) {
                samples.fill({0, Vec3::Zero(), Mat3::Zero()});
                law_->add_directed_samples(count, jumps + first, own, at, samples.data());
                for (int i = 0; i < count; ++i) {
                  const double g = factor_of(first + i, history, step);
                  out[first + i].value += g * samples[i].value;
                  out[first + i].gradient += g * samples[i].gradient;
                  out[first + i].hessian += g * samples[i].hessian;
                }
              });
  }
  void add_directed_values(int n, const Vec3* jumps, const double* history,
                           const BondStepStates& step, double* out) const override {
    std::array<double, block> values;
    in_blocks(n, history, step,
              [&](int first, int count, const double* own, const BondStepStates& at) {
                values.fill(0);
                law_->add_directed_values(count, jumps + first, own, at, values.data());
                for (int i = 0; i < count; ++i)
                  out[first + i] += factor_of(first + i, history, step) * values[i];
              });
  }
  using BondLaw::stored;
  double stored(const BondState& at, const double* history) const override {
    return self().factor(history, at.site) * law_->stored(at, history + Modifier::own_width);
  }
  double intensity_of(const double* history) const override {
    return law_->intensity_of(history + Modifier::own_width);
  }
  BondChange advance(const BondState& at, double* history) const override {
    double* of_law = history + Modifier::own_width;
    const double before = self().factor(history, at.site);
    BondChange change = law_->advance(at, of_law);
    change.dissipated *= before;
    change.healed *= before;
    if (change.gone) return change;
    self().advance_own(at, history);
    const double now = self().factor(history, at.site);
    if (now == before) return change;
    BondState end = at;
    if (end.d > 0) end.d *= change.kept;
    end.s *= change.kept * change.kept;
    end.slip *= change.kept;
    change.healed -= (now - before) * law_->stored(end, of_law);
    return change;
  }

 protected:
  void law_field(Fields& f) {
    f.component("law", given_, "the law of bonds that is modified").required();
  }
  const BondLaw& law() const { return *law_; }

 private:
  static constexpr int block = 32;         // bonds
  static constexpr int most_numbers = 16;  // history variables of a bond

  const Modifier& self() const { return static_cast<const Modifier&>(*this); }
  double factor_of(int bond, const double* history, const BondStepStates& step) const {
    return self().factor(history + bond * width(), step.sites ? step.sites[bond] : assumed_site());
  }
  // Calls act(first, count, history of the law, its step) for blocks of bonds. Without sites, as of
  // laws outside a scene, a law that sees them gets the assumed one, bond by bond.
  template <class Act>
  void in_blocks(int n, const double* history, const BondStepStates& step, const Act& act) const {
    std::array<double, block * most_numbers> own;
    const int numbers = law_->width(), all = width();
    const bool assumes = !step.sites && sees_site();
    const int most = assumes ? 1 : block;
    for (int first = 0; first < n; first += most) {
      const int count = std::min(most, n - first);
      for (int i = 0; i < count; ++i)
        std::copy_n(history + (first + i) * all + Modifier::own_width, numbers,
                    own.data() + i * numbers);
      act(first, count, own.data(),
          BondStepStates(step.h, assumes      ? &assumed_site()
                                 : step.sites ? step.sites + first
                                              : nullptr));
    }
  }

  std::shared_ptr<const AdhesionLaw> given_;
  std::unique_ptr<BondLaw> law_;
};

}  // namespace tack
