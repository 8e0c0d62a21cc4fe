// Forces of dynamic terms in all integrators: bonds of every law, and a term that only declares
// itself dynamic. At rest they carry the weight, on a circle m w^2 r, for any step size.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/body/body.hpp"
#include "framework/core/linear_term.hpp"
#include "framework/scene/energy.hpp"
#include "framework/stepping/time_integrator.hpp"
#include "tests/support/bond_laws.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// k/2 |x_v - X_v|^2 of every vertex of an object within a distance of its rest position; 0 beyond.
class SnappingTerm : public Term {
 public:
  SnappingTerm(const Body& body, const VecX& rest, double stiffness, double length) : Term("snapping"), rest_(rest), stiffness_(stiffness), length_(length) {
    for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) vertices_.push_back(v);
  }
  bool dynamic() const override { return true; }
  void move_to(const VecX& x) override {
    acting_.clear();
    for (const int v : vertices_)
      if (displacement(v, x).norm() < length_) acting_.push_back(v);
  }
  double value(const VecX& x) const override {
    double sum = 0;
    for (const int v : vertices_) sum += 0.5 * stiffness_ * std::min(displacement(v, x).squaredNorm(), length_ * length_);
    return sum;
  }
  std::vector<StencilBatch> batches() const override { return {{1, static_cast<int>(acting_.size()), acting_.data()}}; }
  void derivatives(const VecX& x, Projection, double* gradient, double* hessian) const override {
    for (size_t i = 0; i < acting_.size(); ++i) {
      Eigen::Map<Vec3>(gradient + 3 * i) = stiffness_ * displacement(acting_[i], x);
      if (hessian) Eigen::Map<Mat3>(hessian + 9 * i) = stiffness_ * Mat3::Identity();
    }
  }

 private:
  Vec3 displacement(int v, const VecX& x) const { return vertex(x, v) - vertex(rest_, v); }

  VecX rest_;
  double stiffness_, length_;  // N/m, m
  std::vector<int> vertices_, acting_;
};

class Snapping : public Energy {
 public:
  void fields(Fields& f) override {
    f.number("stiffness", stiffness_, units::stiffness, "of each vertex").positive();
    f.number("length", length_, units::length, "at which it lets go").positive();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    return std::make_unique<SnappingTerm>(body, rest, stiffness_, length_);
  }

 private:
  double stiffness_ = 1, length_ = 1;  // N/m, m
};

TACK_REGISTER(Energy, Snapping, "snapping", "Holds every vertex to where it was, and lets go.", "tests");

bool has_inertia(const std::string& integrator) { return integrator != "quasi_static"; }

// A cube of 1 g hangs from a fixed one by bonds, beyond the range of the barrier. Their stiffness is 40 N/m to 40 kN/m.
constexpr double mass = 1e-3, area = 1e-4;  // kg, m^2
std::string hanging(const std::string& integrator, double h, const std::string& law, double weight, double damping) {
  return fmt::format(
      "time: {{step: {}, duration: 1, integrator: {}}}\n"
      "gravity: [0, {}, 0]\n"
      "objects:\n"
      "  - {{name: hold, shape: {{type: box, size: [0.02, 0.02, 0.02], cells: [2, 1, 2]}}, place: {{translate: [0, 0.01, 0]}}, motion: [fixed]}}\n"
      "  - {{name: cube, shape: {{type: box, size: [0.01, 0.01, 0.01], cells: [2, 1, 2]}}, place: {{translate: [0, -0.0056, 0]}},\n"
      "     body: {{type: affine, density: 1000}}{}}}\n"
      "contact:\n"
      "  distance: 0.5 mm\n"
      "  pairs: [{{between: [cube, hold], adhesion: {}, bond_distance: 0.9 mm}}]\n"
      "solver: {{type: projected_newton, tolerance: 1e-7, force_floor: 1e-9}}\n"
      "probes: [{{name: pull, type: contact_force, on: cube, from: hold}}]\n",
      h, integrator, -weight / mass, has_inertia(integrator) ? fmt::format(", damping: {{mass: {}}}", damping) : "", law);
}

}  // namespace

