// A bond law is an energy per area phi(d, s; m, h) [J/m^2] of a bond between two points of surfaces
// that stick to each other:
//     d              opening along the normal since the surfaces bonded [m]
//     s = |u|^2      u the slip along the surface [m^2]; the tangential traction 2 phi_s u needs no
//                    division by |u|
//     m              history variables
//     h              size of the step [s]
// phi is the incremental potential of the step: the minimum, over the values of m at its end, of
// the stored energy plus the dissipation (Ortiz and Stainier 1999, The variational formulation of
// viscoplastic constitutive updates). With h = 0, m does not change and phi is the stored energy,
// which is 0 where a new bond was made.
//
// Surfaces that are closer than when they bonded, d < 0, repel each other as the bond would attract
// them at -d, with m fixed:
//     phi(d, s; m, h) = phi(0, s; m, h) + phi(-d, s; m, 0) - phi(0, s; m, 0).
// A bond thus resists compression with its normal stiffness, which damage reduces. Compression does
// no damage. Laws whose bonds heal under pressure leave compression to the barrier
// (resists_pressing), because they heal at gaps other than those at which they bonded.
// The formula of a law is evaluated at d >= 0 alone.
//
// A new law derives from BondLawOf<MyLaw>, lists its parameters in fields(), gives the peak and the
// work, and defines the history variables:
//     struct HistoryVariables { double damage = 0; };  // of a new bond; doubles only
//     template <class T>
//     T energy(const T& d, const T& s, const HistoryVariables& m, double h) const;
//     // After a step that ends at `at`.
//     HistoryVariables after(const HistoryVariables& m, const BondState& at) const;
//     // Dissipation of the step [J/m^2].
//     double loss(const HistoryVariables& before, const HistoryVariables& after,
//                 const BondState& at) const;
//     // True if the bond has failed.
//     bool gone(const HistoryVariables& m, const BondState& at) const;
// Without history, `struct HistoryVariables {};` and the energy are enough. Optional:
//     // A new bond: at the start of a run, or (on_contact) when surfaces met.
//     HistoryVariables begin(bool on_contact) const;
//     // Healing by pressure, after the step.
//     HistoryVariables heal(const HistoryVariables& m, const BondState& at) const;
//     // The fraction of opening and slip that healing leaves; else 1.
//     double kept(const HistoryVariables& before, const HistoryVariables& healed) const;
//     // For records: 1 intact, 0 without strength.
//     double intensity(const HistoryVariables& m) const;
// TACK_REGISTER registers the law in the same file, as an AdhesionLaw.
#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>

#include "framework/assembly/dual22.hpp"
#include "framework/contact/adhesion_law.hpp"

namespace tack {

/// State of a bond at the end of a step. Laws receive d >= 0.
struct BondState {
  double d = 0, s = 0;  // opening [m], squared slip [m^2]
  double h = 0;         // size of the step [s]
  double pressure = 0;  // of the barrier and of the bond [Pa]
};

/// Value and derivatives of a law.
struct BondSample {
  double value = 0;           // phi [J/m^2]
  double by_d = 0, by_s = 0;  // normal traction [Pa]; tangential traction / (2 |u|) [Pa/m]
  double by_dd = 0, by_ds = 0, by_ss = 0;
};

/// Effect of a step on a bond, per area [J/m^2].
struct BondChange {
  double dissipated = 0;
  double healed = 0;  // energy that healing took from the bond; negative: added to it
  double kept = 1;    // fraction of opening and slip left: what has healed is unstressed
  bool gone = false;
};

/// Interface of bond laws.
class BondLaw : public AdhesionLaw {
 public:
  virtual std::unique_ptr<BondLaw> clone() const = 0;
  /// Returns whether bonds form whenever surfaces meet, not only at the start of a run; pairs may
  /// override it.
  virtual bool bonds_on_contact() const { return false; }
  /// Returns whether a bond resists d < 0, surfaces closer than when they bonded. If not, the
  /// barrier alone does.
  virtual bool resists_pressing() const { return true; }
  /// Longest step size for laws that are integrated rather than minimised over the step [s].
  virtual double longest_step() const { return std::numeric_limits<double>::infinity(); }

  /// Number of history variables.
  virtual int width() const = 0;
  /// Writes the history variables of a new bond.
  virtual void initialize(bool on_contact, double* history) const = 0;
  /// Adds phi and its derivatives for n bonds. `history` holds their history variables one after
  /// the other.
  virtual void add_samples(int n, const double* d, const double* s, const double* history, double h,
                           BondSample* out) const = 0;
  virtual void add_values(int n, const double* d, const double* s, const double* history, double h,
                          double* out) const = 0;
  /// Returns 1 for an intact bond, 0 for one without strength.
  virtual double intensity_of(const double* history) const = 0;
  /// Advances the history variables by a step, then heals. A bond that fails dissipates its stored
  /// energy.
  virtual BondChange advance(const BondState& at, double* history) const = 0;

