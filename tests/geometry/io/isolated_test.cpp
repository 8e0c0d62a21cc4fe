// Readers in a child process: the program gets a mesh or an error that names the file.
#include "geometry/io/isolated.hpp"

#include <tbb/parallel_for.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "geometry/errors.hpp"
#include "geometry/io/mesh_bytes.hpp"
#include "geometry/shapes/solids.hpp"
#include "tests/support/program.hpp"

using namespace tack;
using Catch::Matchers::Contains;

namespace {

using Path = std::filesystem::path;

Mesh tagged_box(const Path& = {}) {
  Mesh mesh = box_tets({1, 2, 3}, {2, 3, 4});
  mesh.triangles = {{0, 1, 2}};
  mesh.edges = {{3, 4}, {4, 5}};
  mesh.points = {6};
  mesh.tags = {{"", {}}, {"left", {0, 2, 5}}};
  return mesh;
}

void check_same(const Mesh& a, const Mesh& b) {
  CHECK(a.vertices == b.vertices);
  CHECK(a.tets == b.tets);
  CHECK(a.triangles == b.triangles);
  CHECK(a.edges == b.edges);
  CHECK(a.points == b.points);
  CHECK(a.tags == b.tags);
}

std::string error_of(MeshReader reader) {
  try {
    read_isolated("part.vtk", reader);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Returns the error of a reader with this action.
template <auto act>
std::string error_after() {
  return error_of([](const Path&) {
    act();
    return Mesh();
  });
}

}  // namespace

TEST_CASE("a mesh is passed on unchanged", "[io]") {
  check_same(read_isolated("part.vtk", tagged_box), tagged_box());
  check_same(read_isolated("part.vtk", [](const Path&) { return Mesh(); }), Mesh());
  const std::string bytes = bytes_of(tagged_box());
  check_same(mesh_from(bytes).value(), tagged_box());
  for (const size_t length : {1, 7, 8, 100, 500}) CHECK_FALSE(mesh_from(std::string_view(bytes).substr(0, length)));
  CHECK_FALSE(mesh_from(std::string(8, '\xff')));
}

TEST_CASE("errors, crashes, exits, endless loops and endless memory become errors", "[io]") {
  CHECK(error_after<[] { throw InputError("line 3 is wrong"); }>() == "line 3 is wrong");
  CHECK_THAT(error_after<[] { throw std::length_error("vector"); }>(), Contains("part.vtk: cannot be read (vector)"));
  constexpr auto crash = [] { std::raise(SIGSEGV); };
  CHECK_THAT(error_after<crash>(), Contains("part.vtk: the library that reads such files ") &&
                                       Contains("damaged, export it again"));
  CHECK_THAT(error_after<[] { std::abort(); }>(), Contains("part.vtk: the library"));
  CHECK_THAT(error_after<[] { std::_Exit(0); }>(), Contains("ended with code 0"));
#ifndef __SANITIZE_ADDRESS__
  constexpr auto fill_memory = [] {
    for (std::vector<Vec3> all;;) all.resize(2 * all.size() + 1);
  };
  constexpr auto never_end = [] {
    for (std::atomic<int> i = 0;; ++i) {}
  };
  CHECK_THAT(error_after<crash>(), Contains("crashed (Segmentation fault)"));
  CHECK_THAT(error_after<fill_memory>(), Contains("part.vtk: needs far more memory"));
  CHECK_THAT(error_after<never_end>(), Contains("did not come to an end"));
#endif
}

TEST_CASE("meshes are read while other threads work", "[io]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "part.obj", "");
  std::atomic<bool> stop = false;
  std::vector<std::thread> others;
  for (int i = 0; i < 3; ++i)
    others.emplace_back([&] {  // allocating and looping in parallel all the time
      while (!stop)
        tbb::parallel_for(0, 100, [](int n) { std::vector<double> some(static_cast<size_t>(n) * 100, 1.0); });
    });
  for (int i = 0; i < 50; ++i)
    CHECK(read_isolated("part.vtk", tagged_box).tets.size() == 144);
  stop = true;
  for (std::thread& other : others) other.join();
}
