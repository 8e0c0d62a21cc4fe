// Remeshing, simplification, subdivision and offsets against closed forms.
#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/mesh_quality.hpp"
#include "geometry/meshing/mesh_warnings.hpp"
#include "geometry/meshing/offset.hpp"
#include "geometry/meshing/remesh.hpp"
#include "geometry/meshing/simplify.hpp"
#include "geometry/meshing/subdivide.hpp"
#include "geometry/meshing/surface_deviation.hpp"
#include "geometry/mesh/triangle_surface.hpp"
#include "tests/support/broken_meshes.hpp"

using namespace tack;
using Catch::Matchers::Contains;

namespace {

constexpr double pi = std::numbers::pi;

Mesh remeshed(const Mesh& mesh, double edge_length) {
  Notes notes;
  return remesh(mesh, {.edge_length = edge_length}, "part", notes);
}

Mesh subdivided(const Mesh& mesh, SubdivisionRule rule, int times) {
  Notes notes;
  return subdivide(mesh, rule, times, "part", notes);
}

Mesh offset_by(const Mesh& mesh, double distance, double edge_length, double deviation) {
  Notes notes;
  return offset(mesh, {distance, edge_length, deviation}, "part", notes);
}

}  // namespace

TEST_CASE("a box stays a box when it is remeshed", "[meshing]") {
  const Mesh mesh = remeshed(box_surface({1, 0.6, 0.4}), 0.1);
  const EdgeLengths l = edge_lengths(mesh);
  CHECK(l.shortest > 0.05);
  CHECK(l.longest < 0.16);
  CHECK(l.mean == Approx(0.1).epsilon(0.15));
  CHECK(find_defects(mesh).volume == Approx(0.24).epsilon(1e-9));
  CHECK(total_area(mesh) == Approx(2.48).epsilon(1e-9));
  CHECK(find_defects(mesh).bounds_volume());
  CHECK(triangle_angles(mesh).smallest > 15);
}

TEST_CASE("edges longer than the surface are refused, and those that change its area give a warning", "[meshing]") {
  const Mesh ball = sphere_surface(1, 16);
  CHECK_THROWS_WITH(remeshed(ball, 5), Contains("part: edges of 5 m are longer than the surface, which is 3.46") && Contains("edge_length=5mm"));
  Notes coarse, fine;
  remesh(ball, {.edge_length = 1.2}, "part", coarse);
  remesh(ball, {.edge_length = 0.2}, "part", fine);
  CHECK(mesh_warning::given(coarse, mesh_warning::changed_area));
  CHECK_FALSE(mesh_warning::given(fine, mesh_warning::changed_area));
}

TEST_CASE("a remeshed sphere keeps its area and volume", "[meshing]") {
  const Mesh fine = sphere_surface(1, 20), mesh = remeshed(fine, 0.15);
  CHECK(find_defects(mesh).bounds_volume());
  CHECK(find_defects(mesh).volume == Approx(4 * pi / 3).epsilon(0.015));
  CHECK(total_area(mesh) == Approx(4 * pi).epsilon(0.01));
  CHECK(edge_lengths(mesh).longest < 1.6 * 0.15);
  CHECK(edge_lengths(mesh).shortest > 0.5 * 0.15);
  CHECK(surface_deviation(mesh, fine, 0.05).largest < 0.01);
}

TEST_CASE("open surfaces keep their border when they are remeshed", "[meshing]") {
  const Mesh mesh = remeshed(grid({1, 1}, {3, 3}), 0.08);
  CHECK(total_area(mesh) == Approx(1).epsilon(1e-9));
  CHECK(find_defects(mesh).holes == 1);
}

TEST_CASE("simplification reaches the requested number of triangles", "[meshing]") {
  Notes notes;
  const Mesh ball = simplify(sphere_surface(1, 12), 400, "ball", notes);
  CHECK(ball.triangles.size() <= 400);
  CHECK(ball.triangles.size() >= 398);
  CHECK(find_defects(ball).bounds_volume());
  CHECK(find_defects(ball).volume == Approx(4 * pi / 3).epsilon(0.03));
  const Mesh box = simplify(box_surface({1, 1, 1}, {6, 6, 6}), 12, "box", notes);
  CHECK(box.triangles.size() == 12);
  CHECK(find_defects(box).volume == Approx(1).epsilon(1e-9));
}

