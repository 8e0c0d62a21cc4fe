// A bond law: energy per area phi(d, s; m, h) [J/m^2] of a bond between a place on one surface and
// a place on another that stick to each other: d [m], the opening along the normal since they
// bonded; s = |u|^2 [m^2], u the slip across it; m, what the bond remembers. It is the incremental
// potential of a step of size h [s]: the least, over all that m may become in the step, of the
// energy stored then and what the change dissipates (Ortiz and Stainier 1999, The variational
// formulation of viscoplastic constitutive updates). With h = 0 nothing changes: phi is the energy
// that is stored, 0 of a new bond where it was made.
// s, not |u|, is the argument: the force across, 2 phi_s u, needs no division by |u|.
// Surfaces closer than when they bonded, d < 0, are pressed apart as they would be pulled together
// at -d, with m fixed:
//     phi(d, s; m, h) = phi(0, s; m, h) + phi(-d, s; m, 0) - phi(0, s; m, 0).
// A bond thus resists pressing with its normal stiffness, which damage reduces. Pressing damages
// nothing. Laws whose bonds heal under pressure leave pressing to the barrier (resists_pressing):
// they heal at gaps at which they did not bond.
// The formula of a law is evaluated at d >= 0 alone.
//
// To add one, derive from BondLawOf<MyLaw>, list the parameters in fields(), give the peak and the
// work, and define the history variables:
//     struct Memory { double damage = 0; };  // of a new bond; doubles only
//     template <class T> T energy(const T& d, const T& s, const Memory& m, double h) const;
//     Memory after(const Memory& m, const BondPlace& at) const;  // a step that ends there
//     // Dissipation of the step [J/m^2].
//     double loss(const Memory& before, const Memory& after, const BondPlace& at) const;
//     bool gone(const Memory& m, const BondPlace& at) const;     // whether the bond has failed
// Without history, `struct Memory {};` and the energy are enough. Optional:
//     // A new bond: at the start of a run, or (on_contact) when surfaces met.
//     Memory begin(bool on_contact) const;
//     Memory heal(const Memory& m, const BondPlace& at) const;   // by pressure, after the step
//     // The fraction of opening and slip that healing leaves; else 1.
//     double kept(const Memory& before, const Memory& healed) const;
//     double intensity(const Memory& m) const;  // for records: 1 intact, 0 without strength
// Then TACK_REGISTER it in the same file, as an AdhesionLaw.
#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>

#include "framework/assembly/dual22.hpp"
#include "framework/contact/adhesion_law.hpp"

namespace tack {

// State of a bond at the end of a step. Laws see d >= 0.
struct BondPlace {
  double d = 0, s = 0;  // m, m^2
  double h = 0;         // the size of the step [s]
  double pressure = 0;  // between the two surfaces there, of the barrier and of the bond [Pa]
};

struct BondSample {
  double value = 0;                  // phi [J/m^2]
  double by_d = 0, by_s = 0;         // the traction [Pa]; half the traction across, by |u| [Pa/m]
  double by_dd = 0, by_ds = 0, by_ss = 0;
};

// Effect of a step on a bond, per area [J/m^2].
struct BondChange {
  double dissipated = 0;
  double healed = 0;  // energy that healing took from the bond; below zero: put in
  double kept = 1;    // fraction of opening and slip left: what has healed is unstressed
  bool gone = false;
};

class BondLaw : public AdhesionLaw {
 public:
  virtual std::unique_ptr<BondLaw> clone() const = 0;
  // Returns whether bonds form whenever surfaces meet, not only at the start of a run; pairs may
  // override it.
  virtual bool bonds_on_contact() const { return false; }
  // Returns whether a bond resists d < 0, surfaces closer than when they bonded. If not, the
  // barrier alone does.
  virtual bool resists_pressing() const { return true; }
  // Longest step size for laws that are integrated rather than minimised over the step [s].
  virtual double longest_step() const { return std::numeric_limits<double>::infinity(); }

  // Number of history variables.
  virtual int width() const = 0;
  virtual void fresh(bool on_contact, double* memory) const = 0;
  // Adds phi and its derivatives for n bonds; `memory` holds their history variables one after the
  // other.
  virtual void add_samples(int n, const double* d, const double* s, const double* memory, double h,
                           BondSample* out) const = 0;
  virtual void add_values(int n, const double* d, const double* s, const double* memory, double h,
                          double* out) const = 0;
  // Returns 1 for an intact bond, 0 for one without strength.
  virtual double intensity_of(const double* memory) const = 0;
  // Advances the history variables by a step, then heals. A bond that fails dissipates its stored
  // energy.
  virtual BondChange advance(const BondPlace& at, double* memory) const = 0;

