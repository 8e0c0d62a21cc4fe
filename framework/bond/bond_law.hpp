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
// A law that depends on time, temperature, position or objects takes the state of its site as well
// (site_state.hpp); the other functions find it in `at.site`:
//     template <class T>
//     T energy(const T& d, const T& s, const HistoryVariables& m, double h,
//              const SiteState& site) const;
// A law that depends on the direction of the slip is directed: its formula takes the components
// u.x, u.y of the slip along the tangents of the site instead of s. It has no heal().
//     template <class T>
//     T energy(const T& d, const Slip<T>& u, const HistoryVariables& m, double h,
//              const SiteState& site) const;
// TACK_REGISTER registers the law in the same file, as an AdhesionLaw.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "framework/assembly/dual22.hpp"
#include "framework/assembly/dual_many.hpp"
#include "framework/bond/site_state.hpp"
#include "framework/contact/adhesion_law.hpp"

namespace tack {

/// State of a bond at the end of a step. Laws receive d >= 0.
struct BondState {
  double d = 0, s = 0;  // opening [m], squared slip [m^2]
  double h = 0;         // size of the step [s]
  double pressure = 0;  // of the barrier and of the bond [Pa]
  SiteState site = {};
  Vec2 slip = Vec2::Zero();  // u along the tangents of the site, |u|^2 = s [m]
};

/// Components of the slip along the tangents of a site [m].
template <class T>
struct Slip {
  T x, y;
};

/// Step of several bonds.
struct BondStepStates {
  double h = 0;                      // s; 0: no step, phi is the stored energy
  const SiteState* sites = nullptr;  // per bond; null: BondLaw::assumed_site

  BondStepStates(double step, const SiteState* of_bonds = nullptr)  // NOLINT: a step size is enough
      : h(step), sites(of_bonds) {}
};

/// Value and derivatives of a law.
struct BondSample {
  double value = 0;           // phi [J/m^2]
  double by_d = 0, by_s = 0;  // normal traction [Pa]; tangential traction / (2 |u|) [Pa/m]
  double by_dd = 0, by_ds = 0, by_ss = 0;
};

/// Value and derivatives of a directed law by the opening and both components of the slip.
struct DirectedSample {
  double value = 0;              // phi [J/m^2]
  Vec3 gradient = Vec3::Zero();  // Pa
  Mat3 hessian = Mat3::Zero();   // Pa/m
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

  /// Returns times at which the law changes abruptly [s]; steps of adaptive size end there.
  virtual std::vector<double> abrupt_times() const { return {}; }

  /// Returns whether the law depends on the state of its site.
  virtual bool sees_site() const = 0;
  /// Returns whether the prepared law depends on the temperature of its site.
  virtual bool depends_on_temperature() const { return sees_site(); }
  /// Sets the site of evaluations that name none: those without a scene.
  void assume_site(const SiteState& site) { assumed_site_ = site; }
  const SiteState& assumed_site() const { return assumed_site_; }
  /// Returns the end of a step at that site.
  BondState assumed_state(double d, double s, double h, double pressure = 0) const {
    return {d, s, h, pressure, assumed_site_, Vec2(std::sqrt(s), 0)};
  }
  /// Returns whether the law depends on the direction of the slip.
  virtual bool directed() const = 0;

  /// Number of history variables.
  virtual int width() const = 0;
  /// Writes the history variables of a new bond.
  virtual void initialize(bool on_contact, double* history) const = 0;
  /// Adds phi and its derivatives for n bonds. `history` holds their history variables one after
  /// the other. Directed laws take the slip along the first tangent.
  virtual void add_samples(int n, const double* d, const double* s, const double* history,
                           const BondStepStates& step, BondSample* out) const = 0;
  virtual void add_values(int n, const double* d, const double* s, const double* history,
                          const BondStepStates& step, double* out) const = 0;
  /// The same for directed laws alone. jumps: opening and both components of the slip [m].
  virtual void add_directed_samples(int n, const Vec3* jumps, const double* history,
                                    const BondStepStates& step, DirectedSample* out) const = 0;
  virtual void add_directed_values(int n, const Vec3* jumps, const double* history,
                                   const BondStepStates& step, double* out) const = 0;
  /// Returns the stored energy [J/m^2]; step size and pressure do not count.
  virtual double stored(const BondState& at, const double* history) const = 0;
  /// Returns 1 for an intact bond, 0 for one without strength.
  virtual double intensity_of(const double* history) const = 0;
  /// Advances the history variables by a step, then heals. A bond that fails dissipates its stored
  /// energy.
  virtual BondChange advance(const BondState& at, double* history) const = 0;

