// Adhesion between bodies that is integrated by clipping: derivatives, balance, closed forms, rest.
#include "framework/contact/clipped/clipped_adhesion_term.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "geometry/errors.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/three_boxes.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

// Three small boxes around each other, askew.
struct Cluster {
  Cluster() : scene(three_boxes() +
                    "contact: {distance: 0.025, integral: clipped, barrier: {type: clamped_log, stiffness: 1e3},\n"
                    "  pairs: [{between: [a, b], adhesion: {type: fang, young: 1e3, critical_strain: 0.5}},\n"
                    "          {between: [b, c], integrate: c, adhesion: {type: fang, form: squared, young: 1e3, critical_strain: 0.5}}]}\n") {
    RandomMotions random(11);
    x = scene.world->rest + 1e-3 * random.vectors(scene.world->rest.size());
    scene.world->contact->begin_step({x});
    move_to(x);
  }
  void move_to(const VecX& at) {
    scene.world->contact->move_to(at);
    term().move_to(at);
  }
  ClippedAdhesionTerm& term() { return *clipped_adhesion(*scene.world); }

  TestScene scene;
  VecX x;
};

// A plate of 0.1 m that faces another one of 0.1 m, shifted by `shift` along the first axis, at `gap`.
std::string plates(const std::string& integral, double shift, double gap, int lower_cells, int upper_cells) {
  const auto plate = [](const char* name, double x, double y, int cells, const char* more) {
    return fmt::format("  - {{name: {}, shape: {{type: box, size: [0.1, 0.01, 0.1], cells: [{}, 1, {}]}}, place: {{translate: [{}, {}, 0]}}, {}}}\n",
                       name, cells, cells, x, y, more);
  };
  return "objects:\n" + plate("lower", 0, -0.005, lower_cells, "motion: [fixed]") +
         plate("upper", shift, 0.005 + gap, upper_cells, "energies: [{type: neo_hookean, young: 1e5}]") +
         fmt::format("contact: {{distance: 1e-3, integral: {}, pairs: [{{between: [lower, upper], adhesion: {{type: fang, peak_traction: 2 kPa, peak_distance: 1e-3}}}}]}}\n", integral);
}

Vec3 pull_on_upper(World& world) {
  world.contact->begin_step({world.rest});
  world.contact->move_to(world.rest);
  clipped_adhesion(world)->move_to(world.rest);
  Vec3 sum = Vec3::Zero();
  const VecX force = -dense_gradient(*clipped_adhesion(world), world.rest);
  const int upper = world.body_index("upper");
  for (int v = 0; v < world.rest.size() / 3; ++v)
    if (world.body_of(v) == upper) sum += vertex(force, v);
  return sum;
}

LawSample law_at(double gap) {
  const auto adhesion = bind_component<AdhesionLaw>(parse_string("{type: fang, peak_traction: 2 kPa, peak_distance: 1e-3}", "t"));
  NormalLaw& law = dynamic_cast<NormalLaw&>(*adhesion);
  law.prepare({1e-3, 1e5, 0});
  return law.at(gap);
}

}  // namespace

TEST_CASE("clipped adhesion: gradient and exact Hessian are those of the value", "[clipped]") {
  Cluster c;
  REQUIRE(c.term().pair_count() > 10);
  const VecX gradient = dense_gradient(c.term(), c.x);
  REQUIRE(gradient.norm() > 0);
  const auto value_at = [&](const VecX& y) {
    c.move_to(y);
    return c.term().value(y);
  };
  const auto gradient_at = [&](const VecX& y) {
    c.move_to(y);
    return dense_gradient(c.term(), y);
  };
  // Differences cross levels at which the curvature of the law jumps.
  const VecX slopes = gradient_by_differences(value_at, c.x, 1e-6);
  CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-5 * gradient.lpNorm<Eigen::Infinity>());
  c.move_to(c.x);
  const MatX hessian = dense_hessian(c.term(), c.x, Projection::none);
  const MatX curvatures = hessian_by_differences(gradient_at, c.x, 1e-7);
  CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-4 * hessian.cwiseAbs().maxCoeff());
}

TEST_CASE("clipped adhesion: the projected stencils are positive semi-definite", "[clipped]") {
  Cluster c;
  for (const Projection projection : {Projection::clamp, Projection::absolute})
    for_each_stencil_hessian(c.term(), c.x, projection, [](const MatX& h, const int*) {
      REQUIRE(smallest_eigenvalue(h) >= -1e-12 * std::max(h.cwiseAbs().maxCoeff(), 1e-12));
    });
}

