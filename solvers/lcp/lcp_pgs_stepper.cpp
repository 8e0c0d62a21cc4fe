// Integrator with constraints instead of potentials, for comparison. Implicit Euler is linearised;
// contact is a linear complementarity problem with Coulomb friction and adhesion as rows; projected
// Gauss-Seidel solves it within its limit of sweeps (Otaduy et al. 2009, with adhesion Gascon et
// al. 2010). Surfaces may pass through each other: exact predicates count such crossings, which are
// recorded and reported.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <set>

#include "framework/bond/bond_term.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/stepping/time_config.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"
#include "solvers/lcp/bond_rows.hpp"
#include "solvers/lcp/lcp_records.hpp"
#include "solvers/lcp/lcp_step.hpp"

namespace tack {
namespace {

// Fraction of the minimiser's tolerance: sweeps are cheap, and the forces depend on them.
constexpr double of_tolerance = 1e-3;
constexpr int most_crossings = 1000000;

void refuse_unless(bool can, const std::string& what, const std::string& remedy) {
  if (!can) throw InputError(fmt::format("lcp_pgs {}; {}, or choose another stepper (incremental_potential)", what, remedy));
}

class LcpPgsStepper : public Stepper {
 public:
  void fields(Fields& f) override {
    f.optional_number("margin", margin_, units::length, "gap that surfaces keep; half of contact.distance unless given. Surfaces that start closer "
                                                        "are not pushed apart").positive();
    f.number("recovery", recovery_, units::none, "fraction of a gap error or penetration that is corrected per step; 1 throws surfaces apart").positive().at_most(1);
    f.integer("sweeps", sweeps_, "largest number of projected Gauss-Seidel sweeps per step; the remaining residual is accepted and reported").at_least(1);
    f.optional_number("tolerance", tolerance_, units::velocity,
                      "sweeps end when velocities change by less; a thousandth of solver.tolerance unless given").positive();
    f.integer("dense_rows", dense_rows_, "rows up to which the operator between impulses and velocities is one dense "
                                         "matrix; beyond, dense blocks of that size are coupled by one solve per "
                                         "block and sweep").at_least(3);
    f.component("linear", linear_, "solver of the linearised step");
  }

  void admit(const World& world, const SceneConfig& scene, const TimeConfig& time) const override;
  std::vector<StepMetric> metrics() const override {
    using RunValue = StepMetric::RunValue;
    return {{"sweeps", step_ ? double(step_->sweeps()) : 0, RunValue::sum}, {"rows", step_ ? double(step_->rows()) : 0}, {"row_residual", step_ ? step_->residual() : 0},
            {"penetration", deepest_}, {"crossing_pairs", double(crossings_)}};
  }
  void prepare(const StepperContext& context) override {
    world_ = &context.world;
    LcpSettings settings;
    settings.margin = margin_.value_or(context.scene.contact ? context.scene.contact->contact_distance / 2 : 0);
    settings.tolerance = tolerance_.value_or(of_tolerance * context.solver.velocity_tolerance());
    settings.sweeps = sweeps_;
    settings.dense_rows = dense_rows_;
    settings.recovery = recovery_;
    step_ = std::make_shared<LcpStep>(*world_, context.clock, *linear_, settings);
    publish_impulses(*world_, step_);
    clock_ = &context.clock;
  }
  void begin(bool new_unknowns) override {
    if (new_unknowns) step_->new_unknowns();
  }
  void solve(const Step& step, const VecX* guess, SolveResult& result) override;
  Validation validate(const SolveResult& result) override;
  void commit(History& history) const override {
    if (world_->contact) step_->stored().write(history, world_->contact->surface());
  }
  void erase_history(History& history) const override { StoredContacts::erase(history); }

 private:
  std::optional<double> margin_, tolerance_;  // m, m/s
  double recovery_ = 0.2;
  int sweeps_ = 100, dense_rows_ = 3000;
  std::unique_ptr<LinearSolver> linear_ = Registry<LinearSolver>::make("cholmod");

