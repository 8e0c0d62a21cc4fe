// Path following: quasi-static steps along an equilibrium path on which the load may fall, as it does
// in snap-back and snap-through. The time of the state counts along the path. The load time, at
// which prescribed motion and dead loads are taken, is an unknown; it is stored in the history.
//   arc_speed         each step advances by arc_speed h, as mass-weighted RMS displacement (Riks 1979; Crisfield 1981)
//   dissipation_rate  each step dissipates dissipation_rate h (Verhoosel, Remmers and Gutierrez 2009), or, where less
//                     would dissipate, advances the load time by h, as an ordinary quasi-static step. A load step is
//                     replaced if it does not converge, ends in an unstable equilibrium or dissipates more;
//                     a dissipation step if its load time rises by more than h
// Limits: no inertia, rates, friction, following loads, or motions that begin or end.
#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "framework/bond/bond_term.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/free_bodies.hpp"
#include "framework/stepping/time_config.hpp"
#include "geometry/errors.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"
#include "solvers/path_following/path_newton.hpp"

namespace tack {
namespace {

constexpr const char* history_name = "path_following";

// Last step of the path, as the history has it.
struct PathStep {
  double from = 0, to = 0;   // load times at its ends [s]
  bool dissipation = false;  // its length was its dissipation

  static std::optional<PathStep> of(const History& history) {
    const std::vector<double>* values = history_values(history, history_name, 3, 1);
    if (!values) return {};
    return PathStep{(*values)[0], (*values)[1], (*values)[2] != 0};
  }
  HistoryArray array() const { return {3, {from, to, dissipation ? 1.0 : 0.0}, {}}; }
};

void refuse_if(bool refused, const std::string& what, const std::string& remedy) {
  if (refused) throw InputError(fmt::format("path_following {}; {}, or choose another stepper (incremental_potential)", what, remedy));
}

// Returns whether the potential of a new bond depends on the size of the step.
bool depends_on_rate(const BondLaw& law) {
  std::vector<double> history(law.width());
  law.initialize(false, history.data());
  for (double opening = 1e-9; opening < 1; opening *= 2)
    for (const double slip : {0.0, opening * opening}) {
      const double slow = law.at(opening, slip, history.data(), 1e9).value;
      for (const double h : {1.0, 1e-9})
        if (std::abs(law.at(opening, slip, history.data(), h).value - slow) > 1e-9 * std::abs(slow)) return true;
    }
  return false;
}

class PathFollowingStepper : public Stepper {
 public:
  void fields(Fields& f) override {
    f.optional_number("dissipation_rate", dissipation_rate_, units::power,
                      "dissipation per time of the path: steps in which contact, adhesion and bonds take so much work, or load steps where they would take less")
        .positive();
    f.optional_number("arc_speed", arc_speed_, units::velocity,
                      "mass-weighted RMS displacement of all vertices per time of the path: steps of equal arc length, for snap-through without dissipation")
        .positive();
    f.check("dissipation_rate", [this]() -> std::string {
      return dissipation_rate_.has_value() != arc_speed_.has_value() ? "" : "give either dissipation_rate or arc_speed: one of them is the length of a step along the path";
    });
  }

  void admit(const World& world, const SceneConfig& scene, const TimeConfig& time) const override;
  std::vector<StepMetric> metrics() const override {
    using RunValue = StepMetric::RunValue;
    return {{"load_time", last_.to}, {"path_work", work_, RunValue::sum}, {"load_steps", steps_ && !last_.dissipation && dissipation_rate_ ? 1.0 : 0.0, RunValue::sum},
            {"negative_pivots", double(negative_pivots_)}};
  }
  LoadTimes load_times(const State& state, double h) const override {
    const std::optional<PathStep> last = PathStep::of(state.history);
    return last ? LoadTimes{last->from, last->to} : Stepper::load_times(state, h);
  }
  void prepare(const StepperContext& context) override {
    world_ = &context.world;
    newton_.emplace(context, observers_);
  }
  void begin(bool new_unknowns) override {
    if (new_unknowns) newton_->begin_unknowns();
  }
  void solve(const Step& step, const VecX* guess, SolveResult& result) override;
  Validation validate(const SolveResult& result) override;
  void commit(History& history) const override { history[history_name] = last_.array(); }
  void erase_history(History& history) const override { history.erase(history_name); }

