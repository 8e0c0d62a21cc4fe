// Objects with small gaps to themselves at rest: no force there, and pressure when pressed shut.
#include "framework/contact/surface/rest_gaps.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/core/step_filter.hpp"
#include "framework/world/world.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

// A shape with gaps D to itself at rest, which nearly close as `closed` goes to 1.
struct CloseShape {
  std::string name, shape, body;
  double gap;                                           // D [m]
  std::function<Vec3(const Vec3& rest, double closed)> squeezed;
  std::function<Vec3(const Vec3& rest)> slid = {};      // positions with one side slid along the other [m]

  // offset: of one side [m]
  std::string yaml(double offset, double distance) const {
    return fmt::format("objects:\n  - {{name: it, shape: {}, contact_offset: {}, {}}}\ncontact: {{distance: {}}}\n", shape, offset, body, distance);
  }
  VecX at(const VecX& rest, double closed) const {
    VecX x = rest;
    for (int v = 0; v < x.size() / 3; ++v) vertex(x, v) = squeezed(vertex(rest, v), closed);
    return x;
  }
};

const std::string rod = "rod: {radius: 1 mm}, energies: [{type: elastic_rod, young: 10 MPa, density: 1000}]";
const std::string sheet = "shell: {thickness: 0.1 mm}, energies: [{type: stvk_membrane, young: 1 MPa, density: 1000}]";

Vec3 flattened(const Vec3& x, int axis, double closed) {
  Vec3 y = x;
  y(axis) *= 1 - closed;
  return y;
}

constexpr double pi = M_PI, slit_angle = 0.03, ring = 0.01, tape = 3e-4;

std::vector<CloseShape> close_shapes() {
  const auto along_y = [](const Vec3& x, double closed) { return flattened(x, 1, closed); };
  std::vector<CloseShape> all;
  all.push_back({"spring", "{type: helix, radius: 10 mm, pitch: 2.5 mm, turns: 3, edges: 72}", rod, 2.5e-3, along_y});
  // A trefoil, 2.4 mm from strand to strand where they cross.
  all.push_back({"knot",
                 "{type: warped, of: {type: segment, length: 5.9, edges: 90}, x: 0.006 * (sin(x) + 2 * sin(2 * x)), y: -0.00168 * sin(3 * x), "
                 "z: 0.006 * (cos(x) - 2 * cos(2 * x))}", rod, 2.4e-3, along_y});
  // Two layers that are joined by a bulge.
  all.push_back({"folded sheet",
                 "{type: warped, of: {type: grid, size: [0.02, 0.003], cells: [80, 6]}, x: sqrt(x^2 + 1e-7), "
                 "y: tanh(x / 0.0003) * (0.00015 + 0.001 * exp(-(x / 0.0015)^2)), z: z}",
                 sheet, 3e-4, along_y, [](const Vec3& x) { return x.y() > 0 ? Vec3(1, 0, 0.3) : Vec3(0, 0, 0); }});
  all.push_back({"roll of tape",
                 fmt::format("{{type: warped, of: {{type: grid, size: [15, 0.002], cells: [180, 4]}}, x: (0.004 + {0} * x / (2 * pi)) * cos(x), "
                             "y: (0.004 + {0} * x / (2 * pi)) * sin(x), z: z}}", tape), sheet, tape,
                 [](const Vec3& x, double closed) {
                   const double radius = std::hypot(x.x(), x.y());
                   return Vec3(x.x() * (1 - closed * (radius - 0.004) / radius), x.y() * (1 - closed * (radius - 0.004) / radius), x.z());
                 }});
  // A ring that is cut through.
  all.push_back({"slit",
                 fmt::format("{{type: warped, of: {{type: box, size: [1, 0.002, 0.002], cells: [40, 3, 3]}}, x: ({0} - y) * cos({1} * x), y: ({0} - y) * sin({1} * x), z: z}}",
                             ring, 2 * pi - slit_angle), "energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]", slit_angle * (ring - 0.001),
                 [](const Vec3& x, double closed) {
                   const double more = 1 + closed * slit_angle / (2 * pi - slit_angle), angle = more * std::atan2(x.y(), x.x()), radius = std::hypot(x.x(), x.y());
                   return Vec3(radius * std::cos(angle), radius * std::sin(angle), x.z());
                 }});
  return all;
}

