// Revolved and extruded profiles in scenes.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/shapes/shape_source.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "tests/support/scene.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::unique_ptr<ShapeSource> shape(const std::string& yaml) { return bind_component<ShapeSource>(parse_string(yaml, "test")); }

}  // namespace

TEST_CASE("revolve and extrude: corners with units, formulas, sheets and solids", "[shapes]") {
  const Mesh cone = shape("{type: revolve, profile: [[3 cm, 0], [0, 4 cm]], cells_profile: 5, cells_around: 60}")->make();
  CHECK(cone.tets.empty());
  CHECK(total_area(cone) == Approx(std::numbers::pi * 0.03 * 0.05).epsilon(2e-3));
  const Mesh torus = shape("{type: revolve, profile_x: 0.03 + 0.01 * cos(2 * pi * s), profile_y: 0.01 * sin(2 * pi * s), closed: true, cells_profile: 40, cells_around: 80}")->make();
  CHECK(total_volume(torus) == Approx(2 * std::pow(std::numbers::pi, 2) * 0.03 * 1e-4).epsilon(6e-3));
  // The closing line along the axis is straight, and divided like the profile.
  const std::string half = "profile_x: cos(pi * (s - 0.5)), profile_y: sin(pi * (s - 0.5)), cells_profile: 20";
  const Mesh ball = shape("{type: revolve, closed: true, cells_around: 40, " + half + "}")->make();
  CHECK(total_volume(ball) == Approx(4 * std::numbers::pi / 3).epsilon(2e-2));
  const Mesh quarter = shape("{type: revolve, closed: true, surface: true, angle: 90 deg, cells_around: 10, " + half + "}")->make();
  CHECK(quarter.tets.empty());
  CHECK(total_area(quarter) == Approx(std::numbers::pi + std::numbers::pi).epsilon(1e-2));  // a quarter of the sphere, and two half discs
  const Mesh beam = shape("{type: extrude, profile: [[0, 0], [1, 0], [1, 1], [0, 1]], closed: true, length: 3, cells_profile: 8, cells_along: 4, edge_length: 0.3}")->make();
  CHECK(total_volume(beam) == Approx(3));
  CHECK(shape("{type: revolve, profile: [[1, 0], [2, 0]], angle: 360 deg}")->make().tags.empty());
  CHECK(shape("{type: revolve, profile: [[1, 0], [2, 0]], angle: 359 deg}")->make().tags.size() == 2);
}

TEST_CASE("revolve and extrude: inconsistent parameters are refused with source location", "[shapes]") {
  const auto refused = [](const std::string& yaml) {
    try {
      shape(yaml)->make();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK_THAT(refused("{type: revolve}"), Contains("test:1:") && Contains("give either its corners"));
  CHECK_THAT(refused("{type: revolve, profile: [[0, 0], [1, 1]], profile_x: s, profile_y: s}"), Contains("give either its corners"));
  CHECK_THAT(refused("{type: revolve, profile_x: s}"), Contains("give either its corners"));
  CHECK_THAT(refused("{type: revolve, profile_x: s +, profile_y: s}"), Contains("profile_x"));
  CHECK_THAT(refused("{type: revolve, profile_x: 1 / s, profile_y: s}"), Contains("is no position at s = 0"));
  CHECK_THAT(refused("{type: revolve, profile: [[0, 0], [1, 1]], closed: true}"), Contains("three corners"));
  CHECK_THAT(refused("{type: revolve, profile: [[1, 0], [1, 0], [2, 1]]}"), Contains("corners 0 and 1"));
  CHECK_THAT(refused("{type: revolve, profile: [[1, 0], [2, 1]], angle: 400 deg}"), Contains("more than a whole turn"));
  CHECK_THAT(refused("{type: revolve, profile: [[1, 0], [2, 1]], surface: true}"), Contains("a surface anyway"));
  CHECK_THAT(refused("{type: extrude, profile: [[1, 0], [2, 1]], length: 1, edge_length: 1}"), Contains("closed: true"));
  CHECK_THAT(refused("{type: extrude, profile: [[1, 0], [2, 1]]}"), Contains("length"));
  CHECK_THAT(refused("{type: extrude, profile: [[0, 0], [1, 1], [1, 0], [0, 1]], closed: true, length: 1}"), Contains("shape extrude") && Contains("cross"));
}