 private:
  PathNewton::Result solve_arc(PathEquations& equations, const Step& step);
  PathNewton::Result solve_dissipation(PathEquations& equations, const Step& step);
  std::optional<PathPoint> secant(const PathEquations& equations, const Step& step);

  std::optional<double> dissipation_rate_, arc_speed_;  // W, m/s

  World* world_ = nullptr;
  std::optional<PathNewton> newton_;
  PathStep last_;            // the latest solve
  double work_ = 0;          // of its dynamic terms [J]
  int negative_pivots_ = 0;  // of its Hessian
  bool steps_ = false;       // there was a solve
  MinimizerResult spent_;    // work of further solves of the step
};

void PathFollowingStepper::admit(const World& world, const SceneConfig& /*scene*/, const TimeConfig& time) const {
  refuse_if(time.integrator->type() != "quasi_static", fmt::format("follows equilibria, and time.integrator is {}", time.integrator->type()), "take quasi_static");
  refuse_if(time.adaptive.has_value(), "has the length of its steps from its own parameter", "take time.adaptive away");
  refuse_if(time.energy_repeats == EnergyRepeats::always, "does not repeat steps for their energy", "take time.energy_repeats away");
  refuse_if(world.friction != nullptr, "knows no friction or tangential adhesion, whose direction is that of time", "take them away");
  refuse_if(!world.damping_terms.empty(), "knows no rates, and an object has damping", "take it away");
  refuse_if(!world.following_loads.empty(), "scales dead loads and prescribed motion alone, and a load follows the configuration", "take a traction or a force");
  refuse_if(world.remeshed != nullptr, "follows one mesh", "take `remesh` away");
  for (const auto& term : world.elastic_terms)
    refuse_if(!term->stores(), fmt::format("knows no rates, and '{}' depends on them", term->name()), "take an elastic energy");
  for (const ActingInteraction& interaction : world.interactions)
    refuse_if(!interaction.terms.empty() && interaction.type != "spring", fmt::format("knows springs and rigid attachments alone between objects, and '{}' is a {}",
              interaction.name, interaction.type), "take it out of the scene");
  for (const PrescribedMotion::Assignment& assignment : world.prescribed_motion.assignments())
    refuse_if(assignment.motion->from() > 0 || std::isfinite(assignment.motion->until()), fmt::format("needs motions that last, and {} begins or ends", assignment.name),
              "take `from` and `until` away");
  refuse_if(!world.constraints.timed().empty(), "needs attachments that last", "take their times away");
  if (!world.bonds) return;
  for (const BondRule& rule : world.bonds->table().rules())
    refuse_if(rule.law->sees_site() || !rule.law->resists_pressing() || std::isfinite(rule.law->longest_step()) || depends_on_rate(*rule.law),
              fmt::format("knows no rates, and a pair adheres by '{}', which depends on them or on time, or heals", rule.type), "take a law without rates (bilinear)");
}

// Returns the prolongation of the last step, truncated to a feasible step.
std::optional<PathPoint> PathFollowingStepper::secant(const PathEquations& equations, const Step& step) {
  const State& state = step.state;
  const std::optional<PathStep> last = PathStep::of(state.history);
  if (!last || state.h_before <= 0 || state.x_before.size() != state.x.size()) return {};
  const double ratio = step.h / state.h_before;
  PathPoint end = equations.start();
  VecX before;
  world_->dofs.gather(state.x_before, before);
  end.q += ratio * (end.q - before);
  end.load_time += ratio * (last->to - last->from);
  return newton_->truncated(equations, equations.start(), end);
}

PathNewton::Result PathFollowingStepper::solve_arc(PathEquations& equations, const Step& step) {
  const double length = *arc_speed_ * step.h;
  const std::optional<PathPoint> guess = secant(equations, step);
  return newton_->solve(equations, step.potential, PathConstraint::arc_length, length,
                        guess ? *guess : newton_->along_tangent(equations, step.potential, PathConstraint::arc_length, length));
}

PathNewton::Result PathFollowingStepper::solve_dissipation(PathEquations& equations, const Step& step) {
  const double length = *dissipation_rate_ * step.h;
  const std::optional<PathStep> last = PathStep::of(step.state.history);
  const auto by_load = [&] {
    last_.dissipation = false;
    return newton_->solve(equations, step.potential, PathConstraint::load_time, step.h, equations.start());
  };
  const auto by_dissipation = [&] {
    last_.dissipation = true;
    return newton_->solve(equations, step.potential, PathConstraint::dissipation, length, *secant(equations, step));
  };
  const auto admissible = [&](const PathNewton::Result& load) {
    if (!load.converged() || load.negative_pivots > 0) return false;
    equations.move_to(load.point);
    return equations.value(PathConstraint::dissipation, load.point) <= length;
  };
  if (!last) return by_load();
  if (last->dissipation) {
    PathNewton::Result dissipating = by_dissipation();
    if (dissipating.converged() && dissipating.point.load_time - equations.start().load_time <= step.h) return dissipating;
    PathNewton::Result load = by_load();
    spent_.add_work(dissipating.work);
    if (admissible(load)) return load;
    last_.dissipation = true;
    return dissipating;
  }
  PathNewton::Result load = by_load();
  if (admissible(load)) return load;
  spent_.add_work(load.work);
  return by_dissipation();
}

void PathFollowingStepper::solve(const Step& step, const VecX* /*guess*/, SolveResult& result) {
  newton_->begin_step(step);
  spent_ = {};
  last_ = {};
  last_.from = last_.to = load_times(step.state, step.state.h_before).to;
  PathEquations equations(*world_, step, last_.from);
  try {
    const PathNewton::Result solved = arc_speed_ ? solve_arc(equations, step) : solve_dissipation(equations, step);
    result.minimizer = solved.work;
    result.minimizer.add_work(spent_);
    result.unbalanced_force = solved.force_residual.residual;
    result.tolerated_force = solved.force_residual.limit;
    last_.to = solved.point.load_time;
    negative_pivots_ = solved.negative_pivots;
    result.x = equations.configuration(solved.point);
    equations.move_to(solved.point);
    work_ = equations.value(PathConstraint::dissipation, solved.point);
  } catch (const FreeBody& free) {
    result.failure = free.what();
  }
  steps_ = true;
  result.metrics = metrics();
}

Validation PathFollowingStepper::validate(const SolveResult& result) {
  Validation v{result.failure, result.failure.empty() ? "refine time.step, or lower dissipation_rate or arc_speed" : FreeBody::remedy};
  if (!v.fault.empty()) return v;
  if (result.minimizer.status != MinimizerStatus::converged) {
    v.fault = fmt::format("the step along the path did not converge: {} after {} iterations, {:.3g} times the tolerance{}", status_text(result), result.minimizer.iterations, result.minimizer.residual, newton_->blocker());
    return v;
  }
  if (const int tet = first_inverted_tet(world_->tets, result.x); tet >= 0) {
    v.inverted_tets = 1;
    v.reason = Rejection::inversion;
    v.fault = fmt::format("tet {} inverted", tet);
  } else if (world_->contact) {
    v.intersections = static_cast<int>(find_intersections(world_->contact->surface().mesh, result.x, world_->contact->colliding(), 1).size());
    if (v.intersections > 0) v.fault = "the surfaces intersect", v.reason = Rejection::intersection;
  }
  return v;
}

TACK_REGISTER(Stepper, PathFollowingStepper, "path_following",
              "Follows an equilibrium path on which the load may fall (snap-back, snap-through), in steps of equal dissipation or arc length. `time.step` and "
              "`duration` count along the path; motions and loads are taken at the load time, which is found.",
              "Verhoosel, Remmers and Gutierrez 2009; Riks 1979");

}  // namespace
}  // namespace tack
