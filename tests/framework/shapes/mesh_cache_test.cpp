// Expensive meshes are made once for a recipe, and cached in a folder for the next process.
#include "framework/shapes/mesh_cache.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

std::unique_ptr<ShapeSource> shape(const std::string& yaml) { return bind_component<ShapeSource>(parse_string(yaml, "test")); }

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> all;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
  return all;
}

std::string scene(double radius) {
  return fmt::format("name: kept\ntime: {{step: 0.01, duration: 1}}\nobjects:\n  - {{name: a, shape: {{type: level_set, voxel: 0.1, of: {{type: "
                     "sphere, radius: {}}}}}, body: affine}}\n", radius);
}

}  // namespace

TEST_CASE("the mesh of a recipe is made once", "[shapes]") {
  const std::string ball = "{type: level_set, voxel: 0.1, of: {type: sphere, radius: 0.987}}";
  const auto first = mesh_of_shape(*shape(ball)), second = mesh_of_shape(*shape(ball));
  CHECK(first == second);
  CHECK(mesh_of_shape(*shape("{type: level_set, voxel: 0.11, of: {type: sphere, radius: 0.987}}")) != first);
  // Cheap meshes are not cached.
  CHECK(mesh_of_shape(*shape("{type: box, size: [1, 1, 1]}")) != mesh_of_shape(*shape("{type: box, size: [1, 1, 1]}")));
  CHECK(first->mesh.vertices == shape(ball)->make().vertices);
}

TEST_CASE("meshes are cached in a folder for the next run, and made again if they are damaged or of another recipe", "[shapes][app]") {
  const TemporaryFolder folder;
  const fs::path meshes = folder.path() / "results" / "meshes";
  const auto check = [&](const std::string& text) {
    write_file(folder.path() / "scene.yaml", text);
    return run_tack(folder.path(), {"check", "scene.yaml"}).out;
  };
  const std::string first = check(scene(1));
  CHECK(first.find(" is OK") != first.npos);
  REQUIRE(files_in(meshes).size() == 1);
  const fs::path file = files_in(meshes)[0];
  const auto written = fs::last_write_time(file);
  CHECK(check(scene(1)) == first);
  CHECK(fs::last_write_time(file) == written);
  // A damaged file is not used, and is written again.
  const std::string bytes = file_text(file);
  write_file(file, bytes.substr(0, bytes.size() / 2));
  CHECK(check(scene(1)) == first);
  CHECK(file_text(file) == bytes);
  std::string turned = bytes;
  turned[bytes.size() / 2] ^= 4;
  write_file(file, turned);
  CHECK(check(scene(1)) == first);
  CHECK(file_text(file) == bytes);
  CHECK(check(scene(2)) != first);
  CHECK(files_in(meshes).size() == 2);
}
