// A stated traction acts per area of overlap, whatever the meshes: for bodies that overlap partly,
// are thin, or touch themselves.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/contact/area_integral/surface_overlap.hpp"
#include "tests/framework/contact/barrier_and_fang.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

struct Box {
  Vec3 size;
  std::array<int, 3> cells;
  Vec3 low;  // its lowest corner [m]
  double angle = 0;  // about y, of the scene's origin

  std::string yaml(const char* name, const char* more) const {
    const double c = std::cos(angle), s = std::sin(angle);
    const Vec3 m = low + size / 2, at(c * m.x() + s * m.z(), m.y(), c * m.z() - s * m.x());
    return fmt::format("  - {{name: {}, shape: {{type: box, size: [{}, {}, {}], cells: [{}, {}, {}]}},\n"
                       "     place: {{axis: [0, 1, 0], angle: {}, translate: [{}, {}, {}]}}, {}}}\n",
                       name, size.x(), size.y(), size.z(), cells[0], cells[1], cells[2], angle, at.x(), at.y(),
                       at.z(), more);
  }
};

const char* material = "energies: [{type: neo_hookean, young: 1e5}]";

// phi' of barrier and adhesion at a distance [Pa].
double traction(double distance, bool adhesive = true) { return laws_at(distance, adhesive).slope; }

// Returns the force of the lower body on the upper one [N], positive downwards.
Vec3 force_between(const Box& upper, const Box& lower, const std::string& pair) {
  TestScene scene("objects:\n" + upper.yaml("upper", material) + lower.yaml("lower", material) +
                  contact("between: [upper, lower]" + pair));
  World& world = *scene.world;
  world.contact->begin_step({world.rest});
  world.contact->move_to(world.rest);
  return -contact_term(world).force_between(world.rest, LawTerm::all,
                                            {world.body_index("upper"), world.body_index("lower")});
}

}  // namespace

TEST_CASE("contact integral: a cube on a wide ground, cells up to half the cube", "[contact]") {
  const double expected = 1e-4 * traction(gap);
  for (const double cell : {5e-3, 3.3e-3, 2.5e-3, 1.25e-3})
    for (const int cube_cells : {1, 3, 8})
      for (const Vec2& shift : {Vec2(0, 0), Vec2(0.5, 0.5), Vec2(0.25, 0.1), Vec2(0.01, 0.9)}) {
        const int n = static_cast<int>(std::round(0.04 / cell));
        const Box cube{{0.01, 0.01, 0.01}, {cube_cells, cube_cells, cube_cells}, {-0.005, gap, -0.005}};
        const Box ground{{n * cell, 0.01, n * cell}, {n, 1, n},
                         {-0.02 + shift.x() * cell, -0.01, -0.02 + shift.y() * cell}};
        INFO("ground cells " << cell << ", cube " << cube_cells << ", shift " << shift.transpose());
        const Vec3 f = force_between(cube, ground, sticks);
        CHECK(f.y() == Approx(expected).epsilon(0.05));
        CHECK(std::hypot(f.x(), f.z()) < 0.02 * expected);
      }
}

TEST_CASE("contact integral: the ground integrates, if the scene says so", "[contact]") {
  const double expected = 1e-4 * traction(gap);
  for (const double cell : {5e-3, 2.5e-3, 1.25e-3}) {
    const int n = static_cast<int>(std::round(0.04 / cell));
    const Box cube{{0.01, 0.01, 0.01}, {2, 2, 2}, {-0.005, gap, -0.005}};
    const Box ground{{n * cell, 0.01, n * cell}, {n, 1, n}, {-0.02 + 0.3 * cell, -0.01, -0.02 + 0.4 * cell}};
    INFO("ground cells " << cell);
    CHECK(force_between(cube, ground, sticks + ", integrate: lower").y() == Approx(expected).epsilon(0.05));
  }
}

