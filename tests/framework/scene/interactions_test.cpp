// The builder of interactions and unknowns, with an interaction of the tests: bodies, selections
// and errors; unknowns in steps, resumed runs and initial states; dependent vertices; objects
// without contact.
#include <catch2/catch.hpp>
#include <numbers>

#include "framework/assembly/formula_term.hpp"
#include "framework/checks/derivative_check.hpp"
#include "framework/core/records.hpp"
#include "framework/run/gradient_check.hpp"
#include "framework/scene/energy_with_unknowns.hpp"
#include "framework/setup/initial_state.hpp"
#include "framework/setup/interaction_builder.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;
using Catch::Contains;

namespace {

// k/2 (n - goal)^2 of a number n.
struct Held : FormulaOf<1, 1> {
  struct Data {
    double stiffness, goal, length;  // J, 1, m
  };
  template <class T>
  T energy(const Positions<T>& x, const Data& d) const {
    const T off = x[0].x() / d.length - d.goal;
    return 0.5 * d.stiffness * off * off;
  }
};

// Energy k/2 |x_b - x_a - n e|^2 of two points and a scalar, a displacement along x.
struct Pushed : FormulaOf<3, 1> {
  struct Data {
    double stiffness;  // N/m
  };
  template <class T>
  T energy(const Positions<T>& x, const Data& d) const {
    Eigen::Matrix<T, 3, 1> off = x[1] - x[0];
    off.x() -= x[2].x();
    return 0.5 * d.stiffness * off.squaredNorm();
  }
};

// A rod of unknown length between points of two objects, which a spring and inertia of its own hold. It remembers how many steps it has seen.
class JackTerm : public FormulaTerm<Pushed> {
 public:
  JackTerm(std::string memory) : FormulaTerm("jacks"), memory_(std::move(memory)) {}
  void load_history(const History& history) override {
    const std::vector<double>* steps = history_values(history, memory_, 1, 1);
    steps_ = steps ? steps->front() : 0;
  }
  void commit(const VecX&, History& history) const override { history[memory_] = {1, {steps_ + 1}, {}}; }
  double steps() const { return steps_; }

 private:
  std::string memory_;
  double steps_ = 0;
};

class Jack : public Interaction {
 public:
  void fields(Fields& f) override {
    Interaction::fields(f);
    f.texts("between", between_, "two objects").required();
    f.vector("at", at_, units::length, "where it is on both");
    f.number("stiffness", stiffness_, units::stiffness, "of its ends");
    f.number("spring", spring_, units::energy, "of the number");
    f.number("goal", goal_, units::none, "of the number");
    f.number("mass", mass_, units::mass, "of the number");
    f.number("scale", scale_, units::length, "what one of it is");
    f.flag("tied", tied_, "the second end follows the first");
    f.flag("joined", joined_, "no contact");
    f.flag("prescribed", prescribed_, "the number goes from 0 to the goal within 0.1 s");
    f.flag("free", free_, "contact.overclosure_adjustment may move its objects");
  }
  std::vector<std::string> objects() const override { return between_; }
  bool keeps_placement() const override { return !free_; }
  void build(InteractionBuilder& builder) const override {
    const int a = builder.body(between_.at(0)), b = builder.body(between_.at(1));
    const int from = builder.attachment_point(a, at_), to = builder.attachment_point(b, at_);
    if (joined_) builder.exclude_contact(a, b);
    if (tied_) return builder.make_dependent({{to, {{from, 1.0}}}});
    const ScalarDofs n = builder.unknowns().add_scalar_dofs("way", 1, scale_, 0, mass_);
    auto jack = std::make_unique<JackTerm>(builder.add_history("steps", 1, 1));
    jack->add({from, to, n.vertices[0]}, {stiffness_});
    builder.add(std::move(jack));
    if (prescribed_) return builder.unknowns().prescribe(n, std::array{0}, Schedule({{0, 0}, {0.1, goal_}}));
    auto held = std::make_unique<FormulaTerm<Held>>("held");
    held->add({n.vertices[0]}, {spring_, goal_, scale_});
    builder.add(std::move(held));
  }

