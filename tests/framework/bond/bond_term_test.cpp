#include "framework/bond/bond_term.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

const std::string rcc = "adhesion: {type: rcc, normal_stiffness: 1e7, tangential_stiffness: 4e6, work_of_adhesion: 0.5}";

std::string box(const std::string& name, const std::string& size, const std::string& cells, const std::string& at, const std::string& more = "") {
  return "  - {name: " + name + ", shape: {type: box, size: " + size + ", cells: " + cells + "}, place: {translate: " + at +
         "}, energies: [{type: neo_hookean, young: 1e6}]" + more + "}\n";
}

std::string contact(const std::string& pair) {
  return "contact:\n  distance: 1e-3\n  barrier: {type: clamped_log, stiffness: 3e3}\n  pairs: [{" + pair + "}]\n";
}

// Two plates, 0.8 mm apart, whose meshes do not match and of which one hangs over; a third of the upper one's width lies opposite.
std::string plates(const std::string& pair = "between: [lower, upper], " + rcc) {
  return "objects:\n" + box("lower", "[0.03, 0.002, 0.03]", "[5, 1, 6]", "[0, 0, 0]") +
         box("upper", "[0.03, 0.002, 0.02]", "[4, 1, 7]", "[0.02, 0.0028, 0]") + contact(pair);
}

// A step of 1 ms has begun at rest.
struct Bonded {
  explicit Bonded(const std::string& yaml, double h = 1e-3) : scene(yaml), x(scene.world->rest) {
    scene.world->participants.load_history(scene.world->start.history);
    scene.world->participants.begin_step({x, 0, h});
  }
  BondTerm& term() { return *scene.world->bonds; }
  double area() {
    double sum = 0;
    for (const Bond& b : term().list().bonds()) sum += b.area;
    return sum;
  }
  // Returns x with one body displaced.
  VecX moved(const std::string& body, const Vec3& way) const {
    VecX y = x;
    const Body& b = scene.world->bodies[scene.world->body_index(body)];
    for (int v = b.first_vertex; v < b.first_vertex + b.vertex_count; ++v) vertex(y, v) += way;
    return y;
  }

  TestScene scene;
  VecX x;
};

}  // namespace

TEST_CASE("bonds: gradient and Hessian are those of the value, the Hessian's projections too", "[bonds]") {
  Bonded bonded(plates());
  RandomMotions random(5);
  // Some opened beyond the onset, some not, all slid.
  for (const double opening : {5e-5, 2.5e-4, 6e-4}) {
    VecX x = bonded.moved("upper", {1e-4, opening, -5e-5});
    x += 2e-5 * random.vectors(x.size());
    const auto value = [&](const VecX& y) { return bonded.term().value(y); };
    const auto gradient = [&](const VecX& y) { return dense_gradient(bonded.term(), y); };
    const VecX g = gradient(x);
    CHECK((g - gradient_by_differences(value, x, 1e-7)).norm() < 1e-6 * g.norm());
    const MatX h = dense_hessian(bonded.term(), x, Projection::none), differences = hessian_by_differences(gradient, x, 1e-8);
    CHECK((h - differences).norm() < 1e-5 * h.norm());
    CHECK((differences - differences.transpose()).norm() < 1e-8 * h.norm());
    CHECK(total(g).norm() < 1e-12 * g.cwiseAbs().sum());
    // With frames taken at x, slipped bonds too have no moment.
    bonded.term().lag(x);
    const VecX held = gradient(x);
    CHECK(total_moment(x, held).norm() < 1e-12 * held.cwiseAbs().sum());
    bonded.term().lag(bonded.x);
    for (const Projection projection : {Projection::clamp, Projection::absolute}) {
      // The projection acts on the vector between the two bond sites; the stencil's own eigenvalues
      // differ, and none is negative.
      const MatX made = dense_hessian(bonded.term(), x, projection);
      CHECK(smallest_eigenvalue(made) > -1e-12 * h.norm());
      CHECK((smallest_eigenvalue(h) < -1e-6 * h.norm()) == ((made - h).norm() > 1e-6 * h.norm()));
    }
  }
}

