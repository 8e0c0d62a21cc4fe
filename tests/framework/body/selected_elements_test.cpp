// Energies of selected elements of an object, and sheets beside tets.
#include <catch2/catch.hpp>
#include <set>

#include "geometry/io/write_mesh.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

// A bar of two cubes of six tets.
std::string bar(const std::string& energies) {
  return "objects:\n  - name: bar\n    shape: {type: box, size: [2, 1, 1], cells: [2, 1, 1]}\n"
         "    selections: [{name: left, select: {type: box, min: [-2, -2, -2], max: [0.1, 2, 2]}},\n"
         "                 {name: right, select: {type: box, min: [-0.1, -2, -2], max: [2, 2, 2]}}]\n    energies: " + energies + "\n";
}

}  // namespace

TEST_CASE("an energy acts on, and gives mass to, the elements all of whose vertices are selected") {
  TestScene s(bar("[{type: neo_hookean, young: 1e5, density: 1000, select: {type: tag, name: left}},\n"
                  "               {type: stvk_hencky, young: 3e5, density: 500, select: {type: tag, name: right}}]"));
  REQUIRE(s.world->elastic_terms.size() == 2);
  for (const auto& term : s.world->elastic_terms) CHECK(term->batches()[0].count == 6);
  CHECK(s.world->mass.sum() == Approx(1500));
  double left = 0;
  for (int v = 0; v < s.world->mass.size(); ++v)
    if (vertex(s.world->rest, v).x() < -0.5) left += s.world->mass(v);
  CHECK(left > 400);
  CHECK(left < 600);
  const StencilBatch batch = s.world->elastic_terms[0]->batches()[0];
  for (int i = 0; i < 4 * batch.count; ++i) CHECK(vertex(s.world->rest, batch.vertices[i]).x() < 0.1);
  CHECK(s.world->tets.size() == 12);  // all tets must not invert
}

TEST_CASE("without a selection an energy acts on all elements") {
  TestScene all(bar("[{type: neo_hookean, young: 1e5}]"));
  TestScene chosen(bar("[{type: neo_hookean, young: 1e5, select: {type: all}}]"));
  CHECK(all.world->elastic_terms[0]->batches()[0].count == 12);
  CHECK(chosen.world->elastic_terms[0]->batches()[0].count == 12);
  CHECK(all.world->mass == chosen.world->mass);
}

TEST_CASE("selections without an element, and vertices that they leave without mass, are refused by name") {
  CHECK_THROWS_WITH(TestScene(bar("[{type: neo_hookean, young: 1e5, select: {type: face, direction: [1, 0, 0]}}]")),
                    Catch::Contains("'bar'") && Catch::Contains("no complete element"));
  CHECK_THROWS_WITH(TestScene(bar("[{type: neo_hookean, young: 1e5, select: {type: indices, vertices: [0]}}]")),
                    Catch::Contains("test.yaml:") && Catch::Contains("'bar'") && Catch::Contains("no complete element"));
  CHECK_THROWS_WITH(TestScene(bar("[{type: neo_hookean, young: 1e5, select: {type: tag, name: left}}]")), Catch::Contains("has no mass"));
}

TEST_CASE("a thickness is for objects with explicit triangles, and energies of triangles need one") {
  CHECK_THROWS_WITH(TestScene("objects: [{name: cube, shape: {type: box, size: [1, 1, 1]}, shell: {thickness: 1 mm},\n"
                              "  energies: [{type: neo_hookean, young: 1e5}]}]\n"),
                    Catch::Contains("test.yaml:") && Catch::Contains("'cube'") && Catch::Contains("no triangles"));
  CHECK_THROWS_WITH(TestScene("objects: [{name: cloth, shape: {type: grid, size: [1, 1]}, energies: [{type: stvk_membrane, young: 1e5}]}]\n"),
                    Catch::Contains("test.yaml:") && Catch::Contains("'cloth'") && Catch::Contains("shell: {thickness"));
}

TEST_CASE("a mesh of tets and triangles has both: a solid with a sheet on it and beside it") {
  // A tet, a triangle on its face, and one that only shares an edge with it.
  const TemporaryFolder folder;
  const auto path = folder.path() / "mixed.msh";
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 0)};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.triangles = {{0, 1, 2}, {1, 4, 2}};
  write_mesh(path, mesh);
  TestScene s("objects: [{name: mixed, shape: {type: file, path: '" + path.string() + "'}, shell: {thickness: 1 mm},\n"
              "  energies: [{type: neo_hookean, young: 1e5, density: 1000}, {type: stvk_membrane, young: 1e5, density: 1000}]}]\n");
  const Body& body = s.world->bodies[0];
  REQUIRE(body.sheet.size() == 1);
  CHECK(std::set<int>(body.sheet[0].begin(), body.sheet[0].end()) == std::set<int>{1, 2, 4});
  CHECK(body.thickness == 1e-3);
  CHECK(body.triangles.size() == 5);
  CHECK(s.world->mass.sum() == Approx(1000 / 6.0 + 1000 * 1e-3 / 2));
}