TEST_CASE("a cube at rest loads its bonds with its weight: every integrator, every law", "[dynamic]") {
  const std::vector<std::map<std::string, std::string>> settings = {
      {},
      {{"envelope", "{type: expression, traction: 1e9 * d * exp(-d / 1e-5), range: 2e-4}"}},
      {{"tangential_stiffness", "5e7"}},
      {{"activation_energy", "6e4"}},
      {{"tangential_strength", "5e3"}},
      {{"law", "{type: bilinear, peak_traction: 1e4, work_of_adhesion: 1}"}},
      {{"tangential_strength", "2e4"}, {"tangential_work", "3"}}};
  std::vector<std::string> tested;
  for (const ComponentVariant& law : variants<AdhesionLaw, BondLaw>(settings)) {
    if (std::find(tested.begin(), tested.end(), law.type) != tested.end()) continue;
    tested.push_back(law.type);
    const auto bond = bond_law(law.yaml);
    // The start is critically damped, from a load of a fiftieth of the strength.
    const double d = 1e-9, stiffness = area * PulledBond(*bond).step(d, 0, 1).by_d / d, weight = 0.02 * area * bond->peak_traction();
    const double omega = std::sqrt(stiffness / mass);
    for (const std::string& integrator : Registry<TimeIntegrator>::kind().names())
      for (const double h : {3.5e-4, 1e-4}) {
        INFO(integrator << ", h " << h << " s, " << law.yaml << ", " << omega << " rad/s");
        TestRun run(hanging(integrator, h, law.yaml, weight, 2 * omega));
        const int steps = has_inertia(integrator) ? static_cast<int>(std::ceil(20 / (omega * h))) + 20 : 2;
        while (run.state().time < steps * h * (1 - 1e-9)) run.step();
        CHECK(run.sample(0)[1] == Approx(weight).epsilon(2e-3));
      }
  }
  CHECK(tested.size() >= 6);
}

TEST_CASE("bonds carry a cube on a circle with m w^2 r: every integrator", "[dynamic]") {
  constexpr double w = 50, h = M_PI / 180 / w, x = 0.10545;  // rad/s, s, m
  for (const std::string& integrator : Registry<TimeIntegrator>::kind().names()) {
    if (!has_inertia(integrator)) continue;
    INFO(integrator);
    TestRun run(fmt::format(
        "time: {{step: {}, duration: 1, integrator: {}}}\n"
        "objects:\n"
        "  - {{name: hold, shape: {{type: box, size: [0.02, 0.02, 0.02], cells: [1, 2, 2]}}, place: {{translate: [0.09, 0, 0]}},\n"
        "     motion: [{{type: rotate, axis: [0, 0, 1], angular_velocity: {}}}]}}\n"
        "  - {{name: cube, shape: {{type: box, size: [0.01, 0.01, 0.01], cells: [1, 2, 2]}}, place: {{translate: [{}, 0, 0]}},\n"
        "     velocity: [0, {}, 0], spin: [0, 0, {}], body: {{type: affine, density: 1000}}}}\n"
        "contact:\n"
        "  distance: 0.4 mm\n"
        "  pairs: [{{between: [cube, hold], adhesion: {{type: bilinear, peak_traction: 8 kPa, work_of_adhesion: 1 J/m^2, onset: 100 um}}, bond_distance: 0.55 mm}}]\n"
        "solver: {{type: projected_newton, tolerance: 1e-6}}\n"
        "probes: [{{name: pull, type: contact_force, on: cube, from: hold}}, {{name: centre, type: centre_of_mass, object: cube}}]\n",
        h, integrator, w, x, w * x, w));
    // It swings on its bonds, with 6 steps or more per period.
    double ratio = 0;
    constexpr int before = 30, steps = 150;
    for (int i = 0; i < steps;) {
      run.step();
      if (run.state().time < (i + 1) * h * (1 - 1e-9)) continue;
      const auto force = run.sample(0), centre = run.sample(1);
      if (i++ >= before) ratio -= (force[0] * centre[0] + force[1] * centre[1]) / (mass * w * w * (centre[0] * centre[0] + centre[1] * centre[1])) / (steps - before);
    }
    // The probe has the force at ends of steps. Those of the last of three stages are off by 7%.
    CHECK(ratio == Approx(1).epsilon(integrator == "documented_sdirk3" ? 0.1 : 0.02));
  }
}