TEST_CASE("contact integral: a ball over a ground that integrates, whatever the ground's cells", "[contact]") {
  const double radius = 5e-3, height = radius + 0.7e-3;
  // Integral over the points of the ground at a distance r from below the ball: each has its
  // distance to the ball along an inclined line, towards which its area is projected.
  double expected = 0;
  const int rings = 2000;
  const double far = std::sqrt(std::pow(radius + 2 * dhat, 2) - height * height), width = far / rings;
  for (int i = 0; i < rings; ++i) {
    const double r = (i + 0.5) * width, away = std::hypot(r, height);
    expected += traction(away - radius) * std::pow(height / away, 2) * 2 * M_PI * r * width;
  }
  for (const int n : {5, 7, 10, 14, 20, 40})
    for (const Vec2& shift : {Vec2(0.1, 0.2), Vec2(0.5, 0.5), Vec2(0.33, 0.9)}) {
      const double cell = 0.1 / n;
      const Box ground{{0.1, 0.01, 0.1}, {n, 1, n}, {-0.05 + shift.x() * cell, -0.01, -0.05 + shift.y() * cell}};
      TestScene scene(fmt::format("objects:\n  - {{name: ball, shape: {{type: sphere, radius: {}, cells: 12}}, place: {{translate: [0, {}, 0]}}, {}}}\n",
                                  radius, height, material) +
                      ground.yaml("ground", material) + contact("between: [ball, ground], integrate: ground" + sticks));
      World& world = *scene.world;
      world.contact->begin_step({world.rest});
      world.contact->move_to(world.rest);
      const Vec3 f = -contact_term(world).force_between(world.rest, LawTerm::all, {0, 1});
      INFO("cells of " << cell << ", shift " << shift.transpose() << ": " << f.y() / expected);
      CHECK(f.y() == Approx(expected).epsilon(0.06));
      CHECK(std::hypot(f.x(), f.z()) < 0.06 * expected);
    }
}

TEST_CASE("contact integral: metres or micrometres, over a solid and over both sides of a sheet", "[contact]") {
  const double expected = 1e-4 * traction(gap);
  const std::string box = "{type: box, size: [0.04, 0.01, 0.04], cells: [8, 1, 8]}", sheet = "{type: grid, size: [0.04, 0.04], cells: [8, 8]}";
  for (const double scale : {1.0, 1e-4, 1e-6})
    for (const auto& [shape, height, angle, side] : {std::tuple(box, -0.005, 0, "upper"), std::tuple(box, -0.005, 0, "lower"), std::tuple(sheet, 0.0, 0, "lower"),
                                                     std::tuple(sheet, 0.0, 180, "lower"), std::tuple(sheet, 0.0, 0, "upper"), std::tuple(sheet, 0.0, 180, "upper")}) {
      const auto placed = [&](double x, double y, int turned) {
        return fmt::format("place: {{scale: [{0}, {0}, {0}], axis: [1, 0, 0], angle: {1} deg, translate: [{2}, {3}, {2}]}}", scale, turned, scale * x, scale * y);
      };
      TestScene scene(fmt::format("objects:\n  - {{name: upper, shape: {{type: box, size: [0.01, 0.01, 0.01], cells: [2, 2, 2]}}, {}, {}}}\n"
                                  "  - {{name: lower, shape: {}, {}, motion: [{{type: fixed}}]}}\n"
                                  "contact:\n  distance: {}\n  barrier: {{type: clamped_log, stiffness: 3e3}}\n  pairs: [{{between: [upper, lower], integrate: {}{}}}]\n",
                                  placed(0, gap + 0.005, 0), material, shape, placed(1.7e-3, height, angle), scale * dhat, side, sticks));
      World& world = *scene.world;
      world.contact->begin_step({world.rest});
      world.contact->move_to(world.rest);
      const Vec3 f = -contact_term(world).force_between(world.rest, LawTerm::all, {0, 1}) / (scale * scale);
      INFO("scale " << scale << ", " << shape << " turned by " << angle << ", integrates: " << side);
      CHECK(f.y() == Approx(expected).epsilon(1e-3));
      CHECK(std::hypot(f.x(), f.z()) < 1e-3 * expected);
    }
}

