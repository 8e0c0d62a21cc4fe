// Objects inside a solid at the start.
#include "framework/world/containment.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "geometry/errors.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

// A small ball inside or beside a large box.
std::string scene(const std::string& box, const std::string& placement, const std::string& contact = "distance: 1 mm") {
  return fmt::format("objects:\n"
                     "  - {{name: ball, shape: {{type: sphere, radius: 0.05, cells: 2}}, place: {{translate: {}}},\n"
                     "     energies: [{{type: neo_hookean, young: 1e5}}]}}\n"
                     "  - {{name: box, shape: {{{}}}, motion: [fixed]}}\n"
                     "contact: {{{}}}\n", placement, box, contact);
}

const std::string solid = "type: box, size: [1, 1, 1], cells: [3, 3, 3]";

}  // namespace

TEST_CASE("a body completely inside a solid is refused with its location") {
  for (const char* placement : {"[0, 0, 0]", "[0.1, 0.2, -0.3]", "[0.4, 0.4, 0.4]"})
    CHECK_THROWS_WITH(TestScene(scene(solid, placement)),
                      Catch::Contains("object 'ball' is inside of 'box' at the start (its vertex ") && Catch::Contains("lies in tet "));
}

TEST_CASE("bodies beside a solid, in a shell, in a hollow, or that may pass through are not inside") {
  CHECK_NOTHROW(TestScene(scene(solid, "[0, 0.56, 0]")));
  CHECK_NOTHROW(TestScene(scene(solid, "[0.56, 0.56, 0.56]")));
  CHECK_NOTHROW(TestScene(scene(solid + ", surface: true", "[0, 0, 0]")));
  CHECK_NOTHROW(TestScene(scene(solid, "[0, 0, 0]", "pairs: [{between: [ball, box], contact: false}]")));
  CHECK_NOTHROW(TestScene(scene("type: sphere, radius: 0.5, cells: 4", "[0.4, 0.4, 0.4]")));  // in the box around it
}
