#include "framework/contact/surface/pair_radii.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace tack;

namespace {

// Returns objects with the given numbers of vertices.
ContactSurface surface_of(const std::vector<int>& vertices) {
  ContactSurface surface;
  for (int object = 0; object < static_cast<int>(vertices.size()); ++object)
    for (int i = 0; i < vertices[object]; ++i) {
      surface.mesh.vertices.push_back(static_cast<int>(surface.mesh.vertex_object.size()));
      surface.mesh.vertex_object.push_back(object);
    }
  surface.rod_width.assign(vertices.size(), 0);
  return surface;
}

void set_range(PairTable& pairs, int a, int b, double range) {
  pairs.point(a, b) = pairs.point(b, a) = {0, 1, range};
  pairs.set_edge(a, b, {0, 1, 0.4 * range});
}

}  // namespace

TEST_CASE("pair radii: where all pairs have one range, each radius is half of it", "[contact]") {
  const ContactSurface surface = surface_of({4, 100, 20});
  PairTable pairs(3);
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) set_range(pairs, a, b, 2e-3);
  const InflationRadii radii = pair_radii(surface, pairs);
  CHECK(radii.surface == std::vector(3, 1e-3));
  CHECK(radii.edge == std::vector(3, 4e-4));
}

// 500 grains of one class that only touch, and a ball that they stick to.
TEST_CASE("pair radii: the range of a few objects does not inflate the others", "[contact]") {
  std::vector<int> vertices{1000, 400}, classes{0, 1};
  for (int grain = 0; grain < 500; ++grain) vertices.push_back(110), classes.push_back(2);
  PairTable pairs(ObjectClasses(classes), std::vector<double>(classes.size(), 1.0));
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {2, 3}}) set_range(pairs, a, b, 0.8);
  set_range(pairs, 1, 2, 1.7);
  const InflationRadii radii = pair_radii(surface_of(vertices), pairs);
  CHECK(radii.surface.size() == 502);
  CHECK(radii.surface[0] == 0.4);
  CHECK(radii.surface[1] == Approx(1.3));
  for (int grain = 2; grain < 502; ++grain) CHECK(radii.surface[grain] == 0.4);
}

TEST_CASE("pair radii: whatever the ranges, the radii of a pair sum up to its own", "[contact]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range(0, 1);
  std::uniform_int_distribution<int> size(1, 50);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<int> vertices;
    for (int i = 0; i < 6; ++i) vertices.push_back(size(random));
    PairTable pairs(6);
    double bond = 0;
    for (int a = 0; a < 6; ++a)
      for (int b = a; b < 6; ++b) {
        if (range(random) < 0.2) continue;  // they do not act on each other
        set_range(pairs, a, b, range(random));
        if (range(random) > 0.1) continue;
        pairs.point(a, b).bonds = true;
        pairs.set_bond_range(1.2);
        bond = 1.2;
      }
    PairRole role = pairs.point(1, 4);
    role.range = 0.9;
    for (const auto& [a, b] : {std::pair{1, 4}, {4, 1}}) pairs.add_region_roles(a, b, {1, 1, role, pairs.edge(a, b), pairs.codimensional(a, b)});
    ContactSurface surface = surface_of(vertices);
    surface.rod_width[2] = surface.rod_width[3] = 0.1;
    pairs.set_codimensional(2, 3, {0, 1, 0.7});
    const InflationRadii radii = pair_radii(surface, pairs);
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b) {
        double wanted = std::max(pairs.point(a, b).range, pairs.codimensional(a, b).range);
        if (pairs.point(a, b).bonds) wanted = std::max(wanted, bond);
        if ((a == 1 && b == 4) || (a == 4 && b == 1)) wanted = std::max(wanted, 0.9);
        REQUIRE(radii.surface[a] + radii.surface[b] >= wanted * (1 - 1e-15));
        const double edges = std::max(pairs.edge(a, b).range, (a == 2 && b == 3) || (a == 3 && b == 2) ? 0.7 : 0.0);
        REQUIRE(radii.edge[a] + radii.edge[b] >= edges * (1 - 1e-15));
      }
  }
}
