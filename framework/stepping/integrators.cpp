#include "framework/stepping/time_integrator.hpp"

#include <cmath>

namespace tack {
namespace {

class ImplicitEuler : public TimeIntegrator {
 public:
  Prediction predict(const State& s, double h) const override { return {s.x + h * s.v, h * h, true}; }
  void update(const State& old, const VecX& x, double h, VecX& v, VecX& a) const override {
    v = (x - old.x) / h;
    a = (v - old.v) / h;
  }
};

// Second-order backward differences; the first step, and the first after a change of h, are
// implicit Euler, which leaves the global order at two.
class Bdf2 : public TimeIntegrator {
 public:
  Prediction predict(const State& s, double h) const override {
    if (!has_history(s, h)) return euler_.predict(s, h);
    return {(4 * s.x - s.x_before) / 3 + h * (8 * s.v - 2 * s.v_before) / 9, 4 * h * h / 9, true};
  }
  void update(const State& old, const VecX& x, double h, VecX& v, VecX& a) const override {
    if (!has_history(old, h)) return euler_.update(old, x, h, v, a);
    v = (3 * x - 4 * old.x + old.x_before) / (2 * h);
    a = (3 * v - 4 * old.v + old.v_before) / (2 * h);
  }

 private:
  static bool has_history(const State& s, double h) {
    return s.h_before > 0 && std::abs(s.h_before - h) <= 1e-12 * h;
  }
  ImplicitEuler euler_;
};

// Newmark with beta = 1/4, gamma = 1/2: second order, no numerical damping.
class Newmark : public TimeIntegrator {
 public:
  Prediction predict(const State& s, double h) const override {
    return {s.x + h * s.v + h * h / 4 * s.a, h * h / 4, true};
  }
  void update(const State& old, const VecX& x, double h, VecX& v, VecX& a) const override {
    a = 4 / (h * h) * (x - old.x - h * old.v) - old.a;
    v = old.v + h / 2 * (old.a + a);
  }
  // A jump in a script's velocity would ring on for ever.
  void update_held(const State& old, const VecX& x, double h, const std::vector<int>& held, VecX& v,
                   VecX& a) const override {
    if (held.empty()) return;
    VecX v_path, a_path;
    path_.update(old, x, h, v_path, a_path);
    for (const int i : held) {
      vertex(v, i) = vertex(v_path, i);
      vertex(a, i) = vertex(a_path, i);
    }
  }

 private:
  Bdf2 path_;
};

class QuasiStatic : public TimeIntegrator {
 public:
  Prediction predict(const State& s, double) const override { return {s.x, 1.0, false}; }
  void update(const State& old, const VecX&, double, VecX& v, VecX& a) const override {
    v = a = VecX::Zero(old.x.size());
  }
};

TACK_REGISTER(TimeIntegrator, ImplicitEuler, "implicit_euler",
              "First order, stable for any step, damps vibrations.", "Fang et al., section 3.1");
TACK_REGISTER(TimeIntegrator, Bdf2, "bdf2", "Second order, damps vibrations little.",
              "Li 2020, Robust and Accurate Simulation of Elastodynamics and Contact");
TACK_REGISTER(TimeIntegrator, Newmark, "newmark",
              "Second order, no numerical damping (beta 1/4, gamma 1/2).", "Newmark 1959");
TACK_REGISTER(TimeIntegrator, QuasiStatic, "quasi_static",
              "No inertia: each step is a static equilibrium under the loads of its time.",
              "Fang et al., eq. 1 without its first term");

}  // namespace
}  // namespace tack
