// A dozen broken surfaces: their defects are found by number, and repaired, or refused with the numbers.
#include "geometry/meshing/repair.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/errors.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/triangle_surface.hpp"
#include "tests/support/broken_meshes.hpp"

using namespace tack;
using Catch::Matchers::Contains;

namespace {

std::string joined(const Notes& notes) {
  std::string text;
  for (const std::string& line : notes) text += line + "\n";
  return text;
}

struct Repaired {
  Mesh mesh;
  std::string told;
};

Repaired repaired(const Mesh& mesh, const RepairOptions& options = {}) {
  Notes notes;
  Mesh result = repair(mesh, options, "part", notes);
  return {std::move(result), joined(notes)};
}

// Checks that the repaired mesh is a solid of the volume with that number of components.
std::string check_solid(const Mesh& mesh, double volume, int parts, double within = 1e-12) {
  const Repaired r = repaired(mesh);
  INFO(r.told);
  const SurfaceDefects d = find_defects(r.mesh);
  CHECK(d.bounds_volume());
  CHECK(list_defects(d).empty());
  CHECK(d.component_count == parts);
  CHECK(d.volume == Approx(volume).epsilon(within));
  return r.told;
}

double ball_volume() { return enclosed_volume_of(sphere_surface(1, 4)); }

std::string error_of(const Mesh& mesh, const RepairOptions& options = {}) {
  try {
    repaired(mesh, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a valid surface has no defects and stays as it is", "[meshing]") {
  for (const Mesh& mesh : {box_surface({1, 2, 3}, {2, 3, 4}), sphere_surface(1, 4), boxes_at({Vec3(0, 0, 0), Vec3(2, 0, 0)})}) {
    const SurfaceDefects d = find_defects(mesh);
    CHECK(list_defects(d).empty());
    CHECK(d.bounds_volume());
    const Repaired r = repaired(mesh);
    CHECK(r.mesh.vertices == mesh.vertices);
    CHECK(r.mesh.triangles.size() == mesh.triangles.size());
    CHECK(r.told == "nothing to repair\n");
  }
}

TEST_CASE("holes are found and filled", "[meshing]") {
  const SurfaceDefects d = find_defects(with_hole());
  CHECK(d.open_edges.size() == 3);
  CHECK(d.holes == 1);
  CHECK_FALSE(d.closed());
  CHECK_THAT(check_solid(with_hole(), 1, 1), Contains("found 3 open edges") && Contains("filled 1 holes with 1 triangles"));
  CHECK(find_defects(with_two_holes()).holes == 2);
  CHECK_THAT(check_solid(with_two_holes(), ball_volume(), 1, 0.02), Contains("filled 2 holes"));
  const Repaired open = repaired(with_hole(), {0, Holes::keep});
  CHECK(find_defects(open.mesh).holes == 1);
}

TEST_CASE("holes of solids are filled; holes of sheets only on request", "[meshing]") {
  // Half a ball, and one of 640 triangles of a ball missing.
  Mesh half = sphere_surface(1, 8);
  std::erase_if(half.triangles, [&](const Triangle& t) { return (half.vertices[t[0]] + half.vertices[t[1]] + half.vertices[t[2]]).y() < 0; });
  Mesh ball = sphere_surface(1, 8);
  translate(ball, Vec3(3, 0, 0));
  ball.triangles.erase(ball.triangles.begin() + 100);
  const Repaired sheet = repaired(half);
  CHECK(find_defects(sheet.mesh).holes == 1);
  CHECK(sheet.mesh.triangles.size() == half.triangles.size());
  CHECK_THAT(sheet.told, Contains("left 1 holes open") && Contains("holes=fill"));
  const Repaired dome = repaired(half, {0, Holes::fill});
  CHECK(find_defects(dome.mesh).bounds_volume());
  CHECK_THAT(dome.told, Contains("filled 1 holes"));
  Mesh both = half;
  append(both, ball);
  const Repaired mixed = repaired(both);
  CHECK(find_defects(mixed.mesh).holes == 1);
  CHECK_THAT(mixed.told, Contains("filled 1 holes with 1 triangles") && Contains("left 1 holes open"));
  // A sheet with a hole in it is not mended either: which of its borders are meant?
  Mesh cloth = grid({1, 1}, {6, 6});
  cloth.triangles.erase(cloth.triangles.begin() + 31);
  CHECK(find_defects(repaired(cloth).mesh).holes == 2);
  CHECK_THAT(error_of(grid({1, 1}, {6, 6}), {0, Holes::fill}), Contains("is an open sheet") && Contains("holes=keep"));
}

TEST_CASE("flipped triangles are listed and reoriented", "[meshing]") {
  const SurfaceDefects d = find_defects(with_flipped());
  CHECK(d.flipped.size() == 6);
  CHECK_THAT(check_solid(with_flipped(), 1, 1), Contains("turned 2 triangles to face as their neighbours: 3, 17"));
  CHECK(find_defects(inside_out()).inside_out());
  CHECK_THAT(check_solid(inside_out(), 1, 1), Contains("found inside out") && Contains("turned 1 components"));
}

TEST_CASE("duplicated, collapsed and degenerate triangles are listed and removed", "[meshing]") {
  using Pairs = std::vector<std::array<int, 2>>;
  CHECK(find_defects(with_duplicates()).duplicates == Pairs{{2, 13}, {4, 12}});
  CHECK_THAT(check_solid(with_duplicates(), 1, 1), Contains("removed 2 duplicated triangles: 12, 13"));
  CHECK(find_defects(with_collapsed()).degenerate == std::vector<int>{12});
  CHECK_THAT(check_solid(with_collapsed(), 1, 1), Contains("removed 1 collapsed triangles: 12"));
  CHECK(find_defects(with_degenerate()).degenerate == std::vector<int>{13});
  check_solid(with_degenerate(), 1, 1);
}

TEST_CASE("vertices with equal positions are merged, near ones on request", "[meshing]") {
  CHECK(find_defects(unmerged()).doubled_vertices.size() == 28);
  CHECK_THAT(check_solid(unmerged(), 1, 1), Contains("merged 28 vertices"));
  Mesh near = unmerged();
  near.vertices[5] += Vec3(1e-7, 0, 0);
  const Repaired r = repaired(near, {1e-6});
  CHECK(r.mesh.vertices.size() == 8);
}

TEST_CASE("vertices that single precision has rounded apart are merged", "[meshing]") {
  for (const double size : {1e-3, 1.0, 60.0})
    for (const double away : {0.0, 10.0}) {
      INFO(size << " m, " << away << " sizes away");
      Mesh ball = unmerged();  // a box, each triangle with vertices of its own
      for (std::size_t v = 0; v < ball.vertices.size(); ++v) {
        Vec3& x = ball.vertices[v];
        x = size * (x + Vec3(away, 1.0 / 3, 0.7));
        for (int k = 0; k < 3; ++k) {
          const float rounded = static_cast<float>(x[k]);
          x[k] = v % 3 == static_cast<std::size_t>(k) ? std::nextafter(rounded, 2 * rounded) : rounded;
        }
      }
      const Repaired r = repaired(ball);
      CHECK(r.mesh.vertices.size() == 8);
      CHECK(find_defects(r.mesh).bounds_volume());
    }
}

TEST_CASE("edges of more than two triangles are found: fins are removed, solids cut apart", "[meshing]") {
  const SurfaceDefects fin = find_defects(with_fin());
  REQUIRE(fin.crowded_edges.size() == 1);
  CHECK(fin.crowded_edges[0].triangles.size() == 3);
  CHECK(fin.crowded_edges[0].triangles.back() == 12);
  CHECK_FALSE(fin.manifold());
  CHECK_THAT(check_solid(with_fin(), 1, 1), Contains("removed 1 dangling triangles: 12"));
  const SurfaceDefects edge = find_defects(sharing_an_edge());
  REQUIRE(edge.crowded_edges.size() == 1);
  CHECK(edge.crowded_edges[0].triangles.size() == 4);
  const SurfaceDefects vertex = find_defects(sharing_a_vertex());
  CHECK(vertex.pinched_vertices.size() == 1);
  CHECK_FALSE(vertex.manifold());
  // Apart, they touch still: which is no solid, and cannot be mended without a decision.
  CHECK_THAT(error_of(sharing_an_edge()), Contains("edge of more than two triangles") && Contains("could not be repaired"));
}

TEST_CASE("components that cross are united", "[meshing]") {
  const SurfaceDefects d = find_defects(crossing_boxes());
  CHECK(d.crossings.size() > 4);
  CHECK_THAT(check_solid(crossing_boxes(), 2 - 0.5 * 0.6 * 0.7, 1), Contains("united 2 closed components"));
}

TEST_CASE("a surface that crosses itself is repaired there", "[meshing]") {
  CHECK(find_defects(crossing_itself()).crossings.size() > 4);
  const Repaired r = repaired(crossing_itself());
  INFO(r.told);
  CHECK(find_defects(r.mesh).bounds_volume());
}

TEST_CASE("sheets that cross are refused, not cut", "[meshing]") {
  Mesh sheets = grid({1, 1}, {6, 6});
  Mesh other = grid({1, 1}, {6, 6});
  for (Vec3& v : other.vertices) v = Vec3(v.x() + 0.03, v.z() + 0.02, v.y() + 0.01);
  append(sheets, other);
  for (const Holes holes : {Holes::of_solids, Holes::keep}) {
    const std::string error = error_of(sheets, {std::nullopt, holes}), left = error.substr(std::min(error.size(), error.find("of which is left")));
    CHECK_THAT(error, Contains("could not be repaired. Given were 144 triangles") && Contains("sheets that cross other surfaces are not cut"));
    // None of the crossings was replaced by other defects.
    CHECK_THAT(left, Contains(std::to_string(find_defects(sheets).crossings.size()) + " pairs of triangles that cross"));
  }
  // A sheet through a solid.
  Mesh through = box_surface({1, 1, 1});
  append(through, grid({3, 3}, {4, 4}));
  CHECK_THAT(error_of(through), Contains("sheets that cross other surfaces are not cut"));
}

TEST_CASE("neighbours that are folded onto each other cross", "[meshing]") {
  Mesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0), Vec3(0.5, 0.5, 0)};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  CHECK(find_defects(mesh).crossings.size() == 1);
  mesh.vertices[3].y() = -0.5;
  CHECK(find_defects(mesh).crossings.empty());
}

TEST_CASE("meshes without a surface, and empty ones, are refused", "[meshing]") {
  Mesh line;
  line.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  line.edges = {{0, 1}};
  CHECK_THAT(error_of(line), Contains("1 edges"));
  CHECK_THAT(error_of(Mesh()), Contains("no triangle"));
  Mesh flat;
  flat.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0)};
  flat.triangles = {{0, 1, 2}, {0, 0, 1}};
  CHECK_THAT(error_of(flat), Contains("part: "));
}
