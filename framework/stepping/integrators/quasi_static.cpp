// No inertia: each step is an equilibrium under the loads of its end.
#include "framework/stepping/integrators/contact_change.hpp"

namespace tack {
namespace {

class QuasiStatic : public TimeIntegrator {
 public:
  Prediction predict(const StepStage& stage) const override { return {stage.state.x, 1.0, 1.0, false}; }
  bool inertia() const override { return false; }
  void update(const StepStage& stage, const VecX&, const VecX&, VecX& v, VecX& a) const override {
    v = a = VecX::Zero(stage.state.x.size());
  }
  // The equilibrium itself does not depend on h, but the path of friction, plastic flow and bonds
  // to it does: it is linear in each step, and its error is about half of its deviation.
  LocalError local_error(const StepStage& stage, const VecX& x, const VecX&) const override {
    const State& old = stage.state;
    const double h = stage.h;
    if (old.h_before == 0) return {VecX::Zero(x.size()), 2};
    return {0.5 * (x - old.x - h / old.h_before * (old.x - old.x_before)), 2};
  }
  bool damps() const override { return true; }
  std::string energy_advice(bool, bool contact) const override { return energy_gain_advice(contact); }
};

TACK_REGISTER(TimeIntegrator, QuasiStatic, "quasi_static",
              "No inertia: each step is a static equilibrium under the loads of its time.",
              "Fang et al., eq. 1 without its first term");

}  // namespace
}  // namespace tack
