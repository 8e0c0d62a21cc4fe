#include "framework/setup/named_selections.hpp"

#include <catch2/catch.hpp>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/setup/build_world.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;

namespace {

const std::string block = "  - name: block\n";
const std::string top = "    selections: [{name: top, select: {type: face, direction: [0, 1, 0]}}]\n";

std::string scene_text(const std::string& part, const std::string& other) {
  const std::string scene = tiny_scene_with(part, other);
  return scene.substr(scene.find('\n') + 1);
}

std::string error_of(const std::string& yaml) {
  try {
    TestScene scene(yaml);
    return "";
  } catch (const InputError& e) {
    return e.what();
  }
}

}  // namespace

TEST_CASE("a named selection of an object is a group of it", "[scene]") {
  TestScene scene(scene_text(block, block + top));
  const Body& body = scene.world->bodies[1];
  const std::vector<int> group = body.tags.at("top");
  CHECK(group.size() == 4);
  for (const int v : group) CHECK(vertex(scene.world->rest, body.first_vertex + v).y() == Approx(0.2006));
  CHECK(scene.world->bodies[0].tags.count("top") == 0);
}

TEST_CASE("motions, loads and probes refer to a selection by its name", "[scene][app]") {
  const std::string scene = tiny_scene_with(
      block, block + top +
      "    motion: [{type: translate, velocity: [0, 0.1, 0], select: {type: tag, name: top}}]\n"
      "    loads: [{type: body_force, value: [1, 0, 0], select: {type: tag, name: bottom}}]\n");
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene +
             "selections: [{name: bottom, select: {type: plane, point: [0, 0.01, 0], normal: [0, -1, 0]}}]\n");
  const ProgramResult result = run_tack(folder.path(), {"check", "scene.yaml", "--set",
      "probes=[{name: r, type: reaction, object: block, select: {type: tag, name: top}}]", "--set", "expect=[]"});
  INFO(result.err);
  CHECK(result.exit_code == 0);
  CHECK(contains(result.out, "unknowns: 12\n"));
}

TEST_CASE("a selection of the scene is a group of every object that it selects from, unless the object has its own", "[scene]") {
  const std::string of_scene = "selections: [{name: top, select: {type: plane, normal: [0, 1, 0], point: [0, -0.05, 0]}}]\n";
  TestScene all(scene_text(block, block) + of_scene);
  CHECK(all.world->bodies[0].tags.at("top").size() == 4);
  CHECK(all.world->bodies[1].tags.at("top").size() == 8);
  TestScene own(scene_text(block, block + top) + of_scene);
  CHECK(own.world->bodies[1].tags.at("top").size() == 4);
}

TEST_CASE("invalid named selections are refused with their source location", "[scene]") {
  const std::string plain = scene_text(block, block);
  CHECK_THAT(error_of(plain + "selections: [{name: far, select: {type: sphere, centre: [9, 9, 9], radius: 1}}]\n"),
             Catch::Contains("test.yaml:") && Catch::Contains(":14: selection 'far' chooses no vertex of any object"));
  CHECK_THAT(error_of(plain + "selections: [{name: far, select: {type: tag, name: nowhere}}]\n"),
             Catch::Contains("has no group 'nowhere'"));
  CHECK_THAT(error_of(scene_text(block, block + "    selections:\n      - {name: a, select: all}\n      - {name: a, select: all}\n")),
             Catch::Contains("test.yaml:12:9: object 'block' has a group 'a' already; names must differ"));
  CHECK_THAT(error_of(scene_text(block, block + "    selections: [{name: a, select: {type: sphere, radius: 1e-6}}]\n")),
             Catch::Contains("test.yaml:10:18: selection sphere chooses no vertex of object 'block'"));
}