// The offset o of a side is at most 0.95 of the gap.
double room(const CloseShape& shape, double offset) { return 1 - std::min(2 * offset / shape.gap, 0.95); }

struct Close {
  TestScene scene;
  World& world;
  Close(const CloseShape& shape, double offset, double distance) : scene(shape.yaml(offset, distance)), world(*scene.world) {
    world.contact->begin_step({world.rest});
  }
  double energy(const VecX& x) {
    world.contact->move_to(x);
    return contact_term(world).value(x);
  }
};

}  // namespace

TEST_CASE("a body that is close to itself at rest has no force there, and presses when its gap is closed", "[contact][rest]") {
  for (const CloseShape& shape : close_shapes())
    for (const double offset : {0.0, 0.4, 0.6})  // of a side, in gaps: with the last, the two overlap
      for (const double reach : {0.1, 3.0}) {
        CAPTURE(shape.name, offset, reach);
        Close close(shape, offset * shape.gap, reach * shape.gap);
        World& world = close.world;
        CHECK(close.energy(world.rest) == 0);
        CHECK(contact_term(world).forces(world.rest, LawTerm::all).isZero(0));
        const double most = room(shape, offset * shape.gap);
        double before = 0;
        for (const double part : {0.92, 0.94}) {
          const VecX x = shape.at(world.rest, part * most);
          world.contact->begin_step({x});
          const double energy = close.energy(x);
          CHECK(std::isfinite(energy));
          CHECK(energy > before);
          before = energy;
        }
      }
}

TEST_CASE("a body that is close to itself at rest never passes through itself, and keeps its reduced offset", "[contact][rest]") {
  PhaseClock clock;
  for (const CloseShape& shape : close_shapes())
    for (const double offset : {0.0, 0.4, 0.6}) {
      CAPTURE(shape.name, offset);
      Close close(shape, offset * shape.gap, 0.5 * shape.gap);
      World& world = close.world;
      const VecX x = shape.at(world.rest, 0.5 * room(shape, offset * shape.gap)), p = shape.at(world.rest, 1.2) - x;
      world.contact->cover(x, p);
      const auto ccd = Registry<StepFilter>::make("ccd");
      const FeasibilityContext context{world.contact.get(), world.tets, clock};
      REQUIRE(ccd->attach(context));
      const double t = ccd->largest_step(x, p, 1);
      CHECK(t > 0);
      CHECK(t < 1);
      CHECK(std::isfinite(close.energy(x + t * p)));
      CHECK(world.contact->smallest_gaps(x + t * p).of_all > 0);
    }
}

TEST_CASE("forces of a body that is close to itself at rest are the derivatives of one energy as it slides", "[contact][rest]") {
  for (const CloseShape& shape : close_shapes())
    if (shape.slid)
      for (const double offset : {0.0, 0.4}) {
        Close close(shape, offset * shape.gap, 0.7 * shape.gap);
        World& world = close.world;
        const VecX pressed = shape.at(world.rest, 0.93 * room(shape, offset * shape.gap));
        VecX direction = VecX::Zero(pressed.size());
        for (int v = 0; v < direction.size() / 3; ++v) vertex(direction, v) = shape.slid(vertex(world.rest, v));
        // Over several elements.
        constexpr double step = 1e-9;
        for (double s = 0; s < 1e-3; s += 3.7e-5) {
          CAPTURE(shape.name, offset, s);
          const double before = close.energy(pressed + (s - step) * direction), after = close.energy(pressed + (s + step) * direction);
          close.energy(pressed + s * direction);
          const double force = contact_term(world).forces(pressed + s * direction, LawTerm::all).dot(direction);
          const double size = contact_term(world).forces(pressed + s * direction, LawTerm::all).norm();
          REQUIRE(size > 0);
          CHECK(std::abs((before - after) / (2 * step) - force) < 1e-5 * size * std::sqrt(direction.size()));
        }
      }
}