 private:
  std::vector<std::string> between_;
  Vec3 at_ = Vec3::Zero();
  double stiffness_ = 1e4, spring_ = 1, goal_ = 0.1, mass_ = 0, scale_ = 0.1;
  bool tied_ = false, joined_ = false, prescribed_ = false, free_ = false;
};
TACK_REGISTER(Interaction, Jack, "test_jack", "A rod of unknown length.", "tests");

// Places without mass halfway between neighbours, as an energy asks for them: each is pulled to both ends of an edge.
class Middles : public EnergyWithUnknowns {
 public:
  std::unique_ptr<Term> make_with_unknowns(const Body& body, const VecX& rest, Unknowns unknowns) const override {
    std::vector<Vec3> at;
    for (const Edge& e : body.edges) at.push_back((vertex(rest, e[0]) + vertex(rest, e[1])) / 2 + Vec3(0, 0.1, 0));
    const std::vector<int> middles = unknowns.add_vector_dofs("middles", at);
    auto term = std::make_unique<FormulaTerm<Halves>>("middles");
    for (size_t e = 0; e < middles.size(); ++e) term->add({body.edges[e][0], body.edges[e][1], middles[e]}, {});
    return term;
  }

 private:
  struct Halves : FormulaOf<3> {
    struct Data {};
    template <class T>
    T energy(const Positions<T>& x, const Data&) const {
      return 1e3 * ((x[2] - x[0]).squaredNorm() + (x[2] - x[1]).squaredNorm());
    }
  };
};
TACK_REGISTER(Energy, Middles, "test_middles", "Middles of edges as unknowns.", "tests");

std::string scene(const std::string& interactions, const std::string& more = "") {
  return "time: {step: 5 ms, duration: 1}\nsolver: {type: projected_newton, tolerance: 1e-8}\nobjects:\n"
         "  - {name: wall, groups: [things], shape: {type: box, size: [0.1, 0.1, 0.1]}, motion: [fixed]}\n"
         "  - {name: cart, groups: [things], shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0.1, 0, 0]}, body: {type: affine, density: 1000}}\n"
         "interactions: [" + interactions + "]\n" + more;
}
const std::string at = "at: [0.05, 0, 0]";

const UnknownGroup& group_of(const World& world, const std::string& name) {
  for (const UnknownGroup& group : world.unknowns)
    if (group.name == name) return group;
  throw std::logic_error("there are no such unknowns");
}

}  // namespace

TEST_CASE("objects of an interaction are found, or refused with source location and nearest name", "[interactions]") {
  const auto error = [](const std::string& interactions) { TestScene{scene(interactions)}; };
  CHECK_THROWS_WITH(error("{type: test_jack, between: [wal, cart]}"), Contains("test.yaml:7:16: interaction 'test_jack 0': ") && Contains("'wal'") && Contains("wall"));
  CHECK_THROWS_WITH(error("{type: test_jack, name: wall, between: [wall, cart]}"), Contains("interaction 'wall' has the name of an object"));
  CHECK_THROWS_WITH(error("{type: test_jack, name: j, between: [wall, cart]}, {type: test_jack, name: j, between: [wall, cart]}"), Contains("two interactions are named 'j'"));
  CHECK_THROWS_WITH(error("{type: test_jak, between: [wall, cart]}"), Contains("unknown interaction 'test_jak'; did you mean 'test_jack'?"));
  const TestScene s(scene("{type: test_jack, between: [wall, cart], " + at + "}, {type: test_jack, name: j, between: [cart, wall], " + at + "}"));
  REQUIRE(s.world->interactions.size() == 2);
  CHECK(s.world->interactions[0].name == "test_jack 0");
  CHECK(s.world->interactions[1].name == "j");
  CHECK(s.world->interactions[1].type == "test_jack");
  CHECK(s.world->interactions[1].bodies == std::vector<int>{0, 1});
  CHECK(s.world->interactions[1].terms.size() == 2);
  InteractionBuilder builder(s.config, *s.world, "b", "b");
  CHECK(builder.bodies("things") == std::vector<int>{0, 1});
  CHECK(builder.bodies("*") == std::vector<int>{0, 1});
  CHECK(builder.bodies("cart") == std::vector<int>{1});
  CHECK_THROWS_WITH(builder.bodies("thing"), Contains("no object or group is named 'thing'") && Contains("things"));
}

