// Newmark with beta = 1/4, gamma = 1/2: second order, no numerical damping. Dynamic terms act as an
// impulse h c in the middle of the step (contact_change.hpp, weight 1/2), c their accelerations at
// its end; a_i are the accelerations by all other terms:
//     x' = x + h v + h^2/4 (a_i + a_i') + h^2/2 (c' + s),
//     v' = v + h/2 (a_i + a_i') + h (c' + s).
// Then x' - x = h/2 (v + v'), and the work of contact is c' M (x' - x), never more than its
// potential gave if that is convex: an impact gains no energy, whatever h. With the mean of c and
// c' it would. s = - (c - c_before) / 2, where contact is smooth, moves the force back to the
// middle of the step: second order. It fades out as contact becomes less smooth, because after an
// impact it would have the wrong sign. In adaptive steps the last change is scaled with the ratio of
// their sizes.
//
// The rule is conjugate to the implicit midpoint rule: in free motion it keeps
//     sum m x cross v + h^2/4 sum m v cross a
// and, for linear forces, the energy, exactly (docs/theory/integrators.md).
#include "framework/stepping/integrators/bdf2.hpp"
#include "framework/stepping/integrators/contact_change.hpp"
#include "framework/stepping/integrators/fixed_path.hpp"

namespace tack {
namespace {

class Newmark : public TimeIntegrator {
 public:
  Prediction predict(const StepStage& stage) const override {
    const State& s = stage.state;
    const double h = stage.h;
    VecX x = s.x + h * s.v + h * h / 4 * (s.contact.size() > 0 ? VecX(s.a - s.contact) : s.a);
    if (const VecX c = shift(s, h); c.size() > 0) x += h * h / 2 * c;
    return {std::move(x), h * h / 4, h * h / 2};
  }
  void update(const StepStage& stage, const VecX& x, const VecX& contact, VecX& v, VecX& a) const override {
    // From M (x' - x~) = h^2/4 f_i' + h^2/2 f_c'.
    const double h = stage.h;
    a = 4 / (h * h) * (x - predict(stage).x);
    if (contact.size() > 0) a -= contact;
    v = 2 / h * (x - stage.state.x) - stage.state.v;
  }
  EndVelocity end_velocity(const StepStage& stage) const override {
    return {2 / stage.h, stage.state.x + stage.h / 2 * stage.state.v};
  }
  // Error of the trapezoidal rule. Contact that was made or lost acted at an unknown time of the
  // step.
  LocalError local_error(const StepStage& stage, const VecX& x, const VecX& contact) const override {
    const State& old = stage.state;
    const double h = stage.h;
    VecX v, a;
    update(stage, x, contact, v, a);
    VecX error = h * h / 12 * (a - old.a);
    const double sudden = contact_change(old.contact, contact);
    if (sudden > 0) error += sudden * (h * h / 2 - h * h / 12) * (contact - old.contact);
    return {std::move(error), sudden == 1 ? 1 : 3};
  }
  bool follows_contact() const override { return true; }
  const TimeIntegrator* fallback() const override { return &euler_; }
  std::string energy_advice(bool gain, bool contact) const override {
    if (gain) return energy_gain_advice(contact);
    return contact ? short_contact_advice
                   : "what turns or vibrates is too fast for the step: refine time.step";
  }
  // After a jump in the velocity of a prescribed motion, the trapezoidal rule would oscillate without end.
  void update_fixed(const StepStage& stage, const VecX& x, const std::vector<int>& fixed, VecX& v, VecX& a) const override {
    path_.update(stage, x, fixed, v, a);
  }

 private:
  static VecX shift(const State& s, double h) {
    const double ratio = step_ratio(s, h), smoothness = ratio > 0 ? 1 - contact_change(s) : 0;
    if (smoothness == 0 || s.contact_before.size() == 0) return {};
    return -0.5 * ratio * smoothness * (s.contact - s.contact_before);
  }
  FixedPath path_;
  ImplicitEuler euler_;
};

TACK_REGISTER(TimeIntegrator, Newmark, "newmark",
              "Second order, no numerical damping (beta 1/4, gamma 1/2), contact as an implicit impulse.",
              "Newmark 1959; Kane, Repetto, Ortiz, Marsden 1999, Finite element analysis of nonsmooth contact");

}  // namespace
}  // namespace tack
