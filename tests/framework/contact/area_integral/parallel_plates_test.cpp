// Two parallel plates at a uniform gap: the force is area times phi'(gap), whatever the meshes.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <Eigen/Geometry>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/contact/terms/contact_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

constexpr double side = 0.1, area = side * side, dhat = 1e-3;  // m

struct Plates {
  int lower_cells = 4, upper_cells = 5;
  double gap = 1.3e-3;      // m
  double upper_side = 0.2;  // m; the lower outline lies well inside
  std::string integrate = "lower", weights = "area";
  Vec3 axis = Vec3::UnitY();
  double angle = 0;

  std::string yaml() const {
    const auto plate = [&](const char* name, double size, int cells, double y, const char* more) {
      const Vec3 to = Eigen::AngleAxisd(angle, axis.normalized()) * Vec3(0, y, 0);
      return fmt::format(
          "  - {{name: {}, shape: {{type: box, size: [{}, 0.01, {}], cells: [{}, 1, {}]}},\n"
          "     place: {{axis: [{}, {}, {}], angle: {}, translate: [{}, {}, {}]}}, {}}}\n",
          name, size, size, cells, cells, axis.x(), axis.y(), axis.z(), angle, to.x(), to.y(), to.z(), more);
    };
    return "objects:\n" + plate("upper", upper_side, upper_cells, 0.005 + gap, "motion: [fixed]") +
           plate("lower", side, lower_cells, -0.005, "energies: [{type: neo_hookean, young: 1e5}]") +
           fmt::format("contact:\n  distance: {}\n  weights: {}\n  barrier: {{type: clamped_log, stiffness: 3e3}}\n"
                       "  pairs: [{{between: [lower, upper], integrate: {},\n"
                       "    adhesion: {{type: fang, young: 1e4, critical_strain: 0.2}}}}]\n",
                       dhat, weights, integrate);
  }
};

// Returns the pull of the upper plate on the lower one, along the normal of the plates and across it [N].
struct Pull {
  double normal, tangential;
};
Pull pull(const Plates& plates, LawTerm term = LawTerm::all) {
  TestScene scene(plates.yaml());
  World& world = *scene.world;
  world.contact->move_to(world.rest);
  const Vec3 force =
      contact_term(world).force_between(world.rest, term,
                                        {world.body_index("lower"), world.body_index("upper")});
  const Vec3 normal = Eigen::AngleAxisd(plates.angle, plates.axis.normalized()) * Vec3::UnitY();
  return {force.dot(normal), (force - force.dot(normal) * normal).norm()};
}

double slope(const std::string& kind, double gap) {
  const auto barrier = bind_component<BarrierLaw>(parse_string("{type: clamped_log, stiffness: 3e3}", "t"));
  const auto adhesion = bind_component<AdhesionLaw>(parse_string("{type: fang, young: 1e4, critical_strain: 0.2}", "t"));
  NormalLaw* const law = kind == "barrier" ? barrier.get() : dynamic_cast<NormalLaw*>(adhesion.get());
  law->prepare({dhat, 1e5, 0});
  return law->at(gap).slope;
}

}  // namespace

TEST_CASE("parallel plates: the force is A phi' for meshes that do not match", "[contact]") {
  for (const double gap : {0.6e-3, 0.85e-3, 1.3e-3, 1.9e-3}) {
    const double expected = area * (slope("barrier", gap) + slope("adhesion", gap));
    for (const int cells : {4, 8, 16, 32}) {
      for (const int other : {1, 5, 13}) {
        INFO("gap " << gap << ", cells " << cells << " on " << other);
        const Pull p = pull({.lower_cells = cells, .upper_cells = other, .gap = gap});
        CHECK(p.normal == Approx(expected).epsilon(1e-6));
        CHECK(p.tangential <= 1e-9 * std::abs(expected));
      }
    }
  }
}

TEST_CASE("parallel plates: turned in space", "[contact]") {
  const double expected = area * slope("adhesion", 1.3e-3);
  const Pull p = pull({.lower_cells = 7, .upper_cells = 9, .axis = Vec3(1, 2, -0.4), .angle = 1.1});
  CHECK(p.normal == Approx(expected).epsilon(1e-6));
  CHECK(p.tangential <= 1e-9 * expected);
}

TEST_CASE("parallel plates: the law terms add up", "[contact]") {
  const Plates plates{.lower_cells = 6, .upper_cells = 7, .gap = 0.7e-3};
  CHECK(pull(plates, LawTerm::barrier).normal == Approx(area * slope("barrier", 0.7e-3)).epsilon(1e-6));
  CHECK(pull(plates, LawTerm::adhesion).normal == Approx(area * slope("adhesion", 0.7e-3)).epsilon(1e-6));
}

TEST_CASE("parallel plates of equal outline: either side may integrate", "[contact]") {
  const double expected = area * slope("adhesion", 1.3e-3);
  for (const std::string integrate : {"lower", "upper", "both", "finer"}) {
    INFO(integrate);
    const Plates plates{.lower_cells = 5, .upper_cells = 7, .upper_side = side, .integrate = integrate};
    CHECK(pull(plates).normal == Approx(expected).epsilon(1e-6));
  }
}

// The reason for area weights: plain sums count an area once for each primitive that sees it.
TEST_CASE("parallel plates: plain sums depend on the mesh", "[contact]") {
  const double expected = area * slope("adhesion", 1.3e-3);
  for (const int cells : {4, 16}) {
    const double coarse = pull({.lower_cells = cells, .upper_cells = 5, .weights = "pair"}).normal;
    CHECK(coarse > 1.2 * expected);
  }
}
