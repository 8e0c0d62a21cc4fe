#include "geometry/io/mesh_io.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/mesh/validate.hpp"
#include "tests/support/closed_surface.hpp"
#include "tests/support/silence.hpp"

using namespace tack;

namespace {

std::filesystem::path data(const std::string& name) {
  return std::filesystem::path(TACK_TEST_DATA) / "meshes" / name;
}

Mesh read(const std::string& name) { return read_mesh(data(name)); }

}  // namespace

TEST_CASE("obj keeps order and precision; polygons, rods, particles, groups", "[io]") {
  const Mesh mesh = read("mixed.obj");
  CHECK_NOTHROW(validate_mesh(mesh, "mixed.obj"));
  REQUIRE(mesh.vertices.size() == 6);
  CHECK(mesh.vertices[0] == Vec3(0.1, 0, 0));
  CHECK(mesh.vertices[1] == Vec3(1, 0.12345678901234567, 0));
  CHECK(mesh.vertices[5] == Vec3(6, 5, 5));
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(mesh.edges == std::vector<Edge>{{2, 4}, {4, 5}});
  CHECK(mesh.points == std::vector<int>{5});
  CHECK(mesh.tags.at("plate") == std::vector<int>{0, 1, 2, 3});
  CHECK(mesh.tags.at("top") == mesh.tags.at("plate"));
  CHECK(mesh.tags.at("rod") == std::vector<int>{2, 4, 5});
  CHECK(mesh.tags.size() == 3);
}

TEST_CASE("ply, off: same polygons, full precision, in order", "[io]") {
  for (const char* name : {"triangle_ascii.ply", "triangle_binary.ply", "quad.off"}) {
    INFO(name);
    const Mesh mesh = read(name);
    CHECK_NOTHROW(validate_mesh(mesh, name));
    REQUIRE(mesh.vertices.size() == 5);
    CHECK(mesh.vertices[0] == Vec3(0.1, 0, 0));
    CHECK(mesh.vertices[2] == Vec3(1, 1, 0.25));
    CHECK(mesh.vertices[4] == Vec3(2, 0.5, 0));
    std::vector<Triangle> triangles = mesh.triangles;
    std::sort(triangles.begin(), triangles.end());
    CHECK(triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {1, 4, 2}});
  }
}

TEST_CASE("glTF: all objects of the scene have their positions, without duplicates per normal", "[io]") {
  const Mesh mesh = read("nodes.gltf");
  const std::vector<Vec3> places = {{2, 0, 0}, {2, 2, 0}, {0, 0, 0}, {0, 2, 0}};
  REQUIRE(mesh.vertices.size() == places.size());
  for (size_t v = 0; v < places.size(); ++v) CHECK((mesh.vertices[v] - places[v]).norm() < 1e-6);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
}

TEST_CASE("stl corners are merged into a closed surface", "[io]") {
  for (const char* name : {"tet_ascii.stl", "tet_binary.stl"}) {
    INFO(name);
    const Mesh mesh = read(name);
    CHECK_NOTHROW(validate_mesh(mesh, name));
    CHECK(mesh.vertices == std::vector<Vec3>{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0),
                                             Vec3(0, 0, 1)});
    CHECK(mesh.triangles.size() == 4);
    CHECK(is_closed_manifold(mesh.triangles));
    CHECK(enclosed_volume(mesh, mesh.triangles) == Approx(1.0 / 6));
  }
}