TEST_CASE("subdivision makes four triangles of one", "[meshing]") {
  const Mesh box = box_surface({1, 1, 1});
  const Mesh flat = subdivided(box, SubdivisionRule::flat, 2);
  CHECK(flat.triangles.size() == 16 * 12);
  CHECK(find_defects(flat).volume == Approx(1).epsilon(1e-12));
  std::vector<double> volumes;
  for (int times = 1; times <= 4; ++times) volumes.push_back(find_defects(subdivided(box, SubdivisionRule::loop, times), false).volume);
  const double first = volumes[1] - volumes[0], second = volumes[2] - volumes[1], third = volumes[3] - volumes[2];
  CHECK(std::abs(second) < 0.5 * std::abs(first));  // it converges
  CHECK(std::abs(third) < 0.5 * std::abs(second));
  CHECK(volumes[3] < 0.6);
  CHECK(volumes[3] > 0.2);
}

TEST_CASE("the offset of a ball is a ball", "[meshing]") {
  const Mesh ball = sphere_surface(1, 8);
  for (const double distance : {0.2, -0.3}) {
    const Mesh mesh = offset_by(ball, distance, 0.25, 0.01);
    CHECK(find_defects(mesh).bounds_volume());
    double least = 10, most = 0;
    for (const Vec3& x : mesh.vertices) least = std::min(least, x.norm()), most = std::max(most, x.norm());
    CHECK(most < 1 + distance + 1e-3);
    CHECK(least > 1 + distance - 0.02);  // the ball is not quite round
    CHECK(find_defects(mesh).volume == Approx(4 * pi / 3 * std::pow(1 + distance, 3)).epsilon(0.04));
  }
}

TEST_CASE("the offset of a box is round outside and sharp inside", "[meshing]") {
  const double r = 0.2;
  const Mesh outside = offset_by(box_surface({1, 1, 1}), r, 0.1, 0.005);
  CHECK(find_defects(outside).bounds_volume());
  CHECK(find_defects(outside).volume == Approx(1 + 6 * r + 3 * pi * r * r + 4 * pi / 3 * r * r * r).epsilon(0.01));
  const Mesh inside = offset_by(box_surface({1, 1, 1}), -r, 0.1, 0.01);
  CHECK(find_defects(inside).volume == Approx(0.6 * 0.6 * 0.6).epsilon(0.03));
  CHECK_THROWS_WITH(offset_by(box_surface({1, 1, 1}), -0.6, 0.1, 0.01), Contains("nothing of the surface is 0.6 m inside"));
}

TEST_CASE("offsets include all components", "[meshing]") {
  const Mesh two = boxes_at({Vec3(0, 0, 0), Vec3(4, 0, 0)}), far = offset_by(two, 0.1, 0.2, 0.02);
  CHECK(find_defects(far).component_count == 2);
  CHECK(find_defects(offset_by(boxes_at({Vec3(0, 0, 0), Vec3(1.1, 0, 0)}), 0.2, 0.1, 0.01)).component_count == 1);  // grown together
}

TEST_CASE("too many triangles are refused before meshing", "[meshing]") {
  CHECK_THROWS_WITH(remeshed(box_surface({1, 1, 1}), 1e-6), Contains("more than the 1e7"));
  CHECK_THROWS_WITH(subdivided(sphere_surface(1, 20), SubdivisionRule::loop, 8), Contains("divide fewer times"));
}

TEST_CASE("defective surfaces are refused with the indices of the defects", "[meshing]") {
  CHECK_THROWS_WITH(remeshed(with_fin(), 0.2), Contains("part: needs") && Contains("of triangles") && Contains("12") && Contains("repair"));
  CHECK_THROWS_WITH(subdivided(with_duplicates(), SubdivisionRule::loop, 1), Contains("2 duplicated triangles: 2 and 13, 4 and 12"));
  CHECK_THROWS_WITH(offset_by(with_hole(), 0.1, 0.1, 0.01), Contains("3 open edges"));
}

TEST_CASE("surface deviations agree with shifted planes and balls", "[meshing]") {
  Mesh high = grid({1, 1}, {4, 4});
  translate(high, Vec3(0, 0.25, 0));
  const SurfaceDeviation d = surface_deviation(grid({1, 1}, {4, 4}), high, 0.05);
  CHECK(d.largest == Approx(0.25));
  CHECK(d.rms == Approx(0.25));
  // A small patch is near a large one everywhere; the large one is not near the small one.
  const Mesh large = grid({3, 1}, {6, 2}), small = grid({1, 1}, {2, 2});
  CHECK(surface_deviation(small, large, 0.1).largest == Approx(0).margin(1e-12));
  CHECK(surface_deviation(large, small, 0.1).largest == Approx(1));
  const double inner = surface_deviation(sphere_surface(1, 16), sphere_surface(0.9, 16), 0.1).rms;
  CHECK(inner == Approx(0.1).epsilon(0.01));
}
