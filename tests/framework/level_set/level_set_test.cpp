// Bodies from signed distances: volumes and areas against formulas, and refused input.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <random>

#include <tbb/global_control.h>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/level_set/level_set.hpp"
#include "framework/shapes/shape_source.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/mesh/mass_properties.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/validate.hpp"

using namespace tack;
using Catch::Contains;

namespace {

Mesh mesh_of(const std::string& level_set, double voxel) {
  const std::string yaml = fmt::format("{{type: level_set, voxel: {}, of: {}}}", voxel, level_set);
  return bind_component<ShapeSource>(parse_string(yaml, "test"))->make();
}

std::unique_ptr<LevelSet> level_set(const std::string& yaml) { return bind_component<LevelSet>(parse_string(yaml, "test")); }

struct Formula {
  std::string level_set;
  double volume, area;  // m^3, m^2
};

// Frusta, caps, a body and its parallel one: elementary formulas.
const double third = 4 * M_PI / 3, slant = std::hypot(1.5, 0.7);
const std::vector<Formula> formulas = {
    {"{type: sphere, radius: 1}", third, 4 * M_PI},
    {"{type: box, size: [1, 2, 3]}", 6, 22},
    {"{type: box, size: [2, 2, 2], rounding: 1}", third, 4 * M_PI},
    {"{type: capsule, from: [0, 0, 0], to: [1, 1, 1], radius: 0.5}", third / 8 + M_PI / 4 * std::sqrt(3), M_PI + M_PI * std::sqrt(3)},
    {"{type: torus, radius: 1, tube: 0.4}", 2 * M_PI * M_PI * 0.16, 4 * M_PI * M_PI * 0.4},
    {"{type: cylinder, radius: 1, height: 1.5}", 1.5 * M_PI, 5 * M_PI},
    {"{type: cone, radius: 1, top_radius: 0.3, height: 1.5}", M_PI * 0.5 * 1.39, M_PI * (1.09 + 1.3 * slant)},
    {"{type: cone, radius: 1, height: 1.5}", M_PI / 2, M_PI * (1 + std::hypot(1.5, 1))},
    {"{type: extruded, polygon: [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], depth: 1}", 3, 14},
    {"{type: text, text: \"-\", height: 2, stroke: 0.5, depth: 1}", 0.5 + M_PI / 16, 2 * (0.5 + M_PI / 16) + 2 + M_PI / 2},
    {"{type: shell, thickness: 0.4, of: {type: sphere, radius: 1}}", third * (1.728 - 0.512), 4 * M_PI * (1.44 + 0.64)},
    {"{type: offset, distance: 0.3, of: {type: box, size: [1, 1, 1]}}", 2.8 + 0.27 * M_PI + third * 0.027, 6 + 1.8 * M_PI + 0.36 * M_PI},
    {"{type: offset, distance: -0.3, of: {type: box, size: [2, 2, 2]}}", 1.4 * 1.4 * 1.4, 6 * 1.96},
    {"{type: twist, rate: 2, of: {type: box, size: [1, 3, 0.5]}}", 1.5, 0},
    {"{type: bend, radius: 1, of: {type: box, size: [5, 0.5, 0.5]}}", 1.25, 2 * 0.25 + 4 * 2.5},
    {"{type: array, counts: [3, 2, 1], spacing: [1.5, 1.5, 1.5], of: {type: sphere, radius: 0.6}}", 6 * third * 0.216, 6 * 4 * M_PI * 0.36},
    {"{type: difference, of: [{type: sphere, radius: 1}, {type: plane, normal: [1, 1, 0]}]}", third / 2, 3 * M_PI},
    {"{type: intersection, of: [{type: sphere, radius: 1}, {type: plane, normal: [0, 1, 0], offset: 0.5}]}", third - M_PI / 3 * 0.25 * 2.5, 3 * M_PI + 0.75 * M_PI},
    {"{type: union, of: [{type: box, size: [1, 1, 1]}, {type: box, size: [1, 1, 1], place: {translate: [0.5, 0, 0]}}]}", 1.5, 8},
    {"{type: mesh, shape: {type: box, size: [1, 2, 1], cells: [2, 2, 2]}}", 2, 10},
    {"{type: sphere, radius: 1, place: {scale: [1, 2, 0.5], axis: [1, 1, 0], angle: 30 deg, translate: [3, 0, 0]}}", third, 0},
};

}  // namespace

