// Shapes whose vertices are moved by formulas, and selections of vertices by a formula.
#include <catch2/catch.hpp>

#include "framework/body/selection.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/shapes/shape_source.hpp"
#include "tests/support/scene.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::unique_ptr<ShapeSource> shape(const std::string& yaml) { return bind_component<ShapeSource>(parse_string(yaml, "test")); }

std::string with(const std::string& shape, const std::string& more = "") {
  return "time: {step: 1 ms, duration: 1}\nobjects:\n  - {name: it, shape: " + shape + ", body: affine" + more + "}\n";
}

}  // namespace

TEST_CASE("warped: each vertex moves by the formulas of its position, and nothing else changes", "[shapes]") {
  for (const double unit : {1e-3, 1.0, 1e3}) {
    const std::string grid = fmt::format("{{type: grid, size: [{0}, {0}], cells: [6, 4]}}", 2 * unit);
    const Mesh flat = shape(grid)->make();
    const Mesh saddle = shape(fmt::format("{{type: warped, of: {}, x: x + {}, y: x * z / {}, z: 2 * z}}", grid, unit, unit))->make();
    REQUIRE(saddle.vertices.size() == 35);
    CHECK(saddle.triangles == flat.triangles);
    for (size_t v = 0; v < flat.vertices.size(); ++v) {
      const Vec3& x = flat.vertices[v];
      CHECK((saddle.vertices[v] - Vec3(x.x() + unit, x.x() * x.z() / unit, 2 * x.z())).norm() < 1e-12 * unit);
    }
  }
  // Coordinates without a formula stay, and a warped shape may be warped again.
  const Mesh once = shape("{type: warped, of: {type: box, size: [1, 1, 1]}, y: y + x^2}")->make();
  const Mesh twice = shape("{type: warped, of: {type: warped, of: {type: box, size: [1, 1, 1]}, y: y + x^2}, y: y - x^2}")->make();
  const Mesh box = shape("{type: box, size: [1, 1, 1]}")->make();
  CHECK(once.tets == box.tets);
  for (size_t v = 0; v < box.vertices.size(); ++v) {
    CHECK(once.vertices[v].x() == box.vertices[v].x());
    CHECK((twice.vertices[v] - box.vertices[v]).norm() < 1e-15);
  }
}

TEST_CASE("warped: invalid formulas, positions that are not finite and inverted tets are refused with their location", "[shapes]") {
  CHECK_THROWS_WITH(TestScene(with("{type: warped, of: {type: box, size: [1, 1, 1]}, y: y + }")), Contains("test.yaml:4:") && Contains("y: "));
  CHECK_THROWS_WITH(TestScene(with("{type: warped, of: {type: box, size: [1, 1, 1]}, z: z + q}")), Contains("test.yaml:4:") && Contains("z: ") && Contains("q"));
  CHECK_THROWS_WITH(TestScene(with("{type: warped, y: y}")), Contains("missing key 'of'"));
  CHECK_THROWS_WITH(shape("{type: warped, of: {type: box, size: [1, 1, 1]}, y: 1 / (x - 0.5)}")->make(), Contains("gives no finite position for the vertex at (0.5, "));
  CHECK_THROWS_WITH(shape("{type: warped, of: {type: box, size: [1, 1, 1]}, x: sqrt(x)}")->make(), Contains("gives no finite position for the vertex at (-0.5, "));
  CHECK_THROWS_WITH(shape("{type: warped, of: {type: box, size: [1, 1, 1]}, x: -x}")->make(), Contains("turns 6 of 6 tets inside out"));
}

TEST_CASE("a selection by a formula has the vertices that fulfil it, and an invalid one is refused with its location", "[shapes]") {
  TestScene s(with("{type: box, size: [2, 2, 2], cells: [4, 4, 4]}"));
  const auto choose = [&](const std::string& where) {
    const auto selection = bind_component<Selection>(parse_string("{type: formula, where: \"" + where + "\"}", "test"));
    return select(*selection, s.world->selection_context(0));
  };
  const std::vector<int> boundary = choose("abs(x) > 0.75 || y < -0.75");
  int expected = 0;
  for (int v = 0; v < s.world->bodies[0].vertex_count; ++v) {
    const Vec3 x = vertex(s.world->rest, v);
    if (!(std::abs(x.x()) > 0.75 || x.y() < -0.75)) continue;
    REQUIRE(expected < static_cast<int>(boundary.size()));
    CHECK(boundary[expected++] == v);
  }
  CHECK(expected == static_cast<int>(boundary.size()));
  CHECK_THROWS_WITH(choose("x > 5"), Contains("chooses no vertex"));
  CHECK_THROWS_WITH(choose("x > "), Contains("where: "));
}