  /// Returns phi and its derivatives for one bond.
  BondSample at(double d, double s, const double* history, const BondStepStates& step) const {
    BondSample sample;
    add_samples(1, &d, &s, history, step, &sample);
    return sample;
  }
  /// Returns the stored energy at the assumed site [J/m^2].
  double stored(double d, double s, const double* history) const {
    return stored(assumed_state(d, s, 0), history);
  }

 private:
  SiteState assumed_site_;
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
    if constexpr (std::is_empty_v<HistoryVariables>) return 0;
    else return sizeof(HistoryVariables) / sizeof(double);
  }
  void initialize(bool on_contact, double* history) const override {
    if constexpr (requires { law().begin(on_contact); }) store(law().begin(on_contact), history);
    else store(typename Law::HistoryVariables{}, history);
  }
  bool sees_site() const override { return form() != Form::plain; }
  bool directed() const override { return form() == Form::directed; }
  void add_samples(int n, const double* d, const double* s, const double* history,
                   const BondStepStates& step, BondSample* out) const override {
    for (int i = 0; i < n; ++i) {
      if constexpr (form() == Form::directed) {
        DirectedSample sample;
        const Vec3 jump(d[i], std::sqrt(s[i]), 0);
        const BondStepStates of_one{step.h, &site_of(step, i)};
        add_directed_samples(1, &jump, history + i * width(), of_one, &sample);
        add_along_first_tangent(sample, jump[1], out[i]);
      } else {
        add_sample(d[i], s[i], load(history + i * width()), step.h, site_of(step, i), out[i]);
      }
    }
  }
  void add_values(int n, const double* d, const double* s, const double* history,
                  const BondStepStates& step, double* out) const override {
    for (int i = 0; i < n; ++i) {
      const auto m = load(history + i * width());
      const SiteState& site = site_of(step, i);
      const Jump jump{d[i], s[i], Vec2(form() == Form::directed ? std::sqrt(s[i]) : 0, 0)};
      out[i] += value_at(jump.clipped(), m, step.h, site) + pressed(jump, m, site);
    }
  }
  void add_directed_samples([[maybe_unused]] int n, [[maybe_unused]] const Vec3* jumps,
                            [[maybe_unused]] const double* history,
                            [[maybe_unused]] const BondStepStates& step,
                            [[maybe_unused]] DirectedSample* out) const override {
    if constexpr (form() == Form::directed) {
      const bool resists = resists_pressing();
      for (int i = 0; i < n; ++i) {
        const auto m = load(history + i * width());
        const auto energy = [&](double opening, double h) {
          const Slip<JumpDual> slip{JumpDual::variable(jumps[i][1], 1),
                                    JumpDual::variable(jumps[i][2], 2)};
          return sample_of(
              law().energy(JumpDual::variable(opening, 0), slip, m, h, site_of(step, i)));
        };
        DirectedSample e = energy(std::max(jumps[i][0], 0.0), step.h);
        if (jumps[i][0] < 0) {
          without_opening(e);
          if (resists) {
            DirectedSample pressed = energy(-jumps[i][0], 0), none = energy(0, 0);
            const Vec3 mirror(-1, 1, 1);
            without_opening(none);
            pressed.gradient = pressed.gradient.cwiseProduct(mirror).eval();
            pressed.hessian = (mirror.asDiagonal() * pressed.hessian * mirror.asDiagonal()).eval();
            add(pressed, 1, e);
            add(none, -1, e);
          }
        }
        add(e, 1, out[i]);
      }
    }
  }
  void add_directed_values([[maybe_unused]] int n, [[maybe_unused]] const Vec3* jumps,
                           [[maybe_unused]] const double* history,
                           [[maybe_unused]] const BondStepStates& step,
                           [[maybe_unused]] double* out) const override {
    if constexpr (form() == Form::directed) {
      for (int i = 0; i < n; ++i) {
        const auto m = load(history + i * width());
        const SiteState& site = site_of(step, i);
        const Jump jump{jumps[i][0], 0, jumps[i].template tail<2>()};
        out[i] += value_at(jump.clipped(), m, step.h, site) + pressed(jump, m, site);
      }
    }
  }
  double stored(const BondState& at, const double* history) const override {
    return stored_at(at, load(history));
  }
  using BondLaw::stored;
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
    const BondState at = clipped(state);
    const auto before = load(history);
    auto now = before;
    BondChange change;
    if constexpr (!std::is_empty_v<typename Law::HistoryVariables>) {
      now = law().after(before, at);
      change.dissipated = law().loss(before, now, at);
      // Damage reduces the energy of pressing; it grows by round-off alone, where damage barely
      // does.
      change.dissipated += std::max(
          0.0, pressed(Jump::of(state), before, at.site) - pressed(Jump::of(state), now, at.site));
    }
    BondState end = state;  // relative to the attachment point after healing
    if constexpr (requires { law().heal(now, at); }) {
      static_assert(
          form() != Form::directed,
          "directed bond laws do not heal: attachment points of healed bonds move to other "
          "triangles, whose tangents differ");
      const auto healed = law().heal(now, at);
      if (std::memcmp(&healed, &now, sizeof now) != 0) {
        if constexpr (requires { law().kept(now, healed); }) change.kept = law().kept(now, healed);
        if (end.d > 0) end.d *= change.kept;
        end.s *= change.kept * change.kept;
        end.slip *= change.kept;
        change.healed = stored_at(state, now) - stored_at(end, healed);
      }
      now = healed;
    }
    store(now, history);
    if constexpr (!std::is_empty_v<typename Law::HistoryVariables> ||
                  requires { law().gone(now, at); })
      change.gone = law().gone(now, clipped(end));
    if (change.gone) change.dissipated += stored_at(end, now);
    return change;
  }

 private:
  const Law& law() const { return static_cast<const Law&>(*this); }
  // Number of a directed law, in the opening and both components of the slip.
  using JumpDual = DualMany<3, true>;
  static DirectedSample sample_of(const JumpDual& e) {
    DirectedSample sample{e.v, Vec3(e.d[0], e.d[1], e.d[2]), Mat3()};
    for (int i = 0, k = 0; i < 3; ++i)
      for (int j = 0; j <= i; ++j, ++k) sample.hessian(i, j) = sample.hessian(j, i) = e.h[k];
    return sample;
  }
  // Removes the derivatives by the opening.
  static void without_opening(DirectedSample& sample) {
    sample.gradient[0] = 0;
    sample.hessian.row(0).setZero();
    sample.hessian.col(0).setZero();
  }
  static void add(const DirectedSample& sample, double factor, DirectedSample& out) {
    out.value += factor * sample.value;
    out.gradient += factor * sample.gradient;
    out.hessian += factor * sample.hessian;
  }
  // Arguments of the formula.
  enum class Form { plain, of_site, directed };
  static constexpr Form form() {
    using M = typename Law::HistoryVariables;
    constexpr bool directed = requires(const Law& l, const JumpDual& x, const Slip<JumpDual>& u,
                                       const M& m, const SiteState& at) {
      { l.energy(x, u, m, 0.0, at) } -> std::convertible_to<JumpDual>;
    };
    constexpr bool of_site =
        requires(const Law& l, const Dual22& x, const M& m, const SiteState& at) {
      { l.energy(x, x, m, 0.0, at) } -> std::convertible_to<Dual22>;
    };
    constexpr bool plain = requires(const Law& l, const Dual22& x, const M& m) {
      { l.energy(x, x, m, 0.0) } -> std::convertible_to<Dual22>;
    };
    static_assert(directed || of_site || plain,
                  "a bond law needs `template <class T> T energy(const T& d, const T& s, const "
                  "HistoryVariables& m, double h) const`, with a last argument `const SiteState& "
                  "site` if it depends on it, and then with `const Slip<T>& u` in place of s if it "
                  "depends on the direction of the slip");
    return directed ? Form::directed : of_site ? Form::of_site : Form::plain;
  }
  // Opening, squared slip and slip; directed laws use the last, all others the second.
  struct Jump {
    double d, s;
    Vec2 slip;
    static Jump of(const BondState& at) { return {at.d, at.s, at.slip}; }
    Jump clipped() const { return {std::max(d, 0.0), s, slip}; }
  };
  template <class T, class M>
  T energy_of(const T& d, const T& s, const M& m, double h, const SiteState& site) const {
    if constexpr (form() == Form::of_site) return law().energy(d, s, m, h, site);
    else return law().energy(d, s, m, h);
  }
  template <class M>
  double value_at(const Jump& jump, const M& m, double h, const SiteState& site) const {
    if constexpr (form() == Form::directed)
      return law().energy(jump.d, Slip<double>{jump.slip.x(), jump.slip.y()}, m, h, site);
    else return energy_of(jump.d, jump.s, m, h, site);
  }
  template <class M>
  double stored_at(const BondState& at, const M& m) const {
    const Jump jump = Jump::of(at);
    return value_at(jump.clipped(), m, 0, at.site) + pressed(jump, m, at.site);
  }
  template <class M>
  void add_sample(double d, double s, const M& m, double h, const SiteState& site,
                  BondSample& out) const {
    const auto energy = [&](double opening, double step) {
      return energy_of(Dual22::first(opening), Dual22::second(s), m, step, site);
    };
    const Dual22 e = energy(std::max(d, 0.0), h);
    out.value += e.v;
    out.by_s += e.b;
    out.by_ss += e.bb;
    if (d >= 0) {
      out.by_d += e.a;
      out.by_dd += e.aa;
      out.by_ds += e.ab;
    } else if (resists_pressing()) {
      const Dual22 pressed = energy(-d, 0), none = energy(0, 0);
      out.value += pressed.v - none.v;
      out.by_d -= pressed.a;
      out.by_s += pressed.b - none.b;
      out.by_dd += pressed.aa;
      out.by_ds -= pressed.ab;
      out.by_ss += pressed.bb - none.bb;
    }
  }
  // Adds the derivatives by d and s = u^2 of a sample with the slip u along the first tangent.
  static void add_along_first_tangent(const DirectedSample& sample, double u, BondSample& out) {
    out.value += sample.value;
    out.by_d += sample.gradient[0];
    out.by_dd += sample.hessian(0, 0);
    if (!(u > 0)) {
      out.by_s += sample.hessian(1, 1) / 2;
      return;
    }
    out.by_s += sample.gradient[1] / (2 * u);
    out.by_ds += sample.hessian(0, 1) / (2 * u);
    out.by_ss += (sample.hessian(1, 1) - sample.gradient[1] / u) / (4 * u * u);
  }
  const SiteState& site_of(const BondStepStates& step, int i) const {
    return step.sites ? step.sites[i] : this->assumed_site();
  }
  // Returns the energy per area stored at d < 0, less that at d = 0 [J/m^2].
  template <class M>
  double pressed(const Jump& jump, const M& m, const SiteState& site) const {
    if (!(jump.d < 0 && resists_pressing())) return 0;
    return value_at({-jump.d, jump.s, jump.slip}, m, 0, site) -
           value_at({0, jump.s, jump.slip}, m, 0, site);
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