TEST_CASE("a term that declares itself dynamic is integrated as one, without contact in the scene", "[dynamic]") {
  const auto scene_of = [](const std::string& integrator, double h, const std::string& more) {
    return fmt::format("time: {{step: {}, duration: 1, integrator: {}}}\n", h, integrator) +
           "solver: {type: projected_newton, tolerance: 1e-9, force_floor: 1e-9}\n"
           "objects: [{name: cube, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [1, 1, 1]},\n"
           "  energies: [{type: neo_hookean, young: 1 MPa, density: 1000}, {type: snapping, stiffness: 100, length: 0.05}]" + more;
  };
  for (const std::string& integrator : Registry<TimeIntegrator>::kind().names()) {
    if (!has_inertia(integrator)) continue;
    INFO(integrator);
    // Rest position of 1 kg on 800 N/m.
    TestRun resting("gravity: [0, -9.81, 0]\n" + scene_of(integrator, 0.01, ", damping: {mass: 57}}]\n"));
    while (resting.state().time < 0.6 * (1 - 1e-9)) resting.step();
    double force = 0;
    for (int v = 0; v < 8; ++v) force += 100 * (resting.rest(v) - resting.at(v)).y();
    CHECK(force == Approx(9.81).epsilon(1e-3));
    // The term becomes zero during the motion; two-step integrators drop their history there.
    TestRun leaving(scene_of(integrator, 0.01, ", velocity: [2, 0, 0]}]\n"));
    for (int i = 0; i < 40 && (leaving.at(0) - leaving.rest(0)).x() < 0.05; ++i) leaving.step();
    const bool follows = leaving.config.time.integrator->follows_contact();
    CHECK((leaving.state().contact.size() > 0) == follows);
    const bool staged = leaving.config.time.integrator->stages().size() > 1;
    if (follows) CHECK((leaving.state().contact.isZero() && (staged || !leaving.state().contact_before.isZero())));
    leaving.step();
    const State& s = leaving.state();
    if (integrator == "bdf2") CHECK((s.v - (s.x - s.x_before) / s.h_before).isZero(1e-12));
  }
}

TEST_CASE("a linear dynamic term has the scale of dynamic terms in value and gradient alike", "[dynamic]") {
  struct Push : LinearTerm {
    Push() : LinearTerm("push") { set_force(VecX::Constant(6, 2)), set_reference(VecX::Zero(6)); }
    bool dynamic() const override { return true; }
  } const push;
  LinearTerm load("load");
  load.set_force(VecX::Constant(6, 5));
  load.set_reference(VecX::Zero(6));
  const DofMap dofs(std::vector<char>(2, 1), {});
  PhaseClock clock;
  IncrementalPotential potential({&push, &load, &push}, dofs, VecX::Ones(2), clock);
  potential.begin_step(VecX::Zero(6), VecX::Zero(6), {3, 7}, false);
  potential.move_to(VecX::Constant(6, 0.5));
  CHECK(potential.value() == Approx(-0.5 * 6 * (3 * 5 + 2 * 7 * 2)));
  CHECK(potential.gradient().isApprox(VecX::Constant(6, -(3 * 5 + 2 * 7 * 2))));
}

TEST_CASE("every term that publishes forces or energies of contact is dynamic", "[dynamic]") {
  TestScene test(
      "time: {step: 1e-4, duration: 1e-3, integrator: newmark}\n"
      "objects:\n"
      "  - {name: lower, shape: {type: box, size: [1, 0.1, 1], cells: [2, 1, 2]}, motion: [fixed]}\n"
      "  - {name: upper, shape: {type: box, size: [1, 0.1, 1], cells: [3, 1, 3]}, place: {translate: [0.1, 0.1005, 0]}, energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3}]}\n"
      "  - {name: stamp, shape: {type: box, size: [1, 0.1, 1], cells: [1, 1, 1]}, place: {translate: [0.1, 0.201, 0]}, energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3}]}\n"
      "contact:\n"
      "  distance: 0.4 mm\n"
      "  pairs:\n"
      "    - {between: [upper, lower], adhesion: {type: fang, peak_traction: 1 kPa, peak_distance: 1 mm, range: 2 mm}, friction: {mu: 0.3}}\n"
      "    - {between: [upper, stamp], adhesion: {type: bonded, peak_traction: 10 kPa}, bond_distance: 0.7 mm}\n");
  int in_contact = 0;
  for (const Term* term : test.world->terms) {
    Records records;
    records.publish(*term);
    const bool of_contact =
        std::any_of(records.energies().begin(), records.energies().end(),
                    [](const EnergyRecord& e) { return e.kind == EnergyKind::contact; }) ||
        std::any_of(records.forces().begin(), records.forces().end(), [](const ForceRecord& f) { return f.direction != ForceDirection::other; });
    if (!of_contact) continue;
    ++in_contact;
    INFO(term->name());
    CHECK(term->dynamic());
  }
  CHECK(in_contact == 5);  // contact, overlap-boundary forces, overhangs, bonds, friction
}
