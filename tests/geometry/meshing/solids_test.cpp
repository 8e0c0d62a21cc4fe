// Booleans, cuts and tets: volumes add up, angles and distances keep their bounds.
#include <catch2/catch.hpp>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/io/mesh_io.hpp"
#include "geometry/mesh/mass_properties.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/mesh/validate.hpp"
#include "geometry/meshing/booleans.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/mesh/mesh_quality.hpp"
#include "geometry/meshing/mesh_warnings.hpp"
#include "geometry/meshing/surface_deviation.hpp"
#include "geometry/meshing/tetrahedralize.hpp"
#include "geometry/mesh/triangle_surface.hpp"
#include "geometry/shapes/solids.hpp"
#include "tests/support/broken_meshes.hpp"
#include "tests/support/closed_surface.hpp"

using namespace tack;
using Catch::Matchers::Contains;

namespace {

constexpr double pi = std::numbers::pi;

double volume(const Mesh& mesh) { return enclosed_volume_of(mesh); }

Mesh combined(Boolean kind, const Mesh& a, const Mesh& b) {
  Notes notes;
  return boolean(kind, a, b, "first", "second", notes);
}

Mesh moved(Mesh mesh, const Vec3& offset) {
  translate(mesh, offset);
  return mesh;
}

void check_volumes(const Mesh& a, const Mesh& b) {
  const double both = volume(combined(Boolean::intersect, a, b)), any = volume(combined(Boolean::unite, a, b)),
               rest = volume(combined(Boolean::subtract, a, b));
  CHECK(any + both == Approx(volume(a) + volume(b)).epsilon(1e-9));
  CHECK(rest + both == Approx(volume(a)).epsilon(1e-9));
}

struct Filled {
  Mesh mesh;
  Notes notes;
  std::string told;  // the notes, a line each
};

Filled filled(const Mesh& surface, const TetrahedralizeOptions& options) {
  Filled f;
  f.mesh = tetrahedralize(surface, options, "part", f.notes);
  for (const std::string& line : f.notes) f.told += line + "\n";
  return f;
}

void check_tets(const Mesh& surface, double edge_length, double deviation) {
  const Filled f = filled(surface, {.edge_length = edge_length, .deviation = deviation});
  INFO(f.told);
  CHECK_NOTHROW(validate_mesh(f.mesh, "tets"));
  const Surface border = extract_surface(f.mesh);
  CHECK(is_closed_manifold(border.triangles));
  CHECK(dihedral_angles(f.mesh).smallest > 8);
  CHECK(total_volume(f.mesh) == Approx(volume(surface)).epsilon(0.015));
  CHECK(edge_lengths(f.mesh).mean < 1.3 * edge_length);
  CHECK(edge_lengths(f.mesh).mean > 0.4 * edge_length);  // shorter where the deviation or creases ask for it
  Mesh faces;
  faces.vertices = f.mesh.vertices;
  faces.triangles = border.triangles;
  CHECK(surface_deviation(faces, surface, edge_length / 4).largest <= deviation * 1.05);  // sampled elsewhere than before
  CHECK(surface_deviation(surface, faces, edge_length / 4).largest <= deviation * 1.05);
  CHECK_FALSE(mesh_warning::given(f.notes, mesh_warning::any));
}

}  // namespace

TEST_CASE("the volumes of union, intersection and difference add up", "[meshing]") {
  check_volumes(box_surface({1, 1, 1}), moved(box_surface({1, 1, 1}), {0.5, 0.4, 0.3}));
  check_volumes(sphere_surface(1, 8), moved(sphere_surface(1, 7), {0.71, 0.1, 0.2}));
  check_volumes(sphere_surface(0.7, 8), box_surface({1, 1, 1}));
  check_volumes(box_surface({1, 1, 1}), moved(box_surface({1, 1, 1}, {2, 2, 2}), {0.5, 0, 0}));  // faces in one plane
}