TEST_CASE("vtk and vtu: all kinds of cells", "[io]") {
  const Mesh vtk = read("mixed.vtk");
  CHECK_NOTHROW(validate_mesh(vtk, "mixed.vtk"));
  CHECK(vtk.vertices[4] == Vec3(1, 1, 1.1));
  CHECK(vtk.tets == std::vector<Tet>{{0, 1, 2, 3}});
  CHECK(vtk.triangles == std::vector<Triangle>{{1, 4, 2}});
  CHECK(vtk.edges == std::vector<Edge>{{4, 5}, {5, 6}});
  CHECK(vtk.points == std::vector<int>{7, 8});
  CHECK(read("surface.vtk").triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});

  const Mesh vtu = read("mixed.vtu");
  CHECK_NOTHROW(validate_mesh(vtu, "mixed.vtu"));
  CHECK(vtu.vertices[3] == Vec3(0, 0, 1.1));
  CHECK(vtu.tets == std::vector<Tet>{{0, 1, 2, 3}});
  CHECK(vtu.triangles == std::vector<Triangle>{{1, 4, 2}});
  CHECK(vtu.edges == std::vector<Edge>{{5, 6}});
  CHECK(vtu.points == std::vector<int>{7});
}

TEST_CASE("msh 2.2 and 4.1, ascii and binary: elements and physical groups", "[io]") {
  for (const char* name : {"two_tets_22_ascii.msh", "two_tets_22_binary.msh",
                           "two_tets_41_ascii.msh", "two_tets_41_binary.msh"}) {
    INFO(name);
    const Mesh mesh = read(name);
    CHECK_NOTHROW(validate_mesh(mesh, name));
    REQUIRE(mesh.vertices.size() == 7);
    // The writer of 2.2 numbered the nodes by dimension, the one of 4.1 kept 10, 20, ...
    const bool by_dimension = std::string(name).find("22") != std::string::npos;
    const int s = by_dimension ? 2 : 0, rod = by_dimension ? 1 : 5, point = by_dimension ? 0 : 6;
    CHECK(mesh.vertices[s + 1] == Vec3(1, 0, 0));
    CHECK(mesh.vertices[rod] == Vec3(2, 1, 1.1));
    CHECK(mesh.vertices[point] == Vec3(3, 3, 0.1));
    CHECK(mesh.tets == std::vector<Tet>{{s, s + 1, s + 2, s + 3}, {s + 1, s + 2, s + 3, s + 4}});
    CHECK(total_volume(mesh) == Approx(0.5));
    CHECK(mesh.triangles.empty());  // the triangle in the file is a face of a tet and only names the group "base"
    CHECK(mesh.edges == std::vector<Edge>{{s + 4, rod}});
    CHECK(mesh.points == std::vector<int>{point});
    CHECK(mesh.tags.at("body") == std::vector<int>{s, s + 1, s + 2, s + 3, s + 4});
    CHECK(mesh.tags.at("base") == std::vector<int>{s, s + 1, s + 2});
    CHECK(mesh.tags.at("rod").size() == 2);
    CHECK(mesh.tags.at("7") == std::vector<int>{point});
  }
}

TEST_CASE("extensions may be written in capitals", "[io]") {
  const TemporaryFolder folder;
  for (const char* name : {"mixed.obj", "triangle_binary.ply", "quad.off", "tet_binary.stl",
                           "mixed.vtk", "mixed.vtu", "two_tets_41_binary.msh"}) {
    INFO(name);
    std::string capitals = name;
    for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    std::filesystem::copy_file(data(name), folder.path() / capitals);
    CHECK(read_mesh(folder.path() / capitals).vertices == read(name).vertices);
  }
}

TEST_CASE("vertices without elements are a cloud of points", "[io]") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "cloud.obj") << "v 0 0 0\nv 1 0 0\n";
  CHECK(read_mesh(folder.path() / "cloud.obj").points == std::vector<int>{0, 1});
}

TEST_CASE("reading and writing leave signal handlers alone", "[io]") {
  const auto handler = [](int signal) {
    struct sigaction action;
    sigaction(signal, nullptr, &action);
    return action.sa_handler;
  };
  const auto interrupt = handler(SIGINT), floating = handler(SIGFPE), fault = handler(SIGSEGV);
  read("two_tets_41_binary.msh");
  CHECK(handler(SIGINT) == interrupt);
  CHECK(handler(SIGFPE) == floating);
  CHECK(handler(SIGSEGV) == fault);
}
