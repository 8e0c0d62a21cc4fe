#include "framework/stepping/time_integrator.hpp"

#include <cmath>

namespace tack {
namespace {

// Contact stands for all dynamic terms here, friction, bonds and terms of plugins included
// (State::contact). Contact is smooth if its accelerations change in a step by less than this
// fraction of the largest one. Otherwise Newmark's correction is zero, and BDF2 drops its history.
constexpr double newmark_change = 0.25, bdf2_change = 0.25;

// Returns the change of contact over a step: 0 (none) to 1 (contact made or lost, or changed by
// at least the fraction `full_change`).
double contact_change(const VecX& before, const VecX& contact, double full_change) {
  if (contact.size() == 0 || before.size() == 0) return 0;
  const double now = full_change * contact.lpNorm<Eigen::Infinity>();
  const double change = (contact - before).lpNorm<Eigen::Infinity>();
  return change < now ? change / now : (change > 0 ? 1 : 0);
}
// Returns the change of contact over the last step.
double contact_change(const State& s, double full_change) { return contact_change(s.contact_before, s.contact, full_change); }

std::string gain_advice(bool contact) {
  return contact ? "surfaces moved by much of the range of contact or adhesion in a step: refine time.step"
                 : "what turns or deforms is too fast for the step: refine time.step";
}

bool same_step(const State& s, double h) { return s.h_before > 0 && std::abs(s.h_before - h) <= 1e-12 * h; }

// Returns h over the size of the step before, for two-step formulas: 1, or the ratio of adaptive
// steps. Returns 0 if the step before may not be used.
double step_ratio(const State& s, double h) {
  if (same_step(s, h)) return 1;
  return s.adapts && s.h_before > 0 ? h / s.h_before : 0;
}

class ImplicitEuler : public TimeIntegrator {
 public:
  Prediction predict(const State& s, double h) const override { return {s.x + h * s.v, h * h}; }
  void update(const State& old, const VecX& x, const VecX&, double h, VecX& v, VecX& a) const override {
    v = (x - old.x) / h;
    a = (v - old.v) / h;
  }
  bool damps() const override { return true; }
  std::string energy_advice(bool gain, bool contact) const override {
    if (gain) return gain_advice(contact);
    return "implicit Euler damps what moves and vibrates, in proportion to the step: time.integrator: newmark, or refine time.step";
  }
};

// Second-order backward differences. Differences across an impact would return energy that the impact
// dissipated. Implicit Euler, which keeps the global order at two, therefore solves
//   - steps that follow one in which contact was not smooth,
//   - the first step, and the first one after a change of h.
// Adaptive steps, whose sizes always change, use the formula of two sizes, with w the ratio of this
// size to the last, stable up to w = 1 + sqrt 2:
//     h v' = (1 + 2 w) / (1 + w) x' - (1 + w) x + w^2 / (1 + w) x_before,
// and the same formula for a' of the velocities.
class Bdf2 : public TimeIntegrator {
 public:
  Prediction predict(const State& s, double h) const override {
    if (!has_history(s, h)) return euler_.predict(s, h);
    if (const double w = step_ratio(s, h); w != 1) {
      const Weights k(w);
      return {(k.now * s.x - k.before * s.x_before) / k.next + h * (k.now * s.v - k.before * s.v_before) / (k.next * k.next),
              h * h / (k.next * k.next)};
    }
    return {(4 * s.x - s.x_before) / 3 + h * (8 * s.v - 2 * s.v_before) / 9, 4 * h * h / 9};
  }
  void update(const State& old, const VecX& x, const VecX& contact, double h, VecX& v, VecX& a) const override {
    if (!has_history(old, h)) return euler_.update(old, x, contact, h, v, a);
    if (const double w = step_ratio(old, h); w != 1) {
      const Weights k(w);
      v = (k.next * x - k.now * old.x + k.before * old.x_before) / h;
      a = (k.next * v - k.now * old.v + k.before * old.v_before) / h;
      return;
    }
    v = (3 * x - 4 * old.x + old.x_before) / (2 * h);
    a = (3 * v - 4 * old.v + old.v_before) / (2 * h);
  }
  EndVelocity end_velocity(const State& s, double h) const override {
    if (!has_history(s, h)) return euler_.end_velocity(s, h);
    if (const double w = step_ratio(s, h); w != 1) {
      const Weights k(w);
      return {k.next / h, (k.now * s.x - k.before * s.x_before) / k.next};
    }
    return {3 / (2 * h), (4 * s.x - s.x_before) / 3};
  }
  // The formula misses k times h^3/6 x''', and the parabola of the last velocity and acceleration
  // misses h^3/6 x''' with the opposite sign.
  LocalError local_error(const State& old, const VecX& x, const VecX& contact, double h) const override {
    if (!has_history(old, h)) return euler_.local_error(old, x, contact, h);
    const double w = step_ratio(old, h), k = (1 + w) * (1 + w) / (w * (1 + 2 * w));
    return {k / (1 + k) * (x - old.x - h * old.v - h * h / 2 * old.a), 3};
  }
  bool follows_contact() const override { return true; }
  bool damps() const override { return true; }
  std::string energy_advice(bool gain, bool contact) const override {
    if (gain) return gain_advice(contact);
    return contact ? "BDF2 is implicit Euler, which damps, for a step after each sudden change of contact: refine time.step, or time.integrator: newmark"
                   : "BDF2 damps what is fast for its steps: refine time.step, or time.integrator: newmark";
  }