TEST_CASE("contact integral: a tilted plate over a coarse ground that integrates", "[contact]") {
  const double slope = 0.1, low = 0.6e-3;  // from within range to far out of it
  double expected = 0;
  for (int i = 0; i < 2000; ++i) expected += 0.02 * 1e-5 * traction(low + slope * (i + 0.5) * 1e-5);
  for (const int n : {2, 4, 10, 40}) {
    const Box upper{{0.02, 2e-3, 0.02}, {20, 1, 20}, {0, low, -0.01}};
    const Box lower{{0.06, 0.01, 0.06}, {n, 1, n}, {-0.0213, -0.01, -0.0308}};
    TestScene scene("objects:\n" + upper.yaml("upper", material) + lower.yaml("lower", material) +
                    contact("between: [upper, lower], integrate: lower" + sticks));
    World& world = *scene.world;
    VecX x = world.rest;
    for (int v = 0; v < world.bodies[0].vertex_count; ++v) x(3 * v + 1) += slope * x(3 * v);
    world.contact->begin_step({x});
    world.contact->move_to(x);
    const double force = -contact_term(world).force_between(x, LawTerm::all, {0, 1}).y();
    INFO("cells " << n << ": " << force / expected);
    CHECK(force == Approx(expected).epsilon(0.05));
  }
}

TEST_CASE("contact integral: triangles out of range at the start of a step are subdivided when they come near", "[contact]") {
  const Box cube{{0.01, 0.01, 0.01}, {2, 2, 2}, {-0.005, 2.4e-3, -0.005}};
  const Box ground{{0.04, 0.01, 0.04}, {8, 1, 8}, {-0.0185, -0.01, -0.018}};
  TestScene scene("objects:\n" + cube.yaml("upper", material) + ground.yaml("lower", material) +
                  contact("between: [upper, lower], integrate: lower" + sticks));
  World& world = *scene.world;
  const auto moved = [&](double upper, double lower) {
    VecX x = world.rest;
    const int own = world.bodies[0].vertex_count;
    for (int v = 0; v < static_cast<int>(x.size() / 3); ++v) vertex(x, v) += Vec3(0.3, v < own ? upper : lower, -0.2);
    return x;
  };
  world.contact->begin_step({moved(0, 0)});
  world.contact->move_to(moved(0, 0));
  CHECK(overlap(world).interior_points().empty());
  world.contact->move_to(moved(-5e-3, -5e-3));  // in company
  CHECK(overlap(world).interior_points().empty());
  for (const double approach : {0.5e-3, 1e-3, 1.5e-3}) {
    world.contact->move_to(moved(-approach, 0));
    CHECK(overlap(world).interior_points().size() > 10);
    const double force = -contact_term(world).force_between(moved(-approach, 0), LawTerm::all, {0, 1}).y();
    CHECK(force == Approx(1e-4 * traction(2.4e-3 - approach)).epsilon(0.02));
  }
}

TEST_CASE("contact integral: crossed bars", "[contact]") {
  const double expected = 1e-4 * traction(gap);
  const std::vector<std::array<int, 2>> cells = {{2, 2}, {2, 3}, {3, 8}, {10, 8}, {20, 16}, {40, 3}, {40, 40}};
  for (const auto& [upper_cells, lower_cells] : cells)
    for (const double shift : {0.0, 2e-3}) {
      const Box upper{{0.1, 0.01, 0.01}, {upper_cells, 2, std::max(1, upper_cells / 10)}, {-0.05 + shift, gap, -0.005}};
      const Box lower{{0.01, 0.01, 0.1}, {std::max(1, lower_cells / 10), 2, lower_cells}, {-0.005, -0.01, -0.05 - shift}};
      INFO("cells " << upper_cells << " on " << lower_cells << ", shift " << shift);
      CHECK(force_between(upper, lower, sticks).y() == Approx(expected).epsilon(0.1));
    }
}

