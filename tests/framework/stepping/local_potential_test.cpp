// Local problems: the potential over some blocks, against the rows of the whole one.
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "framework/contact/contact_system.hpp"
#include "framework/stepping/local_potential.hpp"
#include "tests/support/step_problem.hpp"

using namespace tack;

namespace {

std::string blocks(const std::string& upper, const std::string& contact, const std::string& more = "") {
  return "time: {step: 10 ms}\n"
         "gravity: [0, -9.81, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: grid, size: [0.5, 0.5], cells: [4, 4]}, motion: [fixed]}\n"
         "  - {name: lower, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, place: {translate: [0, 0.0505, 0]},\n"
         "     energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
         "  - {name: upper, shape: {type: box, size: [0.08, 0.08, 0.08], cells: [3, 3, 3]}, place: {translate: [0.01, 0.141, 0.005]},\n"
         "     velocity: [0.3, -0.2, 0.1], " + upper + "}\n" + more + "contact: " + contact + "\n";
}
const std::string solid = "energies: [{type: neo_hookean, young: 1e5, density: 1000}]";

struct Case {
  const char* name;
  std::string scene;
};
const std::vector<Case> cases = {
    {"solids with friction", blocks(solid, "{distance: 1 mm, friction: {mu: 0.5, eps_v: 1 cm/s}}")},
    {"damped solids", blocks("energies: [{type: neo_hookean, young: 1e5, density: 1000}], damping: {stiffness: 1 ms, mass: 2}", "{distance: 1 mm}")},
    {"an affine body", blocks("body: {type: affine, density: 1000}", "{distance: 1 mm, friction: {mu: 0.5, eps_v: 1 cm/s}}")},
    {"a slider", blocks(solid + ", motion: [{type: fixed, along: [1, 0, 0]}]", "{distance: 1 mm}")},
    {"adhesion", blocks(solid, "{distance: 1 mm, pairs: [{between: [lower, upper], adhesion: {type: fang, peak_traction: 1 kPa}}]}")},
    {"clipped adhesion", blocks(solid, "{distance: 1 mm, model: clipped, pairs: [{between: [lower, upper], adhesion: {type: fang, peak_traction: 1 kPa}}]}")},
    {"another contact model", blocks(solid, "{distance: 1 mm, model: ipc}")},
};

// A step problem moved a little from its start, without intersection.
struct Moved : StepProblem {
  explicit Moved(const std::string& scene) : StepProblem(scene) {
    std::mt19937 random(7);
    std::normal_distribution<double> number(0, 2e-4);
    VecX p(q.size());
    for (double& c : p) c = number(random);
    world->dofs.copy_fixed_directions(VecX::Zero(step.targets.size()), p);
    q += 0.5 * feasible_step(q, p) * p;
    potential.move_to(q);
  }
  // The blocks within a radius of a point, of all bodies [m].
  std::vector<int> near(const Vec3& centre, double radius) const {
    std::vector<int> found;
    const VecX x = configuration(q);
    for (int b = 0; b < world->dofs.block_count(); ++b)
      if ((Vec3(vertex(x, world->dofs.vertex_of_block(b))) - centre).norm() < radius) found.push_back(b);
    return found;
  }
};

VecX rows(const VecX& full, const std::vector<int>& chosen) {
  VecX own(3 * chosen.size());
  for (size_t i = 0; i < chosen.size(); ++i) own.segment<3>(3 * static_cast<Eigen::Index>(i)) = full.segment<3>(3 * chosen[i]);
  return own;
}

}  // namespace

TEST_CASE("a local problem has the rows of the whole one", "[local]") {
  for (const Case& c : cases) {
    INFO(c.name);
    for (const double radius : {0.02, 0.05, 1.0}) {
      INFO("radius " << radius);
      Moved whole(c.scene), own(c.scene);  // one stays where the rest is held
      const std::vector<int> chosen = whole.near({0.01, 0.1, 0}, radius);
      REQUIRE_FALSE(chosen.empty());
      const auto local = own.potential.restricted(chosen);
      REQUIRE(local->size() == 3 * static_cast<int>(chosen.size()));
      std::mt19937 random(3);
      std::normal_distribution<double> number(0, 1e-5);
      VecX at = rows(own.q, chosen), q = whole.q;
      double value = 0, whole_value = 0;
      for (int trial = 0; trial < 3; ++trial) {
        INFO("trial " << trial);
        local->move_to(at);
        whole.potential.move_to(q);
        for (const Projection projection : {Projection::none, Projection::clamp, Projection::absolute}) {
          const BlockMatrix& a = local->hessian({projection});
          const BlockMatrix& b = whole.potential.hessian({projection});
          double largest = 0, difference = 0;
          for (double entry : b.values) largest = std::max(largest, std::abs(entry));
          for (size_t i = 0; i < chosen.size(); ++i)
            for (size_t j = 0; j <= i; ++j) {
              const int k = a.find(static_cast<int>(i), static_cast<int>(j)), m = b.find(chosen[i], chosen[j]);
              const Mat3 left = k < 0 ? Mat3::Zero().eval() : Mat3(a.block(k)), right = m < 0 ? Mat3::Zero().eval() : Mat3(b.block(m));
              difference = std::max(difference, (left - right).lpNorm<Eigen::Infinity>());
            }
          CHECK(difference <= 1e-14 * largest);
        }
        const double force = whole.potential.scale() * whole.potential.largest_stencil_force() + whole.potential.gradient().lpNorm<Eigen::Infinity>();
        CHECK((local->gradient() - rows(whole.potential.gradient(), chosen)).lpNorm<Eigen::Infinity>() <= 1e-14 * force);
        if (trial > 0) {
          const double change = whole.potential.value() - whole_value;
          CHECK(std::abs(local->value() - value - change) <= 1e-10 * std::abs(change) + 1e-4 * whole.potential.value_noise());
        }
        value = local->value();
        whole_value = whole.potential.value();
        for (size_t i = 0; i < chosen.size(); ++i) {
          Vec3 step(number(random), number(random), number(random));
          for (const DofMap::PartlyFixedBlock& h : own.world->dofs.partly_fixed_blocks())
            if (h.block == chosen[i]) step -= (h.projection * step).eval();
          at.segment<3>(3 * static_cast<Eigen::Index>(i)) += step;
          q.segment<3>(3 * chosen[i]) = at.segment<3>(3 * static_cast<Eigen::Index>(i));
        }
      }
    }
  }
}