 private:
  struct Weights {
    explicit Weights(double w) : next((1 + 2 * w) / (1 + w)), now(1 + w), before(w * w / (1 + w)) {}
    double next, now, before;
  };
  static bool has_history(const State& s, double h) { return step_ratio(s, h) > 0 && contact_change(s, bdf2_change) < 1; }
  ImplicitEuler euler_;
};

// Newmark with beta = 1/4, gamma = 1/2: second order, no numerical damping. Dynamic terms act as an
// impulse h c in the middle of the step, c their accelerations at its end (Kane, Repetto, Ortiz and
// Marsden 1999); a_i are the accelerations by all other terms:
//     x' = x + h v + h^2/4 (a_i + a_i') + h^2/2 (c' + s),
//     v' = v + h/2 (a_i + a_i') + h (c' + s).
// Then x' - x = h/2 (v + v'), and the work of contact is c' M (x' - x), never more than its
// potential gave if that is convex: an impact gains no energy, whatever h. With the mean of c and
// c' it would. s = - (c - c_before) / 2, where contact is smooth, moves the force back to the
// middle of the step: second order. It fades out as contact becomes less smooth, because after an
// impact it would have the wrong sign. In adaptive steps the last change is scaled with the ratio of
// their sizes.
class Newmark : public TimeIntegrator {
 public:
  Prediction predict(const State& s, double h) const override {
    VecX x = s.x + h * s.v + h * h / 4 * (s.contact.size() > 0 ? VecX(s.a - s.contact) : s.a);
    if (const VecX c = shift(s, h); c.size() > 0) x += h * h / 2 * c;
    return {std::move(x), h * h / 4, h * h / 2};
  }
  void update(const State& old, const VecX& x, const VecX& contact, double h, VecX& v, VecX& a) const override {
    // From M (x' - x~) = h^2/4 f_i' + h^2/2 f_c'.
    a = 4 / (h * h) * (x - predict(old, h).x);
    if (contact.size() > 0) a -= contact;
    v = 2 / h * (x - old.x) - old.v;
  }
  EndVelocity end_velocity(const State& s, double h) const override { return {2 / h, s.x + h / 2 * s.v}; }
  // Error of the trapezoidal rule. Contact that was made or lost acted at an unknown time of the
  // step.
  LocalError local_error(const State& old, const VecX& x, const VecX& contact, double h) const override {
    VecX v, a;
    update(old, x, contact, h, v, a);
    VecX error = h * h / 12 * (a - old.a);
    const double sudden = contact_change(old.contact, contact, newmark_change);
    if (sudden > 0) error += sudden * (h * h / 2 - h * h / 12) * (contact - old.contact);
    return {std::move(error), sudden == 1 ? 1 : 3};
  }
  bool follows_contact() const override { return true; }
  const TimeIntegrator* fallback() const override { return &euler_; }
  std::string energy_advice(bool gain, bool contact) const override {
    if (gain) return gain_advice(contact);
    return contact ? "contact that comes and goes within a few steps gives back a part of the energy only: refine time.step until it lasts for many"
                   : "what turns or vibrates is too fast for the step: refine time.step";
  }
  // After a jump in the velocity of a prescribed motion, the trapezoidal rule would oscillate without end.
  void update_fixed(const State& old, const VecX& x, double h, const std::vector<int>& fixed, VecX& v,
                   VecX& a) const override {
    if (fixed.empty()) return;
    VecX v_path, a_path;
    path_.update(old, x, {}, h, v_path, a_path);
    for (const int i : fixed) {
      vertex(v, i) = vertex(v_path, i);
      vertex(a, i) = vertex(a_path, i);
    }
  }

 private:
  static VecX shift(const State& s, double h) {
    const double ratio = step_ratio(s, h), smoothness = ratio > 0 ? 1 - contact_change(s, newmark_change) : 0;
    if (smoothness == 0 || s.contact_before.size() == 0) return {};
    return -0.5 * ratio * smoothness * (s.contact - s.contact_before);
  }
  Bdf2 path_;
  ImplicitEuler euler_;
};

class QuasiStatic : public TimeIntegrator {
 public:
  Prediction predict(const State& s, double) const override { return {s.x, 1.0, 1.0, false}; }
  void update(const State& old, const VecX&, const VecX&, double, VecX& v, VecX& a) const override {
    v = a = VecX::Zero(old.x.size());
  }
  // The equilibrium itself does not depend on h, but the path of friction, plastic flow and bonds
  // to it does: it is linear in each step, and its error is about half of its deviation.
  LocalError local_error(const State& old, const VecX& x, const VecX&, double h) const override {
    if (old.h_before == 0) return {VecX::Zero(x.size()), 2};
    return {0.5 * (x - old.x - h / old.h_before * (old.x - old.x_before)), 2};
  }
  bool damps() const override { return true; }
  std::string energy_advice(bool, bool contact) const override { return gain_advice(contact); }
};

TACK_REGISTER(TimeIntegrator, ImplicitEuler, "implicit_euler",
              "First order, stable for any step, damps vibrations.", "Fang et al., section 3.1");
TACK_REGISTER(TimeIntegrator, Bdf2, "bdf2",
              "Second order, with little numerical damping; falls back to implicit Euler for one step after non-smooth contact.",
              "Li 2020, Robust and Accurate Simulation of Elastodynamics and Contact");
TACK_REGISTER(TimeIntegrator, Newmark, "newmark",
              "Second order, no numerical damping (beta 1/4, gamma 1/2), contact as an implicit impulse.",
              "Newmark 1959; Kane, Repetto, Ortiz, Marsden 1999, Finite element analysis of nonsmooth contact");
TACK_REGISTER(TimeIntegrator, QuasiStatic, "quasi_static",
              "No inertia: each step is a static equilibrium under the loads of its time.",
              "Fang et al., eq. 1 without its first term");

}  // namespace
}  // namespace tack