TEST_CASE("volumes and areas of level sets converge to their formulas", "[level_set]") {
  constexpr double chance = 5e-4;  // errors below it depend on the position of the voxels
  for (const Formula& f : formulas) {
    std::vector<double> volume_errors, area_errors;
    for (const double voxel : {0.1, 0.03}) {
      const Mesh mesh = mesh_of(f.level_set, voxel);
      CHECK_NOTHROW(validate_mesh(mesh, "mesh"));
      volume_errors.push_back(std::abs(mass_properties(mesh).volume / f.volume - 1));
      area_errors.push_back(f.area == 0 ? 0 : std::abs(total_area(mesh) / f.area - 1));
    }
    INFO(f.level_set << ": volumes " << volume_errors[0] << " " << volume_errors[1] << ", areas " << area_errors[0] << " " << area_errors[1]);
    CHECK(volume_errors[1] < 0.01);
    CHECK(area_errors[1] < 0.015);
    CHECK(volume_errors[1] < std::max(0.6 * volume_errors[0], chance));
    CHECK(area_errors[1] < std::max(0.6 * area_errors[0], chance));
  }
}

TEST_CASE("level sets are nowhere steeper than distances, and positive outside of their bounds", "[level_set]") {
  std::vector<std::string> all = {
      "{type: union, blend: 0.5, of: [{type: sphere, radius: 1}, {type: sphere, radius: 0.7, place: {translate: [1, 0, 0]}}]}",
      "{type: difference, blend: 0.3, of: [{type: sphere, radius: 1}, {type: sphere, radius: 0.7, place: {translate: [1, 0, 0]}}]}",
      "{type: intersection, blend: 0.3, of: [{type: sphere, radius: 1}, {type: sphere, radius: 0.7, place: {translate: [1, 0, 0]}}]}",
      "{type: noise, amplitude: 0.2, wavelength: 0.5, octaves: 3, of: {type: sphere, radius: 1}}",
      "{type: bend, radius: 1, of: {type: box, size: [6, 0.5, 0.5], place: {translate: [0.1, 0, 0]}}}",
      "{type: text, text: \"A B-C\", height: 1, stroke: 0.1, depth: 0.2}"};
  for (const Formula& f : formulas) all.push_back(f.level_set);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  const auto anywhere = [&] { return Vec3(part(random), part(random), part(random)); };
  for (const std::string& yaml : all) {
    INFO(yaml);
    const auto body = level_set(yaml);
    body->prepare(0.05);
    const Eigen::AlignedBox3d box = body->bounds();
    REQUIRE(finite(box));
    // Points of the surface, for distances by brute force.
    const Mesh surface = mesh_of(yaml, 0.05);
    std::vector<Vec3> points;
    for (int i = 0; i < 400; ++i) points.push_back(box.center() + anywhere().cwiseProduct(box.sizes()));
    std::vector<double> values(points.size());
    body->evaluate(points, values);
    double most = -1;
    for (size_t i = 0; i < points.size(); ++i) {
      double nearest = 1e9;
      for (const Vec3& x : surface.vertices) nearest = std::min(nearest, (x - points[i]).norm());
      most = std::max(most, std::abs(values[i]) - nearest);
      if (box.exteriorDistance(points[i]) > 1e-9 && !(values[i] > 0)) FAIL("inside, beyond its bounds");
    }
    CHECK(most <= 0.05);
  }
}

TEST_CASE("level sets do not depend on the number of threads, the unit or the position", "[level_set]") {
  const auto text = [](double scale) {
    return fmt::format("{{type: difference, place: {{translate: [{1}, 0, 0]}}, of: [{{type: noise, amplitude: {0}, wavelength: {1}, of: {{type: sphere, "
                       "radius: {1}}}}}, {{type: torus, radius: {1}, tube: {2}}}]}}", 0.05 * scale, scale, 0.2 * scale);
  };
  const Mesh one = mesh_of(text(1), 0.1);
  {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    const Mesh alone = mesh_of(text(1), 0.1);
    CHECK(alone.vertices == one.vertices);
    CHECK(alone.triangles == one.triangles);
  }
  for (const double scale : {1e-6, 1e3}) {
    const Mesh other = mesh_of(text(scale), 0.1 * scale);
    REQUIRE(other.vertices.size() == one.vertices.size());
    double off = 0;
    for (size_t i = 0; i < one.vertices.size(); ++i) off = std::max(off, (other.vertices[i] / scale - one.vertices[i]).norm());
    CHECK(off < 1e-6);
  }
}