TEST_CASE("booleans of solids that do not meet or only touch", "[meshing]") {
  const Mesh box = box_surface({1, 1, 1}), far = moved(box, {3, 0, 0});
  CHECK(find_defects(combined(Boolean::unite, box, far)).component_count == 2);
  CHECK(volume(combined(Boolean::subtract, box, far)) == Approx(1));
  CHECK_THROWS_WITH(combined(Boolean::intersect, box, far), Contains("nothing is left"));
  const Mesh hollow = combined(Boolean::subtract, box, box_surface({0.5, 0.5, 0.5}));
  CHECK(volume(hollow) == Approx(0.875));
  CHECK(volume(combined(Boolean::unite, hollow, box_surface({0.6, 0.6, 0.6}))) == Approx(1));
  CHECK(volume(combined(Boolean::unite, box, moved(box, {1, 0, 0}))) == Approx(2));  // over a common face
}

TEST_CASE("booleans refuse surfaces that are no solids, with name and indices", "[meshing]") {
  const Mesh box = box_surface({1, 1, 1});
  CHECK_THROWS_WITH(combined(Boolean::unite, with_hole(), box), Contains("first: needs a closed surface") && Contains("open edges"));
  CHECK_THROWS_WITH(combined(Boolean::unite, box, crossing_itself()), Contains("second: needs") && Contains("triangles that cross"));
  CHECK_THROWS_WITH(combined(Boolean::unite, box, inside_out()), Contains("inside out"));
  CHECK_THROWS_WITH(combined(Boolean::unite, boxes_at({Vec3(0, 0, 0), Vec3(0, 0, 0)}), box), Contains("first: needs"));
}

TEST_CASE("both halves of a cut have the volume of the solid", "[meshing]") {
  Notes notes;
  const Vec3 normal(1, 2, 3);
  for (const Mesh& mesh : {box_surface({1, 1, 1}), sphere_surface(1, 6)}) {
    const Vec3 point(0.1, 0.05, 0);
    const Mesh below = cut(mesh, point, normal, "part", notes), above = cut(mesh, point, -normal, "part", notes);
    CHECK(find_defects(below).bounds_volume());
    CHECK(volume(below) + volume(above) == Approx(volume(mesh)).epsilon(1e-9));
    for (const Vec3& x : below.vertices) CHECK((x - point).dot(normal) < 1e-9);
  }
  CHECK(volume(cut(box_surface({1, 1, 1}), Vec3(0.25, 0, 0), Vec3(1, 0, 0), "part", notes)) == Approx(0.75));
  CHECK_THROWS_WITH(cut(box_surface({1, 1, 1}), Vec3(-2, 0, 0), Vec3(1, 0, 0), "part", notes), Contains("nothing is left"));
  CHECK_THROWS_AS(cut(box_surface({1, 1, 1}), Vec3(0, 0, 0), Vec3(0, 0, 0), "part", notes), InputError);
}

TEST_CASE("tets fill a box and keep its edges", "[meshing]") {
  check_tets(box_surface({1, 0.6, 0.4}), 0.12, 1e-6);
  const Filled f = filled(box_surface({1, 0.6, 0.4}), {.edge_length = 0.2});
  CHECK(total_volume(f.mesh) == Approx(0.24).epsilon(1e-9));
}

TEST_CASE("tets fill a ball within the requested deviation", "[meshing]") { check_tets(sphere_surface(1, 16), 0.25, 0.006); }

TEST_CASE("tets fill bodies of several components, smooth and sharp, and hollow ones", "[meshing]") {
  Mesh parts = box_surface({1, 1, 1});
  append(parts, moved(sphere_surface(0.3, 6), {2, 0, 0}));  // smooth: no crease leads there
  append(parts, moved(sphere_surface(0.2, 6), {0, 2, 0}));
  check_tets(parts, 0.2, 0.025);
  check_tets(combined(Boolean::subtract, sphere_surface(1, 10), sphere_surface(0.6, 8)), 0.25, 0.03);
  check_tets(combined(Boolean::unite, box_surface({1, 1, 1}), moved(sphere_surface(0.5, 6), {0.5, 0.1, 0.2})), 0.25, 0.03);
}

