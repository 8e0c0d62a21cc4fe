#include "framework/output/element_fields.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "framework/world/world.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

// A fixed plate of 6 tets between two blocks of 6 and 12, the last one of two energies.
std::string scene_of(const std::string& elements) {
  return "objects:\n"
    "  - {name: soft, shape: {type: box, size: [1, 1, 1]}, elements: " + elements + ", energies: [{type: stvk_hencky, young: 1e5, poisson: 0.25}]}\n"
    "  - {name: plate, shape: {type: box, size: [1, 1, 1]}, place: {translate: [2, 0, 0]}, motion: [fixed]}\n"
    "  - {name: plastic, shape: {type: box, size: [1, 1, 1], cells: [2, 1, 1]}, place: {translate: [4, 0, 0]}, elements: " + elements + ",\n"
    "     energies: [{type: von_mises, young: 1e5, poisson: 0.25, yield_stress: 1e3}, {type: neo_hookean, young: 2e5}]}\n";
}

}  // namespace

TEST_CASE("von Mises stress and plastic strain of every element that has them") {
  const std::string elements = GENERATE("linear", "composite", "patches");
  INFO(elements);
  TestScene s(scene_of(elements));
  FrameGeometry geometry;
  for (const Body& body : s.world->bodies) geometry.tets.insert(geometry.tets.end(), body.tets.begin(), body.tets.end());
  const int parts = elements == "composite" ? 8 : 1, plate = 6 * parts, plastic = plate + 6, all = plastic + 12 * parts;
  REQUIRE(geometry.cells() == all);
  // Pure shear in logarithmic strains of +-0.1, about an axis askew.
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Mat3 f = turn * Vec3(std::exp(0.1), std::exp(-0.1), 1).asDiagonal() * turn.transpose();
  VecX x(s.world->rest.size());
  for (int v = 0; v < x.size() / 3; ++v) vertex(x, v) = f * vertex(s.world->rest, v);

  const auto fields = element_fields({"velocity", "von_mises_stress", "plastic_strain"}, *s.world, x, geometry);
  REQUIRE(fields.size() == 2);
  CHECK(fields[0].unit == "Pa");
  const VecX &stress = fields[0].values, &strain = fields[1].values;
  const double sheared = std::sqrt(3) * 1e5 / 2.5 * 2 * 0.1;  // sqrt(3) times the shear stress 2 mu 0.1
  for (int c = 0; c < plate; ++c) CHECK(stress(c) == Approx(sheared).epsilon(1e-9));
  for (int c = plate; c < plastic; ++c) CHECK(std::isnan(stress(c)));
  // Both energies pull the same way: what the plastic one yields at, and neo-Hookean mu (s^2 - 1) / J, which has
  // a component along the axis of no strain.
  const double mu = 2e5 / 2.6, a = mu * (std::exp(0.2) - 1), b = mu * (std::exp(-0.2) - 1), y = 1e3 / std::sqrt(3);
  const Vec3 principal(a + y, b - y, 0);
  const Vec3 deviator = principal.array() - principal.mean();
  for (int c = plastic; c < all; ++c) CHECK(stress(c) == Approx(std::sqrt(1.5) * deviator.norm()).epsilon(1e-9));
  for (int c = 0; c < plastic; ++c) CHECK(std::isnan(strain(c)));
  for (int c = plastic; c < all; ++c) CHECK(strain(c) == 0);

  History history;
  for (const auto& term : s.world->elastic_terms) {
    term->commit(x, history);
    term->load_history(history);
  }
  const VecX after = element_fields({"plastic_strain"}, *s.world, x, geometry)[0].values;
  for (int c = plastic; c < all; ++c) CHECK(after(c) == Approx(0.2 / std::sqrt(3) - 1e3 / (3 * 1e5 / 2.5)).epsilon(1e-9));
  CHECK(element_fields({"velocity"}, *s.world, x, geometry).empty());
}

TEST_CASE("stress and plastic strain of sheets, and of the selected elements of a solid") {
  TestScene s(
      "objects:\n"
      "  - {name: solid, shape: {type: box, size: [2, 1, 1], cells: [2, 1, 1]}, energies: [\n"
      "      {type: stvk_hencky, young: 1e5, poisson: 0.25, select: {type: box, min: [-2, -2, -2], max: [0.1, 2, 2]}},\n"
      "      {type: neo_hookean, young: 1e5, poisson: 0.25, select: {type: box, min: [-0.1, -2, -2], max: [2, 2, 2]}}]}\n"
      "  - {name: sheet, shape: {type: grid, size: [1, 1]}, shell: {thickness: 1 cm},\n"
      "     energies: [{type: von_mises_membrane, young: 1e5, poisson: 0, yield_stress: 1e3}, {type: hinge_bending, young: 1e5}]}\n");
  FrameGeometry geometry;
  for (const Body& body : s.world->bodies) {
    geometry.tets.insert(geometry.tets.end(), body.tets.begin(), body.tets.end());
    geometry.triangles.insert(geometry.triangles.end(), body.sheet.begin(), body.sheet.end());
  }
  REQUIRE(geometry.cells() == 14);
  VecX x = s.world->rest;
  for (int v = 0; v < x.size() / 3; ++v) x(3 * v) *= std::exp(0.1);
  History history;
  for (const auto& term : s.world->elastic_terms) {
    term->commit(x, history);
    term->load_history(history);
  }
  const auto fields = element_fields({"von_mises_stress", "plastic_strain"}, *s.world, x, geometry);
  const VecX &stress = fields[0].values, &strain = fields[1].values;
  std::map<bool, std::set<double>> seen;
  for (int c = 0; c < 12; ++c) {
    double side = 0;
    for (const int v : geometry.tets[c]) side += s.world->rest(3 * v);
    seen[side > 0].insert(std::round(stress(c)));
    CHECK(std::isnan(strain(c)));
  }
  const double mu = 1e5 / 2.5;
  REQUIRE(seen[false].size() == 1);
  REQUIRE(seen[true].size() == 1);
  CHECK(*seen[false].begin() == Approx(2 * mu * 0.1 / std::exp(0.1)).epsilon(1e-3));
  CHECK(*seen[true].begin() == Approx(mu * (std::exp(0.2) - 1) / std::exp(0.1)).epsilon(1e-3));
  for (int c = 12; c < 14; ++c) {
    CHECK(stress(c) == Approx(1e3).epsilon(0.02));  // Kirchhoff's, over the elastic change of the area
    CHECK(strain(c) > 0.05);
  }
}