  /// Returns phi and its derivatives for one bond.
  BondSample at(double d, double s, const double* history, double h) const {
    BondSample sample;
    add_samples(1, &d, &s, history, h, &sample);
    return sample;
  }
  /// Returns the stored energy [J/m^2].
  double stored(double d, double s, const double* history) const {
    double value = 0;
    add_values(1, &d, &s, history, 0, &value);
    return value;
  }
};

/// Derives the interface from the formula of `Law`.
template <class Law>
class BondLawOf : public BondLaw {
 public:
  std::unique_ptr<BondLaw> clone() const override { return std::make_unique<Law>(law()); }
  AdhesionTraits traits() const override {
    return {
        .reversible = false, .history_dependent = width() > 0, .normal = true, .tangential = true};
  }
  int width() const override {
    using HistoryVariables = typename Law::HistoryVariables;
    return std::is_empty_v<HistoryVariables> ? 0 : sizeof(HistoryVariables) / sizeof(double);
  }
  void initialize(bool on_contact, double* history) const override {
    if constexpr (requires { law().begin(on_contact); }) store(law().begin(on_contact), history);
    else store(typename Law::HistoryVariables{}, history);
  }
  void add_samples(int n, const double* d, const double* s, const double* history, double h,
                   BondSample* out) const override {
    const bool resists = resists_pressing();
    for (int i = 0; i < n; ++i) {
      const auto m = load(history + i * width());
      const auto energy = [&](double opening, double step) {
        return law().energy(Dual22::first(opening), Dual22::second(s[i]), m, step);
      };
      const Dual22 e = energy(std::max(d[i], 0.0), h);
      out[i].value += e.v;
      out[i].by_s += e.b;
      out[i].by_ss += e.bb;
      if (d[i] >= 0) {
        out[i].by_d += e.a;
        out[i].by_dd += e.aa;
        out[i].by_ds += e.ab;
      } else if (resists) {
        const Dual22 pressed = energy(-d[i], 0), none = energy(0, 0);
        out[i].value += pressed.v - none.v;
        out[i].by_d -= pressed.a;
        out[i].by_s += pressed.b - none.b;
        out[i].by_dd += pressed.aa;
        out[i].by_ds -= pressed.ab;
        out[i].by_ss += pressed.bb - none.bb;
      }
    }
  }
  void add_values(int n, const double* d, const double* s, const double* history, double h,
                  double* out) const override {
    for (int i = 0; i < n; ++i) {
      const auto m = load(history + i * width());
      out[i] += law().energy(std::max(d[i], 0.0), s[i], m, h) + pressed(d[i], s[i], m);
    }
  }
  double intensity_of(const double* history) const override {
    if constexpr (requires { law().intensity(load(history)); })
      return law().intensity(load(history));
    else return 1;
  }
  BondChange advance(const BondState& state, double* history) const override {
    const auto clipped = [](BondState p) {
      p.d = std::max(p.d, 0.0);
      return p;
    };
    const auto stored = [&](const BondState& p, const auto& m) {
      return law().energy(clipped(p).d, p.s, m, 0.0) + pressed(p.d, p.s, m);
    };
    const BondState at = clipped(state);
    const auto before = load(history);
    auto now = before;
    BondChange change;
    if constexpr (!std::is_empty_v<typename Law::HistoryVariables>) {
      now = law().after(before, at);
      change.dissipated = law().loss(before, now, at);
      // Damage reduces the energy of pressing; it grows by round-off alone, where damage barely
      // does.
      change.dissipated +=
          std::max(0.0, pressed(state.d, at.s, before) - pressed(state.d, at.s, now));
    }
    BondState end = state;  // relative to the attachment point after healing
    if constexpr (requires { law().heal(now, at); }) {
      const auto healed = law().heal(now, at);
      if (std::memcmp(&healed, &now, sizeof now) != 0) {
        if constexpr (requires { law().kept(now, healed); }) change.kept = law().kept(now, healed);
        if (end.d > 0) end.d *= change.kept;
        end.s *= change.kept * change.kept;
        change.healed = stored(state, now) - stored(end, healed);
      }
      now = healed;
    }
    store(now, history);
    if constexpr (!std::is_empty_v<typename Law::HistoryVariables> ||
                  requires { law().gone(now, at); })
      change.gone = law().gone(now, clipped(end));
    if (change.gone) change.dissipated += stored(end, now);
    return change;
  }

 private:
  const Law& law() const { return static_cast<const Law&>(*this); }
  // Returns the energy per area stored at d < 0, less that at d = 0 [J/m^2].
  template <class M>
  double pressed(double d, double s, const M& m) const {
    if (!(d < 0 && resists_pressing())) return 0;
    return law().energy(-d, s, m, 0.0) - law().energy(0.0, s, m, 0.0);
  }
  static auto load(const double* history) {
    using M = typename Law::HistoryVariables;
    static_assert(std::is_trivially_copyable_v<M> &&
                  (std::is_empty_v<M> || sizeof(M) % sizeof(double) == 0));
    M m;
    if constexpr (!std::is_empty_v<M>) std::memcpy(static_cast<void*>(&m), history, sizeof m);
    return m;
  }
  template <class M>
  static void store(const M& m, double* history) {
    if constexpr (!std::is_empty_v<M>) std::memcpy(history, &m, sizeof m);
  }
};

}  // namespace tack