// An arm of a coarse smooth body that was remeshed into a fold: nearly every edge passes for a crease, and balls that protect them touch.
TEST_CASE("creases that cannot be protected are rounded instead of refined without end", "[meshing]") {
  const Mesh folded = read_mesh(TACK_TEST_DATA "/meshes/folded.obj");
  const Filled f = filled(folded, {.edge_length = 0.01, .surface_edge_length = 0.008, .deviation = 0.002});
  INFO(f.told);
  CHECK_NOTHROW(validate_mesh(f.mesh, "tets"));
  CHECK(is_closed_manifold(extract_surface(f.mesh).triangles));
  CHECK(f.mesh.tets.size() < 2000);
  CHECK(mesh_warning::given(f.notes, mesh_warning::rounded_creases));
}

TEST_CASE("the same surface gives the same tets", "[meshing]") {
  const TetrahedralizeOptions options{.edge_length = 0.3};
  const Mesh a = filled(sphere_surface(1, 8), options).mesh;
  const Mesh b = filled(sphere_surface(1, 8), options).mesh;
  CHECK(a.vertices == b.vertices);
  CHECK(a.tets == b.tets);
}

TEST_CASE("a dihedral angle that cannot be reached is reported with the worst tet", "[meshing]") {
  Mesh wedge;  // two faces at five degrees
  const double up = std::tan(5 * pi / 180);
  wedge.vertices = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(1, 0, 1), Vec3(1, up, 0), Vec3(1, up, 1)};
  wedge.triangles = {{0, 3, 1}, {0, 2, 3}, {0, 1, 5}, {0, 5, 4}, {2, 4, 5}, {2, 5, 3}, {0, 4, 2}, {1, 3, 5}};
  if (volume(wedge) < 0)
    for (Triangle& t : wedge.triangles) std::swap(t[0], t[1]);
  const Filled f = filled(wedge, {.edge_length = 0.5});
  CHECK(mesh_warning::given(f.notes, mesh_warning::missed_angle));
  CHECK_THAT(f.told, Contains("of tet"));
}

TEST_CASE("surfaces that are no solids, and too many tets, are refused", "[meshing]") {
  CHECK_THROWS_WITH(filled(with_hole(), {.edge_length = 0.3}), Contains("3 open edges"));
  CHECK_THROWS_WITH(filled(crossing_boxes(), {.edge_length = 0.3}), Contains("triangles that cross"));
  CHECK_THROWS_WITH(filled(sharing_a_vertex(), {.edge_length = 0.3}), Contains("vertex in which surfaces touch"));
  CHECK_THROWS_WITH(filled(box_surface({1, 1, 1}), {.edge_length = 1e-4}), Contains("more than the 1e7"));
}

TEST_CASE("angles, radii and edges of a regular and a right-angled tet", "[meshing]") {
  Mesh mesh;
  mesh.vertices = {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)};
  mesh.tets = {{0, 1, 3, 2}};
  if (total_volume(mesh) < 0) std::swap(mesh.tets[0][0], mesh.tets[0][1]);
  CHECK(dihedral_angles(mesh).smallest == Approx(std::acos(1.0 / 3) * 180 / pi));
  CHECK(dihedral_angles(mesh).largest == Approx(std::acos(1.0 / 3) * 180 / pi));
  CHECK(radius_edge(mesh).largest == Approx(std::sqrt(6.0) / 4));
  CHECK(edge_lengths(mesh).mean == Approx(std::sqrt(8.0)));
  mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  mesh.tets = {{0, 1, 2, 3}};
  const AngleHistogram h = dihedral_angles(mesh);
  CHECK(h.largest == Approx(90));
  CHECK(h.smallest == Approx(std::atan(std::sqrt(2.0)) * 180 / pi));
  CHECK(h.worst == 0);
  CHECK(h.count[5] == 3);
  CHECK(h.count[8] + h.count[9] == 3);
  CHECK(radius_edge(mesh).largest == Approx(std::sqrt(3.0) / 2));
}