TEST_CASE("bonds represent the area of overlap, for either integration side, and none far away", "[bonds]") {
  const double overlap = 0.01 * 0.02;
  for (const std::string side : {"automatic", "upper", "lower", "both", "finer"}) {
    Bonded bonded(plates("between: [lower, upper], integrate: " + side + ", " + rcc));
    INFO(side);
    CHECK(bonded.area() == Approx(overlap).epsilon(0.01));
    for (const Bond& b : bonded.term().list().bonds()) {
      CHECK(std::abs(b.normal.y()) == Approx(1));
      CHECK(b.rest == Approx(0.8e-3));
    }
  }
  CHECK(Bonded(plates("between: [lower, upper], bond_distance: 0.7 mm, " + rcc)).area() == 0);
}

TEST_CASE("bonds that opened by d pull with beta^2 C_N d, slid ones with beta^2 C_T u, in one intensity", "[bonds]") {
  Bonded bonded(plates());
  const auto force = [&](const Vec3& way) {
    const VecX x = bonded.moved("upper", way);
    return bonded.term().force_between(x, LawTerm::adhesion, {bonded.scene.world->body_index("upper"), bonded.scene.world->body_index("lower")});
  };
  const double area = bonded.area();
  const auto intensity = [](double d, double u) { return std::min(1.0, 0.5 / (1e7 * d * d + 4e6 * u * u)); };
  for (const double d : {1e-4, 4e-4})
    for (const double u : {0.0, 2e-4, 7e-4}) {
      const double b = intensity(d, u);
      const Vec3 pull = force({u, d, 0});
      CHECK(pull.y() == Approx(-area * b * b * 1e7 * d));
      CHECK(pull.x() == Approx(-area * b * b * 4e6 * u).margin(1e-12));
      CHECK(std::abs(pull.z()) < 1e-9 * area * 1e3);
    }
  CHECK(force({0, -2e-4, 0}).norm() < 1e-12);  // compression is no adhesion
}

TEST_CASE("bonds resist compression like opening, unless they heal", "[bonds]") {
  const auto pressed = [](const std::string& law, LawTerm part) {
    Bonded bonded(plates("between: [lower, upper], adhesion: " + law));
    const VecX x = bonded.moved("upper", {1e-5, -1e-5, 0});
    const World& world = *bonded.scene.world;
    return Vec3(bonded.term().force_between(x, part, {world.body_index("upper"), world.body_index("lower")}) / bonded.area());
  };
  const std::string stiff = "{type: rcc, normal_stiffness: 1e7, tangential_stiffness: 4e6, work_of_adhesion: 0.5";
  CHECK(pressed(stiff + "}", LawTerm::barrier).y() == Approx(1e7 * 1e-5));
  CHECK(pressed(stiff + "}", LawTerm::adhesion).x() == Approx(-4e6 * 1e-5));
  CHECK(std::abs(pressed(stiff + "}", LawTerm::adhesion).y()) < 1e-9);
  CHECK(pressed(stiff + ", healing: 1e-3, intensity: 1}", LawTerm::all).y() == Approx(0).margin(1e-9));
  CHECK(pressed("{type: bilinear, peak_traction: 1e4, work_of_adhesion: 1, onset: 2e-5}", LawTerm::all).y() == Approx(1e4 / 2));
  CHECK(pressed("{type: bilinear, peak_traction: 1e4, work_of_adhesion: 1, onset: 2e-5}", LawTerm::barrier).x() == Approx(0).margin(1e-9));

  // Derivatives, and pressure at the place, which heals: that of the barrier and of the bond.
  Bonded bonded(plates());
  RandomMotions random(3);
  const VecX x = bonded.moved("upper", {1e-4, -5e-5, -5e-5}) + 2e-6 * random.vectors(bonded.x.size());
  const auto value = [&](const VecX& y) { return bonded.term().value(y); };
  const auto gradient = [&](const VecX& y) { return dense_gradient(bonded.term(), y); };
  const VecX g = gradient(x);
  CHECK((g - gradient_by_differences(value, x, 1e-7)).norm() < 1e-6 * g.norm());
  const MatX h = dense_hessian(bonded.term(), x, Projection::none);
  CHECK((h - hessian_by_differences(gradient, x, 1e-8)).norm() < 1e-5 * h.norm());
  CHECK(smallest_eigenvalue(dense_hessian(bonded.term(), x, Projection::clamp)) > -1e-12 * h.norm());
}

