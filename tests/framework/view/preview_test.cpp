#include "framework/view/preview.hpp"

#include <catch2/catch.hpp>
#include <map>

#include "framework/run/scene_warnings.hpp"
#include "framework/view/preview_selections.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;

namespace {

nlohmann::ordered_json preview_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", text);
  return preview_data({(folder.path() / "scene.yaml").string(), overrides, "1", "abc"}).document;
}

}  // namespace

TEST_CASE("every `select` of a scene is found, with its location in the scene and its vertices") {
  const TestScene scene(R"(time: {step: 0.01 s, duration: 1 s}
parameters: {above: 0.4 m}
objects:
  - name: box
    shape: {type: box, size: [1, 1, 1]}
    selections: [{name: top, select: {type: face, direction: [0, 1, 0]}}]
    motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]
    loads: [{type: force, value: [0, -1, 0], select: {type: tag, name: top}}, {type: body_force, value: [0, 1, 0]}]
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]
  - {name: other, shape: {type: box, size: [1, 1, 1]}, place: {translate: [3, 0, 0]}, energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]}
probes:
  - {name: lift, type: separation, from: {object: box}, to: {object: other, select: {type: box, min: [2, above, -1], max: [4, 1, 1]}}, direction: [0, 1, 0]}
)");
  std::map<std::string, std::vector<int>> found;
  for (const ShownSelection& one : shown_selections(scene.built.root(), scene.built.world())) found[one.name] = one.vertices;
  REQUIRE(found.size() == 4);
  const VecX& x = scene.built.world().start.x;
  const auto all_at = [&](const std::vector<int>& vertices, double y) {
    for (const int v : vertices)
      if (std::abs(x(3 * v + 1) - y) > 1e-12) return false;
    return vertices.size() == 4;
  };
  CHECK(all_at(found["box: group top"], 0.5));
  CHECK(all_at(found["box: motion 0 (fixed)"], -0.5));
  CHECK(found["box: loads 0 (force)"] == found["box: group top"]);
  CHECK(all_at(found["probes lift to"], 0.5));
  CHECK(found["probes lift to"].front() >= 8);
}

TEST_CASE("a preview has the warnings of a run, bodies, and ranges of contact and adhesion") {
  const auto document = preview_of(tiny_scene);
  CHECK(document["kind"] == "preview");
  const auto& preview = document["preview"];
  CHECK(preview["error"].is_null());
  CHECK(preview["duration"] == 0.05);
  const TestScene scene(tiny_scene.substr(tiny_scene.find('\n') + 1));
  const std::vector<std::string> warnings = preview["warnings"];
  const std::vector<Warning> expected = scene_warnings(scene.config, *scene.world);
  CHECK(warnings == std::vector<std::string>(expected.begin(), expected.end()));
  REQUIRE(preview["bodies"].size() == 2);
  CHECK(preview["bodies"][0]["held"] == "all");
  CHECK(preview["bodies"][1]["vertices"] == 8);
  CHECK(preview["bodies"][1]["contact"] == 0.001);
  CHECK(preview["bodies"][1]["adhesion"] == Approx(0.002));
  const auto& run = document["runs"][0];
  CHECK(run["scene"]["objects"][1]["reach"] == Approx(0.0005));
  CHECK(run["frames"]["times"].size() == 1);
  CHECK(run["frames"]["vertices"] == 16);
}

TEST_CASE("a scene that intersects is previewed without contact, with the reason; an invalid scene is refused") {
  const auto document = preview_of(tiny_scene, {"objects.block.place.translate=[0, 0, 0]"});
  CHECK_THAT(document["preview"]["error"].get<std::string>(), Catch::Contains("the start intersects"));
  CHECK(document["preview"]["bodies"][1]["contact"].is_null());
  CHECK(document["runs"][0]["frames"]["vertices"] == 16);
  CHECK_THROWS_WITH(preview_of(tiny_scene, {"objects.block.shape.type=bx"}), Catch::Contains("'bx'"));
  const auto lost = preview_of(tiny_scene_with("probe: height, statistic", "probe: hight, statistic"));
  CHECK_THAT(lost["preview"]["error"].get<std::string>(), Catch::Contains("hight"));
  CHECK(lost["runs"][0]["scene"]["expect"].empty());
}