TEST_CASE("contact integral: plates that overlap in part", "[contact]") {
  for (const double overlap : {1.0, 0.93, 0.5, 0.1})
    for (const std::array<int, 2> cells : {std::array{8, 7}, std::array{8, 8}, std::array{3, 20}}) {
      const Box upper{{0.1, 0.01, 0.1}, {cells[0], 1, cells[0]}, {-0.05 + 0.1 * (1 - overlap), gap, -0.05}};
      const Box lower{{0.1, 0.01, 0.1}, {cells[1], 1, cells[1]}, {-0.05, -0.01, -0.05}};
      INFO("overlap " << overlap << ", cells " << cells[0] << " on " << cells[1]);
      CHECK(force_between(upper, lower, sticks).y() == Approx(0.01 * overlap * traction(gap)).epsilon(0.02));
    }
}

TEST_CASE("contact integral: thin plates count once", "[contact]") {
  const double expected = 4e-4 * traction(gap);
  for (const double thickness : {0.5e-3, 0.2e-3, 0.1e-3})
    for (const std::string integrate : {"automatic", "upper", "lower", "both"}) {
      const Box upper{{0.02, 5e-3, 0.02}, {8, 1, 8}, {-0.01, gap, -0.01}};
      const Box lower{{0.02, thickness, 0.02}, {10, 1, 10}, {-0.01, -thickness, -0.01}};
      INFO("thickness " << thickness << ", integrate " << integrate);
      CHECK(force_between(upper, lower, sticks + ", integrate: " + integrate).y() ==
            Approx(expected).epsilon(0.02));
    }
}

TEST_CASE("contact integral: a stretched plate adheres per present area, whichever side integrates", "[contact]") {
  for (const std::string integrate : {"automatic", "upper", "lower", "both"}) {
    const Box upper{{0.1, 0.01, 0.1}, {6, 1, 6}, {-0.05, gap, -0.05}};
    const Box lower{{0.3, 0.01, 0.3}, {20, 1, 20}, {-0.15, -0.01, -0.15}};
    TestScene scene("objects:\n" + upper.yaml("upper", material) + lower.yaml("lower", material) +
                    contact("between: [upper, lower], integrate: " + integrate + sticks));
    World& world = *scene.world;
    VecX x = world.rest;
    for (int v = 0; v < world.bodies[0].vertex_count; ++v) x(3 * v) *= 1.5;
    world.contact->begin_step({x});
    world.contact->move_to(x);
    INFO("integrate " << integrate);
    CHECK(-contact_term(world).force_between(x, LawTerm::all, {0, 1}).y() ==
          Approx(0.015 * traction(gap)).epsilon(0.02));
  }
}

TEST_CASE("contact integral: a body that slides without friction has no lateral force", "[contact]") {
  for (const double height : {0.8e-3, 0.55e-3})  // above the range of safety barriers
    for (const double cell : {5e-3, 2.5e-3})
      for (const double path : {0.0, 0.2, 0.4, 0.6, 0.8}) {
        const int n = static_cast<int>(std::round(0.04 / cell));
        const Box cube{{0.01, 0.01, 0.01}, {2, 2, 2}, {-0.005 + path * cell, height, -0.005 + 0.3 * path * cell}};
        const Box ground{{n * cell, 0.01, n * cell}, {n, 1, n}, {-0.02, -0.01, -0.02}};
        INFO("gap " << height << ", ground cells " << cell << ", path " << path);
        const Vec3 f = force_between(cube, ground, "");
        CHECK(f.y() < 0.0);
        CHECK(std::hypot(f.x(), f.z()) < 0.02 * std::abs(f.y()));
      }
}

// Without adhesion both sides carry pressure, with weights by their areas per vertex.
TEST_CASE("contact integral: plates press per area, whatever the sizes of their cells", "[contact]") {
  for (const int upper : {2, 6, 16})
    for (const int lower : {1, 6, 9}) {
      const Box above{{0.048, 0.01, 0.048}, {upper, 1, upper}, {-0.024, 0.6e-3, -0.024}};
      const Box below{{0.048, 0.01, 0.048}, {lower, 1, lower}, {-0.024, -0.01, -0.024}};
      INFO("cells " << upper << " above, " << lower << " below");
      const Vec3 f = force_between(above, below, "");
      CHECK(f.y() == Approx(0.048 * 0.048 * traction(0.6e-3, false)).epsilon(1e-9));
      CHECK(std::hypot(f.x(), f.z()) < 1e-6 * std::abs(f.y()));
    }
}

