#include "geometry/mesh/mass_properties.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/shapes/solids.hpp"

using namespace tack;
using Catch::Contains;

namespace {

Mesh surface_of(const Mesh& solid) {
  Mesh mesh;
  mesh.vertices = solid.vertices;
  mesh.triangles = extract_surface(solid).triangles;
  return mesh;
}

// Cubes around the origin within each other, from the outermost; those of a negative edge face inwards.
Mesh nested(const std::vector<double>& edges) {
  Mesh all;
  for (const double edge : edges) {
    Mesh box = surface_of(box_tets(Vec3::Constant(std::abs(edge)), {2, 2, 2}));
    if (edge < 0)
      for (Triangle& t : box.triangles) std::swap(t[0], t[1]);
    const int first = static_cast<int>(all.vertices.size());
    for (const Triangle& t : box.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    all.vertices.insert(all.vertices.end(), box.vertices.begin(), box.vertices.end());
  }
  return all;
}

}  // namespace

TEST_CASE("mass properties of a box, far from the origin, by its tets and by its surface", "[mass]") {
  Mesh box = box_tets({0.2, 0.4, 0.6}, {2, 3, 1});
  translate(box, {10, -3, 5});
  for (const Mesh& mesh : {box, surface_of(box)}) {
    const MassProperties p = mass_properties(mesh);
    CHECK(p.volume == Approx(0.048).epsilon(1e-10));
    CHECK((p.centroid - Vec3(10, -3, 5)).norm() < 1e-12);
    const Vec3 squares = 0.048 / 12 * Vec3(0.04, 0.16, 0.36);
    CHECK((p.moments - Mat3(squares.asDiagonal())).norm() < 1e-10 * squares.norm());
  }
}

TEST_CASE("mass properties need a closed surface with outward normals", "[mass]") {
  Mesh box = surface_of(box_tets({1, 1, 1}, {1, 1, 1}));
  Mesh open = box, inside_out = box, mixed = box, sheetless;
  open.triangles.pop_back();
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  std::swap(mixed.triangles[0][0], mixed.triangles[0][1]);
  CHECK_THROWS_WITH(mass_properties(open), Contains("not closed"));
  CHECK_THROWS_WITH(mass_properties(inside_out), Contains("outwards"));
  CHECK_THROWS_WITH(mass_properties(mixed), Contains("not oriented alike"));
  CHECK_THROWS_WITH(mass_properties(sheetless), Contains("neither tets nor triangles"));
}

TEST_CASE("surfaces within each other count every space once", "[mass]") {
  CHECK(mass_properties(nested({1, -0.5})).volume == Approx(0.875).epsilon(1e-12));
  CHECK(mass_properties(nested({1, -0.5, 0.2})).volume == Approx(0.883).epsilon(1e-12));
  CHECK(mass_properties(nested({0.2, 1, -0.5})).volume == Approx(0.883).epsilon(1e-12));
  CHECK_THROWS_WITH(mass_properties(nested({1, 0.5})), Contains("has a closed surface within another, that of its vertex 27, and what is within both would count twice"));
  CHECK_THROWS_WITH(mass_properties(nested({1, -0.5, -0.2})), Contains("faces inwards and bounds no cavity"));
  CHECK_THROWS_WITH(mass_properties(nested({1, 0.5, -0.2})), Contains("would count twice"));

  Mesh apart = nested({0.5});
  const Mesh other = nested({-0.2});
  const int first = static_cast<int>(apart.vertices.size());
  for (const Triangle& t : other.triangles) apart.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  for (const Vec3& v : other.vertices) apart.vertices.push_back(v + Vec3(2, 0, 0));
  CHECK_THROWS_WITH(mass_properties(apart), Contains("faces inwards and bounds no cavity, that of its vertex "));
}