TEST_CASE("bonds: a rigid motion of both surfaces changes nothing, also by steps", "[bonds]") {
  Bonded bonded(plates());
  const VecX apart = bonded.moved("upper", {2e-4, 1e-4, 1e-4});
  bonded.term().lag(apart);
  const double value = bonded.term().value(apart);
  const Vec3 axis = Vec3(0.3, 1, -0.5).normalized();
  const auto turned = [&](double angle) {
    VecX y = apart;
    for (int v = 0; v < y.size() / 3; ++v) vertex(y, v) = Eigen::AngleAxisd(angle, axis) * vertex(apart, v) + Vec3(0, angle, 0);
    return y;
  };
  const VecX quarter = turned(1.5);
  bonded.term().lag(quarter);
  CHECK(bonded.term().value(quarter) == Approx(value).epsilon(1e-9));
  // With frames taken at 0, the error of a small rotation is of second order.
  bonded.term().lag(apart);
  const double small = std::abs(bonded.term().value(turned(1e-3)) - value), smaller = std::abs(bonded.term().value(turned(1e-4)) - value);
  CHECK(smaller < 0.02 * small);
}

TEST_CASE("bonds are history variables: stored bonds have equal values, to the last bit", "[bonds]") {
  Bonded first(plates()), second(plates());
  const VecX x = first.moved("upper", {2e-4, 4e-4, 1e-4});
  History history;
  first.scene.world->participants.commit(x, history);
  CHECK(first.term().changes(x).dissipated > 0);
  first.scene.world->participants.load_history(history);
  second.scene.world->participants.load_history(history);
  CHECK(second.term().list().size() > 0);
  CHECK(second.term().value(x) == first.term().value(x));  // h = 0: the stored energy
  for (auto* bonded : {&first, &second}) bonded->scene.world->participants.begin_step({x, 1e-3, 1e-3});
  const VecX y = first.moved("upper", {2e-4, 7e-4, 1e-4});
  CHECK(second.term().value(y) == first.term().value(y));
  CHECK(second.term().forces(y, LawTerm::all) == first.term().forces(y, LawTerm::all));
  // Separated surfaces make no new bonds.
  CHECK(second.term().list().size() == first.term().list().size());
}

TEST_CASE("bonds on contact form once where surfaces meet, and again where they have failed", "[bonds]") {
  Bonded bonded(plates("between: [lower, upper], bond: on_contact, bond_distance: 0.5 mm, " + rcc));
  World& world = *bonded.scene.world;
  CHECK(bonded.area() == 0);
  History history;
  const auto step_to = [&](const VecX& x) {
    world.participants.commit(x, history);
    world.participants.load_history(history);
    world.participants.begin_step({x, 0, 1e-3});
  };
  const VecX close = bonded.moved("upper", {0, -4e-4, 0});
  step_to(close);
  CHECK(bonded.area() == Approx(0.01 * 0.02).epsilon(0.01));
  CHECK(std::abs(bonded.term().value(close)) < 1e-20);
  const int count = bonded.term().list().size();
  step_to(bonded.moved("upper", {3e-4, -4e-4, 0}));  // the overlap has changed
  CHECK(bonded.term().list().size() == Approx(count).epsilon(0.2));
  CHECK(bonded.area() < 1.2 * 0.01 * 0.02);
  step_to(bonded.moved("upper", {0, 0.05, 0}));  // far beyond the range
  CHECK(bonded.area() == 0);
  step_to(close);
  CHECK(bonded.area() == Approx(0.01 * 0.02).epsilon(0.01));
}

