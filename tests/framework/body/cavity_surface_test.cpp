#include "framework/body/cavity_surface.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "geometry/mesh/oriented_surface.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/shapes/solids.hpp"

using namespace tack;

namespace {

// Returns the surface of a cube around the origin, and appends its vertices.
std::vector<Triangle> cube(double edge, VecX& rest) {
  const Mesh solid = box_tets(Vec3::Constant(edge), {1, 1, 1});
  const int first = static_cast<int>(rest.size() / 3);
  rest.conservativeResize(rest.size() + 3 * static_cast<Eigen::Index>(solid.vertices.size()));
  for (size_t v = 0; v < solid.vertices.size(); ++v) vertex(rest, first + static_cast<int>(v)) = solid.vertices[v];
  std::vector<Triangle> triangles = extract_surface(solid).triangles;
  for (Triangle& t : triangles) t = {t[0] + first, t[1] + first, t[2] + first};
  return triangles;
}

std::vector<Triangle> turned(std::vector<Triangle> triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return triangles;
}

double volume(const std::vector<CavityWall>& walls, const VecX& rest) {
  return OrientedSurface(cavity_surface(walls, rest, "chamber 'air'").triangles).volume(rest, Vec3::Zero());
}

}  // namespace

// Sheets may have either orientation; the normals of faces of solids point out of the cavity.
TEST_CASE("a cavity is the space between nested surfaces", "[loads]") {
  VecX rest;
  const auto outer = cube(1, rest), inner = cube(0.5, rest), innermost = cube(0.2, rest);
  for (const bool turn : {false, true}) {
    INFO(turn);
    const CavityWall balloon{outer, false}, within{turn ? turned(inner) : inner, false}, core{turn ? turned(innermost) : innermost, false};
    CHECK(volume({balloon}, rest) == Approx(1).epsilon(1e-12));
    CHECK(volume({balloon, within}, rest) == Approx(0.875).epsilon(1e-12));
    CHECK(volume({within, balloon, core}, rest) == Approx(0.883).epsilon(1e-12));
  }
  // A solid in a balloon: the normals of its surface point out of the cavity.
  CHECK(volume({{outer, false}, {turned(inner), true}}, rest) == Approx(0.875).epsilon(1e-12));
  // The solid has a void, which is another cavity.
  CHECK_THROWS_WITH(volume({{outer, false}, {inner, true}}, rest), Catch::Contains("a cavity lies within another wall, and would count twice"));
}
