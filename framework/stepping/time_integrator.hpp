// Time integration as a minimisation: a stage of a step solves
//     x* = argmin 1/2 |x - x~|_M^2 + beta h^2 P(x)      (the paper, eq. 1),
// where dynamic terms (contact, friction, bonds, ...: Term::dynamic) may have a factor of their
// own. Most integrators have one stage, the step itself.
//
// Several stages: the time loop solves them one after another. The end of a stage is a state like
// that of a step: it neither intersects nor inverts, terms store their history there, and the next
// stage starts from it. A stage that fails restores the state at the start of the step. Stages
// therefore end at ascending times, the last one at the end of the step.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "framework/assembly/term_scales.hpp"
#include "framework/config/registry.hpp"
#include "framework/core/state.hpp"

namespace tack {

/// The end of a stage (3n each): positions [m], velocities [m/s], accelerations [m/s^2], and those
/// by dynamic terms (State::contact).
struct StageEnd {
  VecX x, v, a, contact;
};

/// A stage of a step that is to be solved, or was just solved.
struct StepStage {
  const State& state;              // at its start: the end of the stage before it, if there is one
  double h;                        // its length [s]
  const State& start;              // at the start of the step
  double step;                     // size of the step [s]
  std::span<const StageEnd> ends;  // of the earlier stages of the step

  /// The only stage of a step of size `size` from `from`.
  StepStage(const State& from, double size) : state(from), h(size), start(from), step(size) {}
  StepStage(const State& from, double length, const State& step_start, double step_size,
            std::span<const StageEnd> earlier)
      : state(from), h(length), start(step_start), step(step_size), ends(earlier) {}

  /// Returns the index of the stage, from 0.
  size_t index() const { return ends.size(); }
};

class TimeIntegrator : public Component {
 public:
  static constexpr const char* kind_name = "integrator";
  static constexpr const char* kind_doc = "Turns a time step into a minimisation.";

  struct Prediction {
    VecX x;                        // x~ (3n)
    double scale = 1;              // beta h^2 [s^2]; 1 when quasi-static
    double contact_scale = scale;  // of dynamic terms
    bool inertia = true;           // as inertia()
    // Impulse of contact on the velocities at the end of the stage, over its force [s]; 0: the
    // scale of dynamic terms times the rate of the end velocity.
    double contact_time = 0;
    TermScales scales() const { return {scale, contact_scale}; }
  };
  // Returns the ends of the stages as fractions of the step: ascending, the last one 1.
  virtual std::vector<double> stages() const { return {1}; }
  // Returns the prediction of a stage.
  virtual Prediction predict(const StepStage& stage) const = 0;
  // Returns velocities and accelerations for the end x (3n) of a stage; the caller sets time and
  // history. contact: the value that State::contact will have.
  virtual void update(const StepStage& stage, const VecX& x, const VecX& contact, VecX& v,
                      VecX& a) const = 0;
  // Error of a step, estimated by a formula of another order.
  struct LocalError {
    VecX x;     // of the positions at the end of the step (3n) [m]
    int power;  // of h with which the error falls
  };
  // Returns the estimated error of the step whose last stage ends at x (3n).
  virtual LocalError local_error(const StepStage& stage, const VecX& x,
                                 const VecX& /*contact*/) const {
    return {0.5 * (x - stage.start.x - stage.step * stage.start.v), 2};
  }
  // Returns the velocity at the end of a stage as update() computes it, but for sudden contact;
  // undefined without inertia.
  virtual EndVelocity end_velocity(const StepStage& stage) const {
    return {1 / stage.h, stage.state.x};
  }
  // Returns whether steps have inertia; quasi-static ones have none.
  virtual bool inertia() const { return true; }
  // Returns whether the integrator uses State::contact, which stays empty otherwise.
  virtual bool follows_contact() const { return false; }
  // Stores arrays of the integrator's own for later steps, under names that contain no object, when
  // a stage with this end is accepted. fixed: the vertices with prescribed motion.
  virtual void store(const StepStage& /*stage*/, const StageEnd& /*end*/,
                     const std::vector<int>& /*fixed*/, History& /*history*/) const {}
  // Erases what store() stored: accelerations were set anew.
  virtual void forget(History& /*history*/) const {}
  // Returns the integrator that repeats a step with a noticeable numerical energy gain
  // (energy_balance.hpp); null: the step is accepted.
  virtual const TimeIntegrator* fallback() const { return nullptr; }
  // Returns whether the integrator brings undriven motion to rest.
  virtual bool damps() const { return false; }
  // Returns advice on a numerical energy gain (`gain`) or loss, mostly in steps with `contact` or
  // without.
  virtual std::string energy_advice(bool /*gain*/, bool /*contact*/) const {
    return "refine time.step";
  }
  // Corrects velocities and accelerations of vertices with prescribed motion, if update() would
  // carry velocities over from step to step. fixed: these vertices.
  virtual void update_fixed(const StepStage& /*stage*/, const VecX& /*x*/,
                            const std::vector<int>& /*fixed*/, VecX& /*v*/, VecX& /*a*/) const {}
};

}  // namespace tack