namespace {

// A strip that is folded once, with a gap between its two legs. at() maps points of the flat strip.
struct Fold {
  double length = 0.04, width = 0.01, thickness = 4e-3, opening;  // m

  Vec3 at(const Vec3& flat) const {  // flat: x along the strip from its middle, y across its thickness
    const double radius = opening / 2 + thickness / 2, arc = M_PI * radius;
    const double s = flat.x(), depth = flat.y();
    if (std::abs(s) <= arc / 2) {
      const double a = s / radius;
      return {-(radius + depth) * std::cos(a), (radius + depth) * std::sin(a), flat.z()};
    }
    const double side = s > 0 ? 1 : -1;
    return {std::abs(s) - arc / 2, side * (radius + depth), flat.z()};
  }
};

// Returns the force that pulls the outer half of the upper leg down, over the expected one.
double fold_force(double opening, double cell) {
  const Fold fold{.opening = opening};
  const int n = static_cast<int>(std::round(fold.length / cell)), m = static_cast<int>(std::round(fold.width / cell));
  TestScene scene("objects:\n" +
                  Box{{fold.length, fold.thickness, fold.width}, {n, 2, m}, {-fold.length / 2, -fold.thickness / 2, -fold.width / 2}}
                      .yaml("strip", material) +
                  contact("between: [strip, strip]" + sticks));
  World& world = *scene.world;
  VecX x = world.rest;
  for (int v = 0; v < world.mass.size(); ++v) vertex(x, v) = fold.at(vertex(world.rest, v));
  world.contact->begin_step({x});
  world.contact->move_to(x);
  const VecX force = contact_term(world).forces(x, LawTerm::all);
  // Half way between two rows of vertices.
  const double counted = (std::floor(n / 4.0) + 0.5) * fold.length / n;
  double pull = 0;
  for (int v = 0; v < world.mass.size(); ++v)
    if (vertex(world.rest, v).x() > fold.length / 2 - counted) pull -= vertex(force, v).y();
  return pull / (counted * fold.width * traction(opening));
}

}  // namespace

TEST_CASE("contact integral: a folded strip adheres to itself, whatever its elements", "[contact]") {
  for (const double cell : {2e-3, 1.4e-3, 1e-3, 0.7e-3, 0.5e-3, 0.25e-3}) {
    INFO("cells " << cell);
    CHECK(fold_force(1.3e-3, cell) == Approx(1).epsilon(0.03));
  }
}

TEST_CASE("contact integral: a folded strip that is pressed pushes, whatever its elements", "[contact]") {
  for (const double cell : {2e-3, 1e-3, 0.7e-3})
    for (const double opening : {0.8e-3, 0.6e-3}) {
      INFO("cells " << cell << ", opening " << opening);
      CHECK(fold_force(opening, cell) == Approx(1).epsilon(0.05));
    }
}

TEST_CASE("contact integral: a body alone has no contact energy, however small its elements", "[contact]") {
  for (const double cell : {2e-3, 0.5e-3}) {
    const int n = static_cast<int>(std::round(8e-3 / cell));
    const std::string self = contact("between: [cube, cube]" + sticks);
    TestScene scene("objects:\n" + Box{{8e-3, 8e-3, 8e-3}, {n, n, n}, {0, 0, 0}}.yaml("cube", material) + self);
    World& world = *scene.world;
    world.contact->begin_step({world.rest});
    world.contact->move_to(world.rest);
    CHECK(contact_term(world).value(world.rest) == 0.0);
  }
}