TEST_CASE("bonds of rods, particles, sheets and of a sheet with itself", "[bonds]") {
  SECTION("a rod on a plate: its width times its length") {
    Bonded bonded("objects:\n" + box("plate", "[0.03, 0.002, 0.03]", "[3, 1, 3]", "[0, 0, 0]") +
                  "  - {name: rod, shape: {type: segment, length: 0.02, edges: 20}, place: {translate: [0, 0.0018, 0]}, rod: {radius: 0.5e-3},"
                  " energies: [{type: string, young: 1e6}]}\n" + contact("between: [rod, plate], " + rcc));
    CHECK(bonded.term().list().size() > 15);
    CHECK(bonded.area() == Approx(0.02 * 1e-3).epsilon(0.1));
    CHECK(bonded.term().list().bonds()[0].site_count == 1);
    CHECK((dense_gradient(bonded.term(), bonded.moved("rod", {0, 1e-4, 0}))).norm() > 0);
  }
  SECTION("particles on a plate: their cross-sections") {
    Bonded bonded("objects:\n" + box("plate", "[0.03, 0.002, 0.03]", "[3, 1, 3]", "[0, 0, 0]") +
                  "  - {name: dust, shape: {type: points, size: [0.02, 0, 0.02], counts: [3, 1, 3]}, place: {translate: [0, 0.0018, 0]},"
                  " particle: {radius: 1e-4}, energies: [particle]}\n" + contact("between: [dust, plate], " + rcc));
    CHECK(bonded.term().list().size() == 9);
    CHECK(bonded.area() == Approx(9 * 3.14159e-8).epsilon(0.01));
  }
  SECTION("a sheet that is bent back on itself") {
    Bonded bonded("objects:\n  - {name: sheet, shape: {type: grid, size: [0.06, 0.01], cells: [30, 5]}, shell: {thickness: 1e-4},"
                  " energies: [{type: stvk_membrane, young: 1e6}]}\n" + contact("between: [sheet, sheet], bond: on_contact, " + rcc));
    CHECK(bonded.term().list().size() == 0);
    // About the middle, by half a circle; the arms are 0.8 mm apart.
    VecX folded = bonded.x;
    const double radius = 0.4e-3, half = 1.5707963267948966 * radius;
    for (int v = 0; v < folded.size() / 3; ++v) {
      const double x = vertex(bonded.x, v).x();
      const double turn = std::clamp(x / half, -1.0, 1.0) * 1.5707963267948966, rest = std::max(std::abs(x) - half, 0.0);
      vertex(folded, v).x() = radius * std::cos(turn) - rest;
      vertex(folded, v).y() = radius * std::sin(turn);
    }
    bonded.scene.world->participants.begin_step({folded, 0, 1e-3});
    CHECK(bonded.area() == Approx(0.03 * 0.01).epsilon(0.15));
    for (const Bond& b : bonded.term().list().bonds()) CHECK(b.a == b.b);
  }
  SECTION("a sheet between two plates, on both of its sides") {
    Bonded bonded("objects:\n" + box("below", "[0.02, 0.002, 0.02]", "[3, 1, 3]", "[0, -0.0018, 0]") + box("above", "[0.02, 0.002, 0.02]", "[4, 1, 4]", "[0, 0.0018, 0]") +
                  "  - {name: sheet, shape: {type: grid, size: [0.02, 0.02], cells: [5, 5]}, shell: {thickness: 1e-4},"
                  " energies: [{type: stvk_membrane, young: 1e6}]}\n" + contact("between: [sheet, \"*\"], " + rcc));
    CHECK(bonded.area() == Approx(2 * 0.02 * 0.02).epsilon(0.01));
  }
}

TEST_CASE("bonds between objects without surfaces are refused, and bond keys without bonds", "[bonds]") {
  const std::string rods = "objects:\n"
                           "  - {name: a, shape: {type: segment, length: 0.01, edges: 4}, rod: {radius: 1e-4}, energies: [{type: string, young: 1e6}]}\n"
                           "  - {name: b, shape: {type: segment, length: 0.01, edges: 4}, place: {translate: [0, 0.001, 0]}, rod: {radius: 1e-4}, energies: [{type: string, young: 1e6}]}\n";
  CHECK_THROWS_WITH(TestScene(rods + contact("between: [a, b], " + rcc)), Catch::Contains("has a surface"));
  CHECK_THROWS_WITH(TestScene(plates("between: [lower, upper], bond: on_contact, adhesion: {type: fang, young: 1e4, critical_strain: 0.2}")), Catch::Contains("adhesion by bonds"));
  CHECK_THROWS_WITH(TestScene(plates("between: [lower, upper], tangential_adhesion: {mu: 0.3}, " + rcc)), Catch::Contains("resist slip themselves"));
  CHECK_THROWS_WITH(TestScene(plates("between: [lower, upper], bond_distance: 3 mm, " + rcc)), Catch::Contains("raise contact.distance"));
}

TEST_CASE("bonds that are expected at the start and missing give one warning", "[bonds]") {
  TestRun none(plates("between: [lower, upper], bond_distance: 0.7 mm, " + rcc)), some(plates());
  for (TestRun* run : {&none, &some})
    for (int i = 0; i < 3; ++i) run->step();
  CHECK_THAT(only_text(none.warnings, WarningKind::no_bonds), Catch::Contains("'lower' - 'upper'"));
  CHECK(some.warnings.empty());
}
