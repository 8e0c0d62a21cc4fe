// Copies of an object in a region: the requested number, apart from each other, inside the region,
// and equal for equal seeds.
#include "framework/scene/fill.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/experiment/load_experiment.hpp"
#include "geometry/distance/squared_distance.hpp"
#include "geometry/mesh/mass_properties.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"
#include "tests/support/scene.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::string grains(const std::string& fill, const std::string& more = "body: affine") {
  return fmt::format("objects:\n  - {{name: wall, shape: {{type: box, size: [1, 1, 1]}}, place: {{translate: [5, 0, 0]}}, motion: [fixed]}}\n"
                     "  - name: grain\n    shape: {{type: sphere, radius: 0.05, cells: 3, surface: true}}\n    place: {{scale: [2, 1, 1]}}\n"
                     "    {}\n    fill: {{{}}}\n", more, fill);
}

const std::string in_ball = "region: {type: sphere, radius: 0.5}, clearance: 0.02";

LoadedExperiment loaded(const std::string& scene) { return parse_experiment("name: test\ntime: {step: 0.01, duration: 1}\n" + scene, "test"); }

std::vector<std::array<Vec3, 3>> triangles_of(const World& world, int body) {
  std::vector<std::array<Vec3, 3>> all;
  for (const Triangle& t : world.bodies[body].triangles)
    all.push_back({vertex(world.rest, t[0]), vertex(world.rest, t[1]), vertex(world.rest, t[2])});
  return all;
}

// Returns the smallest distance by brute force, over all vertex-triangle and edge-edge pairs.
double distance(const std::vector<std::array<Vec3, 3>>& a, const std::vector<std::array<Vec3, 3>>& b) {
  double least = 1e9;
  for (const auto& s : a)
    for (const auto& t : b)
      for (int i = 0; i < 3; ++i) {
        least = std::min({least, point_triangle_distance(s[i], t[0], t[1], t[2]), point_triangle_distance(t[i], s[0], s[1], s[2])});
        for (int j = 0; j < 3; ++j) least = std::min(least, edge_edge_distance(s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3]));
      }
  return std::sqrt(least);
}

}  // namespace

TEST_CASE("a fill makes the requested copies, separate and inside the region", "[fill]") {
  TestScene scene(grains(in_ball + ", count: 60"));
  const World& world = *scene.world;
  REQUIRE(world.bodies.size() == 61);
  CHECK(world.bodies[1].name == "grain_1");
  CHECK(world.bodies[60].name == "grain_60");
  CHECK(scene.config.objects[60].groups == std::vector<std::string>{"grain"});
  double least = 1e9, outermost = 0;
  std::vector<std::vector<std::array<Vec3, 3>>> all;
  for (int b = 1; b <= 60; ++b) {
    all.push_back(triangles_of(world, b));
    for (const auto& t : all.back())
      for (const Vec3& x : t) outermost = std::max(outermost, x.norm());
  }
  const auto box = [](const std::vector<std::array<Vec3, 3>>& triangles) {
    Eigen::AlignedBox3d around;
    for (const auto& t : triangles)
      for (const Vec3& x : t) around.extend(x);
    return around;
  };
  for (size_t i = 0; i < all.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (box(all[i]).exteriorDistance(box(all[j])) < 0.03) least = std::min(least, distance(all[i], all[j]));
  CHECK(least >= 0.02);
  CHECK(least < 0.025);
  CHECK(outermost <= 0.48 + 1e-9);
  // Turned: their long axes point anywhere.
  Vec3 extent = Vec3::Zero();
  for (const auto& triangles : all) extent += box(triangles).sizes() / 60;
  CHECK(extent.minCoeff() > 0.11);
  CHECK(extent.maxCoeff() < 0.19);
}

TEST_CASE("a fill is determined by its seed", "[fill]") {
  const auto places = [](int seed) { return to_value(fields_of(loaded(grains(in_ball + fmt::format(", count: 20, seed: {}", seed))).experiment.objects[7].placement)); };
  const auto text = [](const Value& value) {
    std::string all;
    for (const auto& entry : value.entries) {
      all += entry.value.text;
      for (const Value& item : entry.value.items) all += " " + item.text;
    }
    return all;
  };
  CHECK(text(places(3)) == text(places(3)));
  CHECK(text(places(3)) != text(places(4)));
}

TEST_CASE("a fill counts by volume, keeps copies upright, or makes one object of them", "[fill]") {
  const LoadedExperiment packed = loaded(grains("region: {type: box, size: [1, 0.6, 0.8]}, clearance: 0.005, packing: 0.15"));
  TestScene one(grains(in_ball + ", count: 12, into: one, rotate: false"));
  const double volume = mass_properties(packed.experiment.objects[1].shape->make()).volume * 2;
  const double expected = 0.15 * 0.48 / volume;
  CHECK(std::abs(static_cast<double>(packed.experiment.objects.size() - 1) - expected) < 0.02 * expected + 1);
  REQUIRE(one.world->bodies.size() == 2);
  const Body& all = one.world->bodies[1];
  CHECK(all.name == "grain");
  const size_t each = extract_surface(one.config.objects[1].shape->make()).triangles.size() / 12;
  CHECK(all.triangles.size() == 12 * each);
  Eigen::AlignedBox3d first;
  for (size_t t = 0; t < each; ++t)
    for (const int v : all.triangles[t]) first.extend(vertex(one.world->rest, v));
  CHECK(first.sizes().x() == Approx(2 * first.sizes().y()));
}

TEST_CASE("an impossible fill is refused with the number of copies that fit", "[fill]") {
  CHECK_THROWS_WITH(loaded(grains(in_ball + ", count: 5000")),
                    Contains("object 'grain'") && Contains("of 5000 copies") && Contains("test:5:5"));
  CHECK_THROWS_WITH(loaded(grains("region: {type: plane}, clearance: 0.1, count: 3")), Contains("bounded"));
  CHECK_THROWS_WITH(loaded(grains(in_ball)), Contains("either count or packing"));
  CHECK_THROWS_WITH(loaded(grains(in_ball + ", count: 3, packing: 0.1")), Contains("either count or packing"));
}

TEST_CASE("points and rods fill regions too", "[fill]") {
  const LoadedExperiment dust = loaded(
      "objects:\n  - name: dust\n    shape: {type: points}\n    particle: {radius: 5 mm}\n    energies: [{type: particle, density: 1000}]\n"
      "    fill: {region: {type: box, size: [0.1, 0.1, 0.1]}, clearance: 12 mm, count: 100, into: one}\n"
      "  - name: straw\n    shape: {type: segment, length: 0.05, edges: 3}\n    rod: {radius: 1 mm}\n    energies: [{type: elastic_rod, young: 1e6, density: 1000}]\n"
      "    fill: {region: {type: box, size: [0.2, 0.1, 0.1], place: {translate: [1, 0, 0]}}, clearance: 3 mm, count: 50}\n");
  REQUIRE(dust.experiment.objects.size() == 51);
  const Mesh mesh = dust.experiment.objects[0].shape->make();
  REQUIRE(mesh.points.size() == 100);
  double least = 1;
  for (size_t i = 0; i < 100; ++i)
    for (size_t j = 0; j < i; ++j) least = std::min(least, (mesh.vertices[i] - mesh.vertices[j]).norm());
  CHECK(least >= 0.012);
}
