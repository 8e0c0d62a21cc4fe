// Generalised-alpha (Chung and Hulbert 1993): second order, with a chosen damping of what is fast
// for the steps. rho (rho_inf) is the factor of the amplitude of an infinitely fast vibration in a step:
//     am = (2 rho - 1) / (rho + 1),  af = rho / (rho + 1),  d = af - am,
//     beta = (1 + d)^2 / 4,          gamma = 1/2 + d.
// With the accelerations b by all terms but the dynamic ones and the algorithmic accelerations A,
//     (1 - am) A' + am A = (1 - af) b' + af b,
//     x' = x + h v + h^2 ((1/2 - beta) A + beta A'),   v' = v + h ((1 - gamma) A + gamma A').
// The forces of both ends are averaged, not taken at averaged positions. The unknown of the
// minimisation is then the end x' itself, which neither intersects nor inverts. The scale of static
// terms is beta h^2 (1 - af) / (1 - am).
//
// Dynamic terms act as an impulse (contact_change.hpp) of weight k = beta / gamma, from 1/2 to 2/3:
// v' = gamma / (beta h) (x' - x^) for all of them, x^ known. rho = 1 is Newmark's rule.
//
// A is a history array: State::a is the acceleration by forces. It is b where there is none.
#include "framework/config/field.hpp"
#include "framework/stepping/integrators/contact_change.hpp"
#include "framework/stepping/integrators/fixed_path.hpp"

namespace tack {
namespace {

constexpr const char* history_name = "algorithmic acceleration";

class GeneralisedAlpha : public TimeIntegrator {
 public:
  void fields(Fields& f) override {
    f.number("rho_inf", rho_, units::none,
             "factor of the amplitude of an infinitely fast vibration in a step: 1 damps nothing, 0 all of it at once")
        .range(0, 1);
  }
  Prediction predict(const StepStage& stage) const override {
    const State& s = stage.state;
    const double h = stage.h;
    const Weights w(rho_);
    const VecX b = without_contact(s.a, s.contact), A = algorithmic(s, b);
    VecX x = s.x + h * s.v + h * h * ((0.5 - w.beta) * A + w.beta / (1 - w.am) * (w.af * b - w.am * A));
    ContactImpulse(s, h, h).add_to_prediction(h, w.beta / w.gamma, 0.5, x);
    return {std::move(x), h * h * w.scale(), h * h * w.beta / w.gamma};
  }
  void update(const StepStage& stage, const VecX& x, const VecX& contact, VecX& v, VecX& a) const override {
    // From M (x' - x~) = scale f_i' + h^2 k f_c'.
    const double h = stage.h;
    const Weights w(rho_);
    a = (x - predict(stage).x) / (h * h);
    if (contact.size() > 0) a -= w.beta / w.gamma * contact;
    a /= w.scale();
    if (contact.size() > 0) a += contact;
    const EndVelocity end = end_velocity(stage);
    v = end.rate * (x - end.still);
  }
  EndVelocity end_velocity(const StepStage& stage) const override {
    const State& s = stage.state;
    const double h = stage.h, rate = rate_of(h);
    const Weights w(rho_);
    const VecX A = algorithmic(s, without_contact(s.a, s.contact));
    const ContactImpulse impulse(s, h, h);
    // x' with A' = 0 and c' = 0, less what brings v' there to v + h (1 - gamma) A + h s.
    VecX x = s.x + h * s.v + h * h * (0.5 - w.beta) * A, v = s.v + h * (1 - w.gamma) * A;
    impulse.add_to_prediction(h, w.beta / w.gamma, 0.5, x);
    if (impulse.shift.size() > 0) v += h * impulse.shift;
    return {rate, x - v / rate};
  }
  // Error of the rule for smooth forces. Contact that was made or lost acted at an unknown time of
  // the step.
  LocalError local_error(const StepStage& stage, const VecX& x, const VecX& contact) const override {
    const State& old = stage.state;
    const double h = stage.h;
    const Weights w(rho_);
    VecX v, a;
    update(stage, x, contact, v, a);
    const double d = w.af - w.am;
    VecX error = h * h * ((1 + d * d) / 4 - 1.0 / 6) * (a - old.a);
    const double sudden = contact_change(old.contact, contact);
    if (sudden > 0) error += sudden * h * h / 2 * (contact - old.contact);
    return {std::move(error), sudden == 1 ? 1 : 3};
  }
  bool follows_contact() const override { return true; }
  const TimeIntegrator* fallback() const override { return &euler_; }
  bool damps() const override { return rho_ < 1; }
  std::string energy_advice(bool gain, bool contact) const override {
    if (gain) return energy_gain_advice(contact);
    return contact ? short_contact_advice
                   : "generalised-alpha damps what is fast for its steps: refine time.step, or raise rho_inf";
  }
  void update_fixed(const StepStage& stage, const VecX& x, const std::vector<int>& fixed, VecX& v, VecX& a) const override {
    path_.update(stage, x, fixed, v, a);
  }
  void store(const StepStage& stage, const StageEnd& end, const std::vector<int>& fixed, History& history) const override {
    const State& s = stage.state;
    const Weights w(rho_);
    const VecX b = without_contact(s.a, s.contact), b_end = without_contact(end.a, end.contact);
    VecX A = ((1 - w.af) * b_end + w.af * b - w.am * algorithmic(s, b)) / (1 - w.am);
    for (const int i : fixed) vertex(A, i) = vertex(b_end, i);
    history[history_name] = {3, {A.begin(), A.end()}, {}};
  }
  void forget(History& history) const override { history.erase(history_name); }

 private:
  struct Weights {
    explicit Weights(double rho)
        : am((2 * rho - 1) / (rho + 1)), af(rho / (rho + 1)), beta((1 + af - am) * (1 + af - am) / 4), gamma(0.5 + af - am) {}
    double scale() const { return beta * (1 - af) / (1 - am); }
    double am, af, beta, gamma;
  };
  double rate_of(double h) const {
    const Weights w(rho_);
    return w.gamma / (w.beta * h);
  }
  // Returns A at the start of a step; b where a run, or a mesh, is new.
  static VecX algorithmic(const State& s, const VecX& b) {
    const auto found = s.history.find(history_name);
    if (found == s.history.end() || s.h_before == 0 || found->second.values.size() != static_cast<size_t>(b.size())) return b;
    return VecX::Map(found->second.values.data(), b.size());
  }

  double rho_ = 0.8;
  FixedPath path_;
  ImplicitEuler euler_;
};

TACK_REGISTER(TimeIntegrator, GeneralisedAlpha, "generalised_alpha",
              "Second order, with a chosen damping of fast vibrations; contact as an implicit impulse.",
              "Chung and Hulbert 1993, A time integration algorithm for structural dynamics with improved numerical dissipation");

}  // namespace
}  // namespace tack
