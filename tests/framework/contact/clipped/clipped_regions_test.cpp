// Clipped adhesion of regions: closed forms of sheets with two regions each, forces where interfaces
// coincide, derivatives, areas, widths of strips.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/contact/area_integral/area_integral.hpp"
#include "framework/contact/clipped/clipped_adhesion_term.hpp"
#include "framework/contact/points/contact_points.hpp"
#include "tests/support/contact_terms.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double gap = 0.7e-3, width = 0.1, strip = 1e-3;  // m
constexpr double left_peak = 2e3, right_peak = 5e3, objects_peak = 1e3;  // Pa

std::string adhesion(double peak) { return fmt::format("{{type: fang, peak_traction: {}, peak_distance: 1e-3}}", peak); }

// Energy per area at the gap.
double energy_of(double peak) {
  const auto law = bind_component<AdhesionLaw>(parse_string(adhesion(peak), "law"));
  NormalLaw& normal = dynamic_cast<NormalLaw&>(*law);
  normal.prepare({1e-3, 1e5, 0});
  return normal.at(gap).value;
}

// A sheet of `width` over a wider one. The left halves of both have a law, the right halves
// another one, and the objects one more, or none.
struct Sheets {
  std::array<int, 2> cells{4, 8};  // upper, lower
  bool of_objects = false;
  double left = left_peak, right = right_peak;
  std::string integrate = "automatic";
  bool regions = true;

  std::string yaml() const {
    const auto sheet = [](const char* name, double side, int n) {
      return fmt::format("  - {{name: {}, shape: {{type: grid, size: [{}, {}], cells: [{}, {}]}}, place: {{translate: [0, {}, 0]}}, shell: {{thickness: 0.1 mm}},\n"
                         "     energies: [{{type: neo_hookean_membrane, young: 1e6}}]}}\n", name, side, side, n, n, std::string(name) == "upper" ? gap : 0);
    };
    const auto half = [](const char* object, const char* where) { return fmt::format("{{object: {}, select: {{type: formula, where: '{}'}}}}", object, where); };
    const auto pair = [&](const std::string& between, double peak) {
      return fmt::format("    - {{between: [{}], integrate: {}, tangential_adhesion: {{mu: 0.5}}, adhesion: {}}}\n", between, integrate, adhesion(peak));
    };
    std::string pairs;
    if (of_objects) pairs += pair("upper, lower", objects_peak);
    if (regions)
      pairs += pair(half("upper", "x < 1e-6") + ", " + half("lower", "x < 1e-6"), left) + pair(half("upper", "x > -1e-6") + ", " + half("lower", "x > -1e-6"), right);
    return "objects:\n" + sheet("upper", width, cells[0]) + sheet("lower", 2 * width, cells[1]) + "contact:\n  distance: 0.5e-3\n  model: clipped\n  pairs:\n" + pairs;
  }
};

struct Placed {
  explicit Placed(const Sheets& sheets, double shift, double noise = 0) : scene(sheets.yaml()), x(scene.world->rest) {
    RandomMotions random(5);
    x += noise * random.vectors(x.size());
    for (int v = 0; v < x.size() / 3; ++v)
      if (upper(v)) x(3 * v) += shift;
    begin(x);
  }
  bool upper(int v) const { return scene.world->body_of(v) == scene.world->body_index("upper"); }
  void begin(const VecX& at) {
    scene.world->participants.begin_step({at});
    scene.world->participants.move_to(at);
  }
  ClippedAdhesionTerm& term() const { return *clipped_adhesion(*scene.world); }
  double energy() const { return term().value(x); }
  Vec3 force_on_upper() const {
    const VecX gradient = dense_gradient(term(), x);
    Vec3 sum = Vec3::Zero();
    for (int v = 0; v < x.size() / 3; ++v)
      if (upper(v)) sum -= vertex(gradient, v);
    return sum;
  }

  TestScene scene;
  VecX x;
};

// Returns the lateral force on the upper sheet where interfaces coincide, between those to both
// sides of there. Interfaces have none; the ends of the upper sheet have
// the boundary forces of their laws on planes of the lower one.
double force_where_aligned(std::string_view integrate) {
  const double ends = width * (energy_of(left_peak) - energy_of(right_peak));
  return integrate == "lower" ? 0 : integrate == "both" ? 0.5 * ends : ends;
}

