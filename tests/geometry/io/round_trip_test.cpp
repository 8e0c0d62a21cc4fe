#include <catch2/catch.hpp>
#include <filesystem>

#include "geometry/errors.hpp"
#include "geometry/io/mesh_io.hpp"
#include "geometry/shapes/lines.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/shapes/surfaces.hpp"
#include "tests/support/silence.hpp"
#include "geometry/io/write_mesh.hpp"

using namespace tack;

namespace {

void check_round_trip(const std::string& name, const Mesh& mesh) {
  const TemporaryFolder folder;
  const auto path = folder.path() / name;
  Mesh back;
  const std::string printed = printed_by([&] {
    write_mesh(path, mesh);
    back = read_mesh(path);
  });
  INFO(name);
  CHECK(back.vertices == mesh.vertices);  // every bit
  CHECK(back.tets == mesh.tets);
  CHECK(back.triangles == mesh.triangles);
  CHECK(back.edges == mesh.edges);
  CHECK(back.points == mesh.points);
  CHECK(printed == "");
}

Mesh mixture() {
  Mesh mesh = sphere_surface(1.0 / 3, 3);
  append(mesh, segment(0.1, 4));
  append(mesh, point_grid(Vec3(1, 1, 1) / 7, {2, 3, 2}));
  return mesh;
}

}  // namespace

TEST_CASE("meshes survive a round trip through the formats that others write", "[io]") {
  Mesh solid = sphere(1.0 / 3, 4);
  append(solid, mixture());
  check_round_trip("a.vtu", solid);
  check_round_trip("a.msh", solid);
  check_round_trip("a.msh", mixture());
  check_round_trip("a.vtu", mixture());
  check_round_trip("a.obj", mixture());
  check_round_trip("a.msh", point_grid(Vec3(1, 1, 1), {2, 2, 2}));
}

TEST_CASE("glTF files hold all but tets, in single precision", "[io]") {
  const TemporaryFolder folder;
  const Mesh mesh = mixture();
  for (const char* name : {"a.glb", "a.gltf"}) {
    INFO(name);
    Mesh back;
    const std::string printed = printed_by([&] {
      write_mesh(folder.path() / name, mesh);
      back = read_mesh(folder.path() / name);
    });
    CHECK(printed == "");
    REQUIRE(back.vertices.size() == mesh.vertices.size());
    CHECK(back.triangles == mesh.triangles);
    CHECK(back.edges.size() == mesh.edges.size());
    CHECK(back.points.size() == mesh.points.size());
    for (size_t v = 0; v < mesh.vertices.size(); ++v) CHECK((back.vertices[v] - mesh.vertices[v]).norm() < 1e-7);
  }
  CHECK_THROWS_WITH(write_mesh(folder.path() / "b.glb", sphere(1, 4)), Catch::Contains("cannot hold tets"));
  Mesh far = sphere_surface(1e-3, 4);
  translate(far, Vec3(1e6, 0, 0));
  CHECK_THROWS_WITH(write_mesh(folder.path() / "b.glb", far), Catch::Contains("single precision") && Catch::Contains("tack mesh transform"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "b.glb"));
}