  World* world_ = nullptr;
  PhaseClock* clock_ = nullptr;
  std::shared_ptr<LcpStep> step_;  // shared: results may outlive the stepper
  int crossings_ = 0;
  double deepest_ = 0;  // m
};

void LcpPgsStepper::admit(const World& world, const SceneConfig& scene, const TimeConfig& time) const {
  refuse_unless(time.integrator->type() == "implicit_euler", fmt::format("is implicit Euler, linearised, and time.integrator is {}", time.integrator->type()),
                "take implicit_euler");
  for (const Body& body : world.bodies)
    refuse_unless(body.edges.empty() && body.points.empty(), fmt::format("has rows for surfaces alone, and '{}' has {}", body.name,
                  body.edges.empty() ? "particles" : "rods"), "take it out of the scene");
  if (!scene.contact) return;
  refuse_unless(scene.contact->lagging.iterations == 1 && !scene.contact->lagging.until, "finds friction and what presses together, without contact.lagging",
                "take `lagging` away");
  const PairTable& pairs = world.contact->pairs();
  refuse_unless(pairs.region_sets().empty(), "has one friction and adhesion for two objects, and contact.pairs names parts of some", "name whole objects");
  for (size_t i = 0; i < pairs.laws().size(); ++i) {
    refuse_unless(pairs.tangential(static_cast<int>(i)).mu_static == pairs.tangential(static_cast<int>(i)).mu, "has one coefficient of friction", "take `mu_static` away");
    refuse_unless(pairs.tangential(static_cast<int>(i)).across == 1, "has the same friction in all directions", "take `mu_across` away");
    refuse_unless(!pairs.tangential(static_cast<int>(i)).sticks(), "sticks without `model: stick`", "take it away");
    refuse_unless(pairs.tangential(static_cast<int>(i)).mu_a == 0, "knows no tangential adhesion beside that of RCC", "take `tangential_adhesion` away");
    for (const auto& law : pairs.laws()[i].laws())
      refuse_unless(dynamic_cast<const NormalAdhesion*>(law.get()) == nullptr, fmt::format("has rows for RCC adhesion alone, and a pair adheres by '{}'", law->name()),
                    "take adhesion: {type: rcc} or rcc_explicit");
  }
  if (!world.bonds) return;
  for (const BondRule& rule : world.bonds->table().rules())
    refuse_unless(rule.type == "rcc" || rule.type == "rcc_explicit", fmt::format("has rows for RCC adhesion alone, and a pair adheres by '{}'", rule.type),
                  "take adhesion: {type: rcc} or rcc_explicit");
}

void LcpPgsStepper::solve(const Step& step, const VecX* /*guess*/, SolveResult& result) {
  crossings_ = 0;
  deepest_ = 0;
  step_->solve(step, result);
  const bool solved = result.minimizer.status == MinimizerStatus::converged || result.minimizer.status == MinimizerStatus::iteration_limit;
  if (solved && world_->contact) {
    if (world_->bonds) world_->bonds->set_pressures(bond_pressures(*world_->bonds, step_->contacts(), *world_->contact));
    const PhaseScope scope(*clock_, Phase::check);
    const ContactSystem& contact = *world_->contact;
    crossings_ = static_cast<int>(find_intersections(contact.surface().mesh, result.x, contact.colliding(), most_crossings).size());
    deepest_ = step_->deepest();
  }
  result.metrics = metrics();
}

Validation LcpPgsStepper::validate(const SolveResult& result) {
  Validation v{"", "refine time.step"};
  const MinimizerStatus status = result.minimizer.status;
  if (status != MinimizerStatus::converged && status != MinimizerStatus::iteration_limit) {
    v.fault = status_text(result);
    return v;
  }
  if (const int tet = first_inverted_tet(world_->tets, result.x); tet >= 0) {
    v.inverted_tets = 1;
    v.reason = Rejection::inversion;
    v.fault = fmt::format("tet {} inverted", tet);
  }
  v.intersections = crossings_;
  if (crossings_ > 0)
    v.warning = fmt::format("surfaces have passed through each other: {} pairs of an edge and a triangle cross, {:.3g} m deep; lcp_pgs keeps that (refine time.step, "
                         "raise time.stepper.sweeps, or take the stepper incremental_potential)", crossings_, deepest_);
  return v;
}

TACK_REGISTER(Stepper, LcpPgsStepper, "lcp_pgs",
              "Linearised implicit Euler with contact, friction and RCC adhesion as constraints, solved by projected Gauss-Seidel; surfaces may pass through each "
              "other, which is recorded. A baseline to compare with.",
              "Gascon et al. 2010; Otaduy et al. 2009");

}  // namespace
}  // namespace tack