TEST_CASE("an interrupt ends the meshing of a level set", "[level_set]") {
  interrupt_requested = true;
  CHECK_THROWS_AS(mesh_of("{type: sphere, radius: 1}", 0.1), Interrupted);
  interrupt_requested = false;
}

TEST_CASE("invalid level sets are refused with the reason", "[level_set]") {
  CHECK_THROWS_WITH(mesh_of("{type: plane}", 0.1), Contains("no bounds") && Contains("intersect"));
  CHECK_THROWS_WITH(mesh_of("{type: sphere, radius: 0.01}", 0.1), Contains("0.1 m; take smaller"));
  CHECK_THROWS_WITH(mesh_of("{type: intersection, of: [{type: sphere, radius: 1}, {type: sphere, radius: 1, place: {translate: [3, 0, 0]}}]}", 0.1),
                    Contains("nothing is inside"));
  CHECK_THROWS_WITH(mesh_of("{type: sphere, radius: 1}", 1e-5), Contains("take larger"));
  CHECK_THROWS_WITH(mesh_of("{type: bend, radius: 0.2, of: {type: box, size: [1, 1, 1]}}", 0.1), Contains("larger radius"));
  CHECK_THROWS_WITH(mesh_of("{type: bend, radius: 1, of: {type: box, size: [7, 1, 1]}}", 0.1), Contains("longer than a circle"));
  CHECK_THROWS_WITH(mesh_of("{type: offset, distance: 0.1, of: {type: plane}}", 0.1), Contains("bounded"));
  CHECK_THROWS_WITH(mesh_of("{type: mesh, shape: {type: grid, size: [1, 1]}}", 0.1), Contains("closed"));
  CHECK_THROWS_WITH(level_set("{type: text, text: \"a$\", height: 1, stroke: 0.1, depth: 0.1}"), Contains("'$'"));
  CHECK_THROWS_WITH(level_set("{type: sphere, radius: 1, place: {scale: [1, 0, 1]}}"), Contains("no factor may be zero"));
  CHECK_THROWS_WITH(level_set("{type: extruded, polygon: [[0, 0], [1, 0], [1]], depth: 1}"), Contains("pairs"));
  CHECK_THROWS_WITH(level_set("{type: box, size: [1, 1, 1], rounding: 0.6}"), Contains("half the shortest edge"));
}

TEST_CASE("a body far from the origin has the mesh of one near it, or is refused if doubles cannot resolve its voxels") {
  const Mesh near = mesh_of("{type: sphere, radius: 3 cm}", 0.005);
  for (const double far : {1e3, 1e6}) {
    const Mesh mesh = mesh_of(fmt::format("{{type: sphere, radius: 3 cm, place: {{translate: [{}, 0, {}]}}}}", far, -far), 0.005);
    CHECK(mass_properties(mesh).volume == Approx(mass_properties(near).volume).epsilon(0.02));
    CHECK(mesh.vertices.size() == Approx(near.vertices.size()).epsilon(0.1));
    for (const Vec3& x : mesh.vertices) CHECK((x - Vec3(far, 0, -far)).norm() == Approx(0.03).margin(1e-5));
  }
  CHECK_THROWS_WITH(mesh_of("{type: sphere, radius: 3 cm, place: {translate: [1e9, 0, 0]}}", 0.005),
                    Contains("at 1e+09 m from the origin") && Contains("move it nearer (place.translate)"));
  CHECK_THROWS_AS(mesh_of("{type: sphere, radius: 3 cm, place: {translate: [1e100, 0, 0]}}", 0.005), InputError);
}

TEST_CASE("an inward offset with an empty result is refused") {
  CHECK_THROWS_WITH(mesh_of("{type: offset, distance: -1, of: {type: sphere, radius: 3 cm}}", 0.005),
                    Contains("level set 'offset': nothing is left of it") && Contains("distance is -1 m; offset by less"));
  CHECK(mass_properties(mesh_of("{type: offset, distance: -1 cm, of: {type: sphere, radius: 3 cm}}", 0.002)).volume == Approx(4 * M_PI / 3 * 8e-6).epsilon(0.02));
}