TEST_CASE("a scalar without mass minimises the potential, one with mass oscillates", "[interactions]") {
  // Springs in series: stiffness k of the ends, S / l^2 of the scalar, whose displacement is l n.
  const double k = 1e4, spring = 1, length = 0.1, goal = 0.1;
  TestRun run(scene("{type: test_jack, name: jack, between: [wall, cart], " + at + "}"));
  const int n = group_of(*run.world, "jack/way").vertices.at(0);
  CHECK(run.world->is_scalar_dof(n));
  CHECK(run.world->body_of(n) == -1);
  CHECK(run.world->gravitational_mass(n) == 0);
  CHECK_FALSE(run.world->is_scalar_dof(group_of(*run.world, "jack/anchor").vertices.at(0)));
  const double other = spring / (length * length);
  for (int i = 0; i < 5; ++i) {
    run.step();
    const double way = run.at(group_of(*run.world, "jack/anchor").vertices[0] + 1).x() - 0.05;
    CHECK(run.at(n).x() == Approx((k * way + other * length * goal) / (k + other)).epsilon(1e-6));
    CHECK(run.at(n).y() == 0);
    CHECK(run.at(n).z() == 0);
  }
  // Held ends: the number alone.
  TestRun swing("time: {step: 1 ms, duration: 1, integrator: newmark}\nsolver: {type: projected_newton, tolerance: 1e-9}\nobjects:\n"
                "  - {name: wall, shape: {type: box, size: [0.1, 0.1, 0.1]}, motion: [fixed]}\n"
                "  - {name: other, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0.1, 0, 0]}, motion: [fixed]}\n"
                "  - {name: far, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [5, 0, 0]}, body: affine}\n"
                "interactions: [{type: test_jack, name: jack, between: [wall, other], " + at + ", stiffness: 100, spring: 1, mass: 0.2}]\n");
  const int m = group_of(*swing.world, "jack/way").vertices.at(0);
  const double rate = std::sqrt((100 + other) / 0.2), rest = other * length * goal / (100 + other);
  while (swing.state().time < 0.3) swing.step();
  CHECK(swing.at(m).x() == Approx(rest * (1 - std::cos(rate * swing.state().time))).margin(0.01 * rest));
}

TEST_CASE("a scalar with a schedule drives dependent objects", "[interactions]") {
  TestRun run(scene("{type: test_jack, name: jack, between: [wall, cart], " + at + ", prescribed: true, goal: 0.2, stiffness: 1e5}"));
  while (run.state().time < 0.4) run.step();
  CHECK(run.at(group_of(*run.world, "jack/way").vertices[0]).x() == Approx(0.02).epsilon(1e-12));
  CHECK(run.at(group_of(*run.world, "jack/anchor").vertices[0]).x() == 0.05);
}

TEST_CASE("derivatives of all that interactions and energies with unknowns add are checked", "[interactions]") {
  TestScene s(scene("{type: test_jack, between: [wall, cart], " + at + "}") );
  int jacks = 0;
  for (const DerivativeCheck& check : check_derivatives(*s.world, 0.01, s.clock)) {
    CHECK_FALSE(check.wrong());
    if (check.term != "jacks" && check.term != "held") continue;
    ++jacks;
    CHECK(check.active());
  }
  CHECK(jacks == 2);
  TestRun rod("time: {step: 5 ms, duration: 1}\nsolver: {type: projected_newton, tolerance: 1e-8}\nobjects:\n"
              "  - {name: line, shape: {type: segment, length: 1, edges: 4}, rod: {radius: 5 mm}, damping: {mass: 1}, velocity: [0, 0.1, 0], spin: [1, 0, 0],\n"
              "     energies: [{type: string, young: 1 MPa, density: 1000}, {type: test_middles}]}\n");
  const std::vector<int>& middles = group_of(*rod.world, "line/1/middles").vertices;
  REQUIRE(middles.size() == 4);
  CHECK(rod.world->body_of(middles[0]) == 0);
  for (int i = 0; i < 3; ++i) rod.step();
  for (size_t e = 0; e < middles.size(); ++e) {
    const Edge& edge = rod.world->bodies[0].edges[e];
    CHECK((rod.at(middles[e]) - (rod.at(edge[0]) + rod.at(edge[1])) / 2).norm() < 1e-8);
  }
}