const std::vector<std::array<int, 2>> meshes{{4, 8}, {6, 8}, {10, 14}};

}  // namespace

TEST_CASE("clipped regions: energy and lateral force of shifted halves", "[clipped]") {
  for (const std::array<int, 2>& cells : meshes)
    for (const bool of_objects : {false, true})
      for (const char* integrate : {"automatic", "lower", "both"})
        for (const double shift : {-0.0173, -0.0031, 0.0, 0.0012, 0.0077}) {
          INFO(cells[0] << " and " << cells[1] << " cells, law of objects " << of_objects << ", integrate " << integrate << ", shift " << shift);
          const Placed placed({cells, of_objects, left_peak, right_peak, integrate}, shift);
          const double left = width * energy_of(left_peak), right = width * energy_of(right_peak), outside = of_objects ? width * energy_of(objects_peak) : 0;
          const double energy = (0.5 * width - std::max(shift, 0.0)) * left + (0.5 * width - std::max(-shift, 0.0)) * right + std::abs(shift) * outside;
          CHECK(placed.energy() == Approx(energy).epsilon(1e-4));
          const double lateral = shift > 0 ? left - outside : shift < 0 ? outside - right : force_where_aligned(integrate);
          const Vec3 force = placed.force_on_upper();
          CHECK(force.x() == Approx(lateral).epsilon(3e-3).margin(1e-9 * std::abs(right)));
          CHECK(std::abs(force.z()) <= 1e-3 * std::abs(right));
        }
}

TEST_CASE("clipped regions: the force has no jump where interfaces coincide", "[clipped]") {
  const double scale = width * std::abs(energy_of(right_peak));
  for (const bool of_objects : {false, true})
    for (const char* integrate : {"automatic", "lower", "both"})
      for (const double shift : {-1e-6, -1e-9, -1e-12, 0.0, 1e-12, 1e-9, 1e-6}) {
        INFO("law of objects " << of_objects << ", integrate " << integrate << ", shift " << shift);
        const Placed placed({{4, 8}, of_objects, left_peak, right_peak, integrate}, shift);
        // rho'(0) / strip times the shift.
        CHECK(std::abs(placed.force_on_upper().x() - force_where_aligned(integrate)) <= (13 * std::abs(shift) / strip + 1e-9) * scale);
      }
}

TEST_CASE("clipped regions: a region with the law of its objects changes nothing", "[clipped]") {
  for (const double shift : {0.0, 3e-4, 0.0077}) {
    INFO("shift " << shift);
    const Placed with({{6, 8}, true, objects_peak, objects_peak}, shift, 1e-4), without({{6, 8}, true, 0, 0, "automatic", false}, shift, 1e-4);
    CHECK(with.energy() == Approx(without.energy()).epsilon(1e-12));
    CHECK((with.force_on_upper() - without.force_on_upper()).norm() <= 1e-11 * without.force_on_upper().norm());
  }
}

TEST_CASE("clipped regions: the gradient is that of the energy, the Hessian positive semi-definite", "[clipped]") {
  for (const bool of_objects : {false, true})
    for (const double shift : {0.0, 3e-4, 0.0077}) {
      INFO("law of objects " << of_objects << ", shift " << shift);
      Placed placed({{4, 8}, of_objects}, shift, 1e-4);
      ClippedAdhesionTerm& term = placed.term();
      const VecX gradient = dense_gradient(term, placed.x);
      const VecX slopes = gradient_by_differences([&](const VecX& y) {
        term.move_to(y);
        return term.value(y);
      }, placed.x, 1e-7);
      CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-5 * gradient.lpNorm<Eigen::Infinity>());
      placed.begin(placed.x);
      CHECK(total(gradient).norm() <= 1e-12 * gradient.cwiseAbs().sum());
      CHECK(total_moment(placed.x, gradient).norm() <= 1e-12 * gradient.cwiseAbs().sum());
      for_each_stencil_hessian(term, placed.x, Projection::clamp, [](const MatX& h, const int*) {
        REQUIRE(smallest_eigenvalue(h) >= -1e-12 * std::max(h.cwiseAbs().maxCoeff(), 1e-12));
      });
    }
}

