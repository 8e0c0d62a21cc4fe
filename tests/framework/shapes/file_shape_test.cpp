// Mesh files in scenes: their unit, and vertices that are welded.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <limits>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/shapes/shape_source.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/mass_properties.hpp"
#include "geometry/mesh/surface.hpp"
#include "tests/support/silence.hpp"

using namespace tack;
using Catch::Contains;

namespace {

// A cube of edge 20 whose six faces have four vertices each. Those of one corner differ by a float's last place.
void write_cube(const std::filesystem::path& path) {
  const int corners[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::ofstream out(path);
  out.precision(17);
  for (int f = 0; f < 6; ++f)
    for (const int c : corners[f]) {
      const float far = f % 2 ? std::nextafter(20.0F, 30.0F) : 20.0F;
      out << "v " << (c & 1 ? far : 0) << ' ' << (c & 2 ? far : 0) << ' ' << (c & 4 ? far : 0) << '\n';
    }
  for (int f = 0; f < 6; ++f) out << "f " << 4 * f + 1 << ' ' << 4 * f + 2 << ' ' << 4 * f + 3 << ' ' << 4 * f + 4 << '\n';
}

std::unique_ptr<ShapeSource> shape(const std::string& yaml) { return bind_component<ShapeSource>(parse_string(yaml, "test")); }

double volume_of(const Mesh& mesh) {
  double volume = 0;
  for (const Triangle& t : mesh.triangles) volume += mesh.vertices[t[0]].dot(mesh.vertices[t[1]].cross(mesh.vertices[t[2]])) / 6;
  return volume;
}

// Returns the number of edges with one triangle.
int open_edges(const Mesh& mesh) {
  std::map<Edge, int> triangles;
  for (const Triangle& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) ++triangles[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}];
  return static_cast<int>(std::count_if(triangles.begin(), triangles.end(), [](const auto& e) { return e.second == 1; }));
}

}  // namespace

TEST_CASE("a mesh file has a unit, and vertices that nearly coincide are welded if asked for", "[shapes]") {
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "cube.obj").string();
  write_cube(path);
  const Mesh plain = shape("{type: file, path: " + path + "}")->make();
  CHECK(plain.vertices.size() == 24);
  CHECK(open_edges(plain) == 24);
  CHECK(volume_of(plain) == Approx(8000));

  const auto small = shape("{type: file, path: " + path + ", unit: mm}");
  CHECK(volume_of(small->make()) == Approx(8e-6));
  CHECK(small->notes() == std::vector<std::string>{"scaled by 0.001: now 0.02 x 0.02 x 0.02 m"});

  const Mesh exact = shape("{type: file, path: " + path + ", weld: 0}")->make();
  CHECK(exact.vertices.size() > 8);  // equal coordinates only
  const auto welded = shape("{type: file, path: " + path + ", unit: mm, weld: 1 um}");
  const Mesh closed = welded->make();
  CHECK(closed.vertices.size() == 8);
  CHECK(closed.triangles.size() == 12);
  CHECK(open_edges(closed) == 0);
  CHECK(volume_of(closed) == Approx(8e-6));
  CHECK(welded->notes().back() == "welded: 16 of 24 vertices merged with others within 1e-06 m, 0 elements dropped");

  CHECK_THROWS_WITH(shape("{type: file, path: " + path + ", weld: 100 m}")->make(), Contains("all elements collapse"));
  CHECK_THROWS_WITH(shape("{type: file, path: " + path + ", unit: mile2}"), Contains("expects a unit of length"));
  CHECK_THROWS_WITH(shape("{type: file, path: " + path + ", weld: -1 mm}"), Contains("weld"));
}