TEST_CASE("dependent attachment points make an exact ball joint", "[interactions]") {
  TestRun run("time: {step: 5 ms, duration: 1}\ngravity: [0, -9.81, 0]\nsolver: {type: projected_newton, tolerance: 1e-7}\nobjects:\n"
              "  - {name: wall, shape: {type: box, size: [0.1, 0.1, 0.1]}, motion: [fixed]}\n"
              "  - {name: cart, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0.1, 0, 0]}, body: {type: affine, density: 1000}}\n"
              "  - {name: last, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0.2, 0, 0]}, body: {type: affine, density: 1000}}\n"
              "interactions: [{type: test_jack, name: a, between: [wall, cart], at: [0.05, 0, 0], tied: true}, {type: test_jack, name: b, between: [cart, last], "
              "at: [0.15, 0, 0], tied: true}]\n");
  for (int i = 0; i < 60; ++i) run.step();
  const int a = group_of(*run.world, "a/anchor").vertices[0], b = a + 2;
  CHECK((run.at(a) - Vec3(0.05, 0, 0)).norm() < 1e-15);
  CHECK((run.at(a + 1) - run.at(a)).norm() < 1e-12);
  CHECK((run.at(b + 1) - run.at(b)).norm() < 1e-12);
  CHECK(run.at(b).y() < -0.02);
  CHECK((run.at(b) - run.at(a)).norm() == Approx(0.1).epsilon(1e-3));
}

TEST_CASE("contact is excluded between objects joined by an interaction, and only between them", "[interactions]") {
  const std::string contact = "contact: {distance: 1 mm}\n";
  CHECK_THROWS_WITH(TestScene(scene("{type: test_jack, between: [wall, cart], " + at + "}", contact)), Contains("the start"));
  const TestScene s(scene("{type: test_jack, between: [wall, cart], " + at + ", joined: true}", contact));
  CHECK(s.world->attached == std::vector<std::pair<int, int>>{{0, 1}});
}

TEST_CASE("overclosure adjustment moves only objects without an interaction that keeps their placement", "[interactions]") {
  const std::string contact = "contact: {distance: 1 mm, overclosure_adjustment: 1 cm}\n";
  CHECK_THROWS_WITH(TestScene(scene("{type: test_jack, between: [wall, cart], " + at + "}", contact)), Contains("the start"));
  const TestScene s(scene("{type: test_jack, between: [wall, cart], at: [0.0505, 0, 0], free: true}", contact));
  CHECK(s.world->rest(3 * s.world->bodies[1].first_vertex) > 0.05);
}

TEST_CASE("unknowns and history of interactions resume bit for bit, and are part of an initial state", "[interactions]") {
  TestRun whole(scene("{type: test_jack, name: jack, between: [wall, cart], " + at + ", mass: 0.2}"));
  for (int i = 0; i < 7; ++i) whole.step();
  const State middle = whole.state();
  const auto steps = [](const TestRun& run) { return dynamic_cast<const JackTerm&>(*run.world->interactions[0].terms[0]).steps(); };
  CHECK(middle.history.at("jack/steps").values == std::vector<double>{7});
  CHECK(steps(whole) == 7);

  InitialStateFromRun earlier{"before", middle.time, middle.x, middle.v, middle.a, middle.history, state_objects(*whole.world), {"wall", "cart"}, {}};
  for (const char* name : {"wall", "cart", "jack"}) earlier.energies[name] = "";
  const int n = group_of(*whole.world, "jack/way").vertices[0];
  const auto start = [&](const std::string& interactions) {
    TestScene s(scene(interactions));
    start_from_run(StartConfig{}, earlier, s.config, *s.world);
    return s.world->start;
  };
  const State taken = start("{type: test_jack, name: jack, between: [wall, cart], " + at + ", mass: 0.2}");
  CHECK(taken.x == middle.x);
  CHECK(taken.v(3 * n) == middle.v(3 * n));
  CHECK(taken.history.at("jack/steps").values == std::vector<double>{7});
  const State other = start("{type: test_jack, name: new, between: [wall, cart], " + at + ", mass: 0.2}");
  CHECK(other.x(3 * n) == 0);
  CHECK_FALSE(other.history.contains("jack/steps"));
  CHECK_THROWS_WITH(start("{type: test_jack, name: jack, between: [wall, cart], " + at + ", prescribed: true, tied: true}"), Contains("interaction 'jack' had 3 unknowns in before, and has 2 here"));
}