namespace {

// Work of the contact forces along a closed path of the upper body, over the work of adhesion of
// the overlap. Each segment of the path is a time step with re-evaluated areas and orientations.
double work_on_closed_path(const Box& upper, const Box& lower, const std::string& pair, double overlap) {
  TestScene scene("objects:\n" + upper.yaml("upper", material) + lower.yaml("lower", material) +
                  contact("between: [upper, lower]" + pair + sticks));
  World& world = *scene.world;
  const auto at = [&](const Vec3& moved) {
    VecX x = world.rest;
    for (int v = 0; v < world.bodies[0].vertex_count; ++v) vertex(x, v) += moved;
    return x;
  };
  const auto energy_at = [&](const VecX& x) {
    world.contact->move_to(x);
    return contact_term(world).value(x);
  };
  // Down at 45 degrees, along, and up straight, back above.
  const std::vector<Vec3> corners = {{-4e-3, 2e-3, -1e-3}, {-2e-3, 0, 0}, {2e-3, 0, 1e-3}, {2e-3, 2e-3, 1e-3}, {-4e-3, 2e-3, -1e-3}};
  double work = 0;
  for (size_t k = 0; k + 1 < corners.size(); ++k)
    for (int i = 0; i < 40; ++i) {
      const VecX from = at(corners[k] + (corners[k + 1] - corners[k]) * (i / 40.0));
      const VecX to = at(corners[k] + (corners[k + 1] - corners[k]) * ((i + 1) / 40.0));
      world.contact->begin_step({from});
      work -= energy_at(to) - energy_at(from);
    }
  return work / (world.adhesion.front().effective * overlap);
}

}  // namespace

TEST_CASE("contact integral: no energy is gained on a closed path", "[contact]") {
  for (const double cell : {5e-3, 1.25e-3}) {
    const int n = static_cast<int>(std::round(0.04 / cell));
    const Box cube{{0.01, 0.01, 0.01}, {4, 4, 4}, {-0.005, 1.2e-3, -0.005}};
    const Box ground{{n * cell, 0.01, n * cell}, {n, 1, n}, {-0.02 + 0.3 * cell, -0.01, -0.02 + 0.4 * cell}};
    INFO("ground cells " << cell);
    CHECK(std::abs(work_on_closed_path(cube, ground, "", 1e-4)) < 1e-3);
  }
}

TEST_CASE("contact integral: points inside triangles have the derivatives of their value", "[contact]") {
  const Box upper{{0.03, 0.01, 0.01}, {1, 1, 1}, {-0.015, 0.9e-3, -0.005}};
  const Box lower{{0.01, 0.01, 0.03}, {1, 1, 1}, {-0.005, -0.01, -0.015}};
  TestScene scene("objects:\n" + upper.yaml("upper", material) + lower.yaml("lower", material) +
                  contact("between: [upper, lower]" + sticks));
  World& world = *scene.world;
  RandomMotions random(5);
  const VecX x = world.rest + 1e-4 * random.vectors(world.rest.size());
  world.contact->begin_step({x});
  world.contact->move_to(x);
  const ContactSet& set = world.contact->contacts();
  CHECK(set.interior_triangle.size() > 10);
  const ContactTerm& term = contact_term(world);
  const VecX gradient = dense_gradient(term, x);
  const MatX hessian = dense_hessian(term, x, Projection::none);
  const auto at = [&](const VecX& y, const auto& evaluate) {
    world.contact->move_to(y);
    return evaluate(y);
  };
  const VecX slopes = gradient_by_differences(
      [&](const VecX& y) { return at(y, [&](const VecX& z) { return term.value(z); }); }, x, 1e-8);
  const MatX curvatures = hessian_by_differences(
      [&](const VecX& y) { return at(y, [&](const VecX& z) { return dense_gradient(term, z); }); }, x, 1e-8);
  CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-5 * gradient.lpNorm<Eigen::Infinity>());
  CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-4 * hessian.cwiseAbs().maxCoeff());
  world.contact->move_to(x);
  for (const Projection projection : {Projection::clamp, Projection::absolute})
    for_each_stencil_hessian(term, x, projection, [](const MatX& h, const int*) {
      REQUIRE(smallest_eigenvalue(h) >= -1e-12 * h.cwiseAbs().maxCoeff());
    });
}
