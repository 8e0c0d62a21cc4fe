// Scenes that contact does not support are refused when they are loaded.
#include "framework/setup/contact_support.hpp"

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;

namespace {

// A tet with its vertex 4 loose, for explicit elements at it.
Mesh tet_and_vertices() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0}, {2, 1, 0}};
  mesh.tets = {{0, 1, 2, 3}};
  return mesh;
}

// tack check of the tiny scene with a floor from an .obj file.
ProgramResult check_floor(const std::string& obj, const std::string& scene = tiny_scene) {
  const TemporaryFolder folder;
  write_file(folder.path() / "floor.obj", obj);
  std::string text = scene;
  const std::string box = "shape: {type: box, size: [1, 0.2, 1]}";
  text.replace(text.find(box), box.size(), "shape: {type: file, path: floor.obj}");
  write_file(folder.path() / "scene.yaml", text);
  return run_tack(folder.path(), {"check", "scene.yaml"});
}

}  // namespace

TEST_CASE("faces of tets, their edges and vertices may be listed beside them", "[scene]") {
  Mesh mesh = tet_and_vertices();
  mesh.triangles = {{2, 1, 0}, {1, 2, 3}};
  mesh.edges = {{3, 1}};
  mesh.points = {2};
  CHECK_NOTHROW(refuse_unmeasured_contact(mesh, "body", false, false));
}

TEST_CASE("rods without a width and particles without a size are refused in contact, with their indices", "[scene]") {
  Mesh rods = tet_and_vertices();
  rods.edges = {{0, 1}, {5, 4}};
  CHECK_THROWS_WITH(refuse_unmeasured_contact(rods, "wire", false, true), Catch::Contains("object 'wire': edge 1 (counted"));
  Mesh particles = tet_and_vertices();
  particles.points = {0, 4, 5};
  CHECK_THROWS_WITH(refuse_unmeasured_contact(particles, "dust", true, false),
                    Catch::Contains("object 'dust': points 1, 2 (counted"));
  CHECK_NOTHROW(refuse_unmeasured_contact(particles, "dust", false, true));
  CHECK_NOTHROW(refuse_unmeasured_contact(rods, "wire", true, false));
  for (int i = 0; i < 10; ++i) particles.points.push_back(5);
  CHECK_THROWS_WITH(refuse_unmeasured_contact(particles, "dust", true, false),
                    Catch::Contains("1, 2, 3, 4, 5 and 7 more"));
}

TEST_CASE("tack check refuses rods and particles in contact at their object, and not without contact", "[scene][app]") {
  for (const char* elements : {"l 1 2\nl 2 3\n", "p 1 2 3\n"}) {
    const std::string obj = std::string("v -1 0 0\nv 0 0 0.1\nv 1 0 0\n") + elements;
    const ProgramResult refused = check_floor(obj);
    CHECK(refused.exit_code == 2);
    CHECK(contains(refused.err, "scene.yaml:5:5: object 'floor': "));
    CHECK(contains(refused.err, "give the object a "));
    std::string without = tiny_scene.substr(0, tiny_scene.find("contact:\n"));
    const ProgramResult taken = check_floor(obj, without);
    INFO(taken.err);
    CHECK(taken.exit_code == 0);
  }
}