TEST_CASE("clipped regions: contact points cover the overlap once", "[clipped]") {
  for (const bool of_objects : {false, true})
    for (const double shift : {0.0, 0.0077}) {
      INFO("law of objects " << of_objects << ", shift " << shift);
      // Halves without a law have no points.
      const Placed placed({{6, 8}, of_objects}, shift);
      double area = 0;
      const World& world = *placed.scene.world;
      for_each_record(contact_points({*world.contact, integrated_laws(world.contact->pairs(), 0, 1), placed.x}), [&](const auto& c) { area += c.area; });
      CHECK(area == Approx(width * (width - (of_objects ? 0 : shift))).epsilon(1e-4));
    }
}

TEST_CASE("clipped regions: pressure is separated by overlaps only where it differs", "[clipped]") {
  const auto separated = [](const std::string& of_left) {
    TestScene scene("objects:\n"
                    "  - {name: upper, shape: {type: grid, size: [0.1, 0.1], cells: [4, 4]}, place: {translate: [0, 0.7e-3, 0]}, shell: {thickness: 0.1 mm}, energies: [{type: neo_hookean_membrane, young: 1e6}]}\n"
                    "  - {name: lower, shape: {type: grid, size: [0.2, 0.2], cells: [8, 8]}, shell: {thickness: 0.1 mm}, energies: [{type: neo_hookean_membrane, young: 1e6}]}\n"
                    "contact:\n  distance: 1e-3\n  model: clipped\n  friction: {mu: 0.2}\n  barrier: {stiffness: 2 kPa}\n  pairs:\n"
                    "    - {between: [{object: upper, select: {type: formula, where: x < 1e-6}}, lower], adhesion: " + adhesion(left_peak) + of_left + "}\n");
    return dynamic_cast<const AreaIntegral&>(scene.world->contact->potential()).rules().any(&IntegrationRule::overlap_only);
  };
  CHECK(!separated(""));
  CHECK(!separated(", friction: {mu: 0.2}"));
  CHECK(separated(", friction: {mu: 0.3}"));
  CHECK(separated(", barrier: {type: clamped_log, stiffness: 3 kPa}"));
}

TEST_CASE("clipped regions: sheets whose interfaces coincide settle in few iterations", "[clipped]") {
  // The friction of one region has pressure integrated over overlaps, which takes few iterations
  // between sheets with cells of 2.5 ranges. Without strips along interfaces: 57 to 89 iterations at shifts below 1e-6.
  for (const double shift : {0.0, 1e-12, 1e-7, 1e-3}) {
    INFO("shift " << shift);
    const auto half = [](const char* object, const char* where) { return fmt::format("{{object: {}, select: {{type: formula, where: '{}'}}}}", object, where); };
    TestRun run(fmt::format(
        "time: {{step: 10 ms, duration: 0.05 s}}\n"
        "objects:\n"
        "  - {{name: lower, shape: {{type: grid, size: [20 cm, 20 cm], cells: [20, 20]}}, shell: {{thickness: 0.4 mm}}, motion: [fixed]}}\n"
        "  - {{name: upper, shape: {{type: grid, size: [10 cm, 10 cm], cells: [10, 10]}}, place: {{translate: [{}, 1.4 mm, 0]}}, shell: {{thickness: 0.4 mm}},\n"
        "     energies: [{{type: neo_hookean_membrane, young: 200 MPa, poisson: 0.3, density: 900}}, {{type: hinge_bending, young: 200 MPa, poisson: 0.3}}]}}\n"
        "contact:\n"
        "  distance: 2 mm\n"
        "  barrier: {{stiffness: 2 kPa}}\n"
        "  model: clipped\n"
        "  pairs:\n"
        "    - {{between: [{}, {}], adhesion: {{type: fang, peak_traction: 1 kPa}}}}\n"
        "    - {{between: [{}, {}], friction: {{mu: 0.01}}, adhesion: {{type: fang, peak_traction: 2.5 kPa}}}}\n",
        shift, half("lower", "x < 1e-6"), half("upper", "x < 0.0011"), half("lower", "x > -1e-6"), half("upper", "x > -1e-6")));
    int iterations = 0;
    for (int step = 0; step < 5; ++step) iterations += run.step().solve.iterations;
    CHECK(iterations <= 20);  // measured 8 to 11
  }
}