  BondSample at(double d, double s, const double* memory, double h) const {
    BondSample sample;
    add_samples(1, &d, &s, memory, h, &sample);
    return sample;
  }
  double stored(double d, double s, const double* memory) const {
    double value = 0;
    add_values(1, &d, &s, memory, 0, &value);
    return value;
  }
};

// Supplies all that follows from the formula.
template <class Law>
class BondLawOf : public BondLaw {
 public:
  std::unique_ptr<BondLaw> clone() const override { return std::make_unique<Law>(law()); }
  AdhesionTraits traits() const override {
    return {.reversible = false, .remembers = width() > 0, .normal = true, .tangential = true};
  }
  int width() const override {
    using Memory = typename Law::Memory;
    return std::is_empty_v<Memory> ? 0 : sizeof(Memory) / sizeof(double);
  }
  void fresh(bool on_contact, double* memory) const override {
    if constexpr (requires { law().begin(on_contact); })
      store(law().begin(on_contact), memory);
    else
      store(typename Law::Memory{}, memory);
  }
  void add_samples(int n, const double* d, const double* s, const double* memory, double h,
                   BondSample* out) const override {
    const bool resists = resists_pressing();
    for (int i = 0; i < n; ++i) {
      const auto m = load(memory + i * width());
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
  void add_values(int n, const double* d, const double* s, const double* memory, double h,
                  double* out) const override {
    for (int i = 0; i < n; ++i) {
      const auto m = load(memory + i * width());
      out[i] += law().energy(std::max(d[i], 0.0), s[i], m, h) + pressed(d[i], s[i], m);
    }
  }
  double intensity_of(const double* memory) const override {
    if constexpr (requires { law().intensity(load(memory)); })
      return law().intensity(load(memory));
    else
      return 1;
  }
  BondChange advance(const BondPlace& place, double* memory) const override {
    const auto seen = [](BondPlace p) {
      p.d = std::max(p.d, 0.0);
      return p;
    };
    const auto stored = [&](const BondPlace& p, const auto& m) {
      return law().energy(seen(p).d, p.s, m, 0.0) + pressed(p.d, p.s, m);
    };
    const BondPlace at = seen(place);
    const auto before = load(memory);
    auto now = before;
    BondChange change;
    if constexpr (!std::is_empty_v<typename Law::Memory>) {
      now = law().after(before, at);
      change.dissipated = law().loss(before, now, at);
      change.dissipated += pressed(place.d, at.s, before) - pressed(place.d, at.s, now);
    }
    BondPlace end = place;  // seen from the anchor that healing leaves
    if constexpr (requires { law().heal(now, at); }) {
      const auto healed = law().heal(now, at);
      if (std::memcmp(&healed, &now, sizeof now) != 0) {
        if constexpr (requires { law().kept(now, healed); }) change.kept = law().kept(now, healed);
        if (end.d > 0) end.d *= change.kept;
        end.s *= change.kept * change.kept;
        change.healed = stored(place, now) - stored(end, healed);
      }
      now = healed;
    }
    store(now, memory);
    if constexpr (!std::is_empty_v<typename Law::Memory> || requires { law().gone(now, at); })
      change.gone = law().gone(now, seen(end));
    if (change.gone) change.dissipated += stored(end, now);
    return change;
  }

 private:
  const Law& law() const { return static_cast<const Law&>(*this); }
  // Returns the energy per area stored at d < 0, less that at d = 0 [J/m^2].
  template <class Memory>
  double pressed(double d, double s, const Memory& m) const {
    if (!(d < 0 && resists_pressing())) return 0;
    return law().energy(-d, s, m, 0.0) - law().energy(0.0, s, m, 0.0);
  }
  static auto load(const double* memory) {
    using Memory = typename Law::Memory;
    static_assert(std::is_trivially_copyable_v<Memory> &&
                  (std::is_empty_v<Memory> || sizeof(Memory) % sizeof(double) == 0));
    Memory m;
    if constexpr (!std::is_empty_v<Memory>) std::memcpy(static_cast<void*>(&m), memory, sizeof m);
    return m;
  }
  template <class Memory>
  static void store(const Memory& m, double* memory) {
    if constexpr (!std::is_empty_v<Memory>) std::memcpy(memory, &m, sizeof m);
  }
};

}  // namespace tack