TEST_CASE("clipped adhesion: forces and moments add up to zero, shares to the energy", "[clipped]") {
  Cluster c;
  const VecX gradient = dense_gradient(c.term(), c.x);
  const double scale = gradient.cwiseAbs().sum();
  CHECK(total(gradient).norm() <= 1e-12 * scale);
  CHECK(total_moment(c.x, gradient).norm() <= 1e-12 * scale);
  double shared = 0;
  c.term().visit_energies(c.x, [&](std::span<const int>, double energy) { shared += energy; });
  CHECK(shared == Approx(c.term().value(c.x)).epsilon(1e-12));
}

TEST_CASE("clipped adhesion: plates pull by their overlap, and along it by the work per length", "[clipped]") {
  for (const double gap : {0.4e-3, 1.3e-3})
    for (const double shift : {0.0, 0.023, 0.0777})
      for (const auto& [lower, upper] : {std::pair{1, 1}, {4, 5}, {2, 9}}) {
        INFO("gap " << gap << ", shift " << shift << ", " << lower << " and " << upper << " cells");
        TestScene scene(plates("clipped", shift, gap, lower, upper));
        const Vec3 force = pull_on_upper(*scene.world);
        const LawSample law = law_at(gap);
        CHECK(force.y() == Approx(-0.1 * (0.1 - shift) * law.slope).epsilon(1e-4));
        // The boundary force pulls the upper plate back over the lower one.
        CHECK(force.x() == Approx(shift > 0 ? 0.1 * law.value : 0.0).epsilon(1e-3).margin(1e-4 * 0.1 * std::abs(law.value)));
        CHECK(std::abs(force.z()) <= 1e-3 * 0.1 * std::abs(law.value));
      }
}

TEST_CASE("clipped adhesion: nothing in range, no pairs", "[clipped]") {
  TestScene scene(plates("clipped", 0, 0.05, 3, 3));
  World& world = *scene.world;
  CHECK(pull_on_upper(world).isZero(0));
  CHECK(clipped_adhesion(world)->pair_count() == 0);
}

TEST_CASE("clipped adhesion: nearly aligned blocks come to rest", "[clipped]") {
  // With areas of the start of each step they are shaken for ever: 0.125 m/s.
  TestRun run(
      "time: {step: 1 ms, duration: 0.15 s}\n"
      "objects:\n"
      "  - {name: base, shape: {type: box, size: [0.006, 0.002, 0.006], cells: [2, 1, 2]}, place: {translate: [0, -0.001, 0]}, motion: [fixed]}\n"
      "  - name: block\n"
      "    shape: {type: box, size: [0.006, 0.002, 0.006], cells: [3, 1, 3]}\n"
      "    place: {translate: [0.000001, 0.0013, 0.000002]}\n"
      "    energies: [{type: neo_hookean, young: 400 kPa, poisson: 0.3, density: 1000}]\n"
      "    damping: {mass: 100}\n"
      "contact:\n"
      "  distance: 0.5 mm\n"
      "  integral: clipped\n"
      "  pairs:\n"
      "    - {between: [base, block], adhesion: {type: fang, peak_traction: 2 kPa}}\n");
  for (int step = 0; step < 150; ++step) run.step();
  CHECK(run.state().v.lpNorm<Eigen::Infinity>() < 1e-4);
}

TEST_CASE("clipped adhesion: settings that it does not know are refused", "[clipped]") {
  const auto refuses = [](const std::string& contact, const std::string& word) {
    try {
      TestScene scene("objects:\n"
                      "  - {name: a, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
                      "  - {name: b, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0.102, 0, 0]}, motion: [fixed]}\n" + contact);
    } catch (const InputError& error) {
      INFO(error.what());
      CHECK(std::string(error.what()).find(word) != std::string::npos);
      return;
    }
    FAIL("accepted: " << contact);
  };
  const std::string adhesion = "adhesion: {type: fang, young: 1e3, critical_strain: 0.5}";
  refuses("contact: {distance: 0.01, integral: clipped, weights: pair, pairs: [{between: [a, b], " + adhesion + "}]}\n", "contact.model");
  refuses("contact: {distance: 0.01, integral: clipped, pairs: [{between: [a, b], " + adhesion + "}, {between: [{object: a, select: all}, b], adhesion: {type: bilinear, peak_traction: 1 kPa, work_of_adhesion: 1}}]}\n", "regions");
}