TEST_CASE("a step of a local problem is bounded as the same step of the whole one", "[local]") {
  for (const Case& c : cases) {
    INFO(c.name);
    Moved s(c.scene);
    const std::vector<int> chosen = s.near({0.01, 0.1, 0}, 0.05);
    std::mt19937 random(3);
    for (const double size : {1e-4, 1e-2, 0.3}) {
      INFO("size " << size);
      std::normal_distribution<double> number(0, size);
      VecX p = VecX::Zero(s.q.size());
      for (const int b : chosen) p.segment<3>(3 * b) = Vec3(number(random), number(random), number(random));
      const double expected = Moved(c.scene).feasible_step(s.q, p);
      MinimizerProblem problem{s.potential, {}, {}, s.clock};
      s.steps.set_feasibility(s.potential, problem);
      const LocalProblem local = problem.local(chosen);
      CHECK(local.q == rows(s.q, chosen));
      CHECK(local.feasible_step(local.q, rows(p, chosen)) == Approx(expected).epsilon(1e-9));
    }
  }
}

TEST_CASE("a local problem follows vertices out of their boxes", "[local]") {
  Moved s(cases[0].scene), whole(cases[0].scene);
  std::vector<int> upper;
  for (int b = 0; b < s.world->dofs.block_count(); ++b)
    if (s.world->body_of(s.world->dofs.vertex_of_block(b)) == 2) upper.push_back(b);
  const auto local = s.potential.restricted(upper);
  VecX at = rows(s.q, upper), q = s.q;
  for (const double dx : {0.03, -0.05, 0.01}) {
    for (size_t i = 0; i < upper.size(); ++i) at(3 * static_cast<Eigen::Index>(i)) += dx, q(3 * upper[i]) += dx;
    local->move_to(at);
    whole.potential.move_to(q);
    const double force = whole.potential.scale() * whole.potential.largest_stencil_force() + whole.potential.gradient().lpNorm<Eigen::Infinity>();
    CHECK((local->gradient() - rows(whole.potential.gradient(), upper)).lpNorm<Eigen::Infinity>() <= 1e-14 * force);
  }
}

TEST_CASE("the whole problem is as before after a local one", "[local]") {
  Moved s(cases[0].scene), untouched(cases[0].scene);
  const std::vector<int> chosen = s.near({0.01, 0.1, 0}, 0.05);
  {
    const auto local = s.potential.restricted(chosen);
    CHECK_THROWS_AS(s.potential.restricted(chosen), std::logic_error);
    VecX at = rows(s.q, chosen);
    at.array() += 1e-4;
    local->move_to(at);
    local->gradient();
  }
  s.potential.move_to(s.q);
  untouched.potential.move_to(untouched.q);
  CHECK(s.potential.gradient() == untouched.potential.gradient());
  const auto again = s.potential.restricted(chosen);
  CHECK((again->gradient() - rows(untouched.potential.gradient(), chosen)).lpNorm<Eigen::Infinity>() <=
        1e-14 * untouched.potential.gradient().lpNorm<Eigen::Infinity>() + 1e-14 * untouched.potential.scale() * untouched.potential.largest_stencil_force());
}

TEST_CASE("a local problem has the stencils of its region alone", "[local]") {
  std::string fine = cases[0].scene;
  fine.replace(fine.find("[0.08, 0.08, 0.08], cells: [3, 3, 3]"), 36, "[0.08, 0.08, 0.08], cells: [9, 9, 9]");
  Moved s(fine);
  const std::vector<int> chosen = s.near({0.03, 0.15, 0.02}, 0.01);
  REQUIRE(chosen.size() >= 1);
  const LocalPotential local(s.potential, *s.world, s.clock, chosen);
  CHECK(local.vertex_count() < 60 * static_cast<int>(chosen.size()));
}
