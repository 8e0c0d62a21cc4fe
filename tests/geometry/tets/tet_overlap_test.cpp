// Intersections of two sets of tets.
#include <catch2/catch.hpp>

#include "geometry/mesh/quality.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/tets/tet_overlap.hpp"

using namespace tack;

namespace {

using Corners = std::array<Vec3, 4>;

Corners moved(Corners x, const Vec3& by, double scale = 1) {
  for (Vec3& p : x) p = scale * p + by;
  return x;
}

const Corners corner = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};

std::vector<Corners> tets_of(const Mesh& mesh) {
  std::vector<Corners> all;
  for (const Tet& t : mesh.tets) all.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]});
  return all;
}

double volume(const Corners& x) { return tet_volume(x[0], x[1], x[2], x[3]); }

}  // namespace

TEST_CASE("the shared volume of two tets agrees with closed forms", "[tet_overlap]") {
  const double size = GENERATE(1.0, 1e-3, 1e3);
  CAPTURE(size);
  const Corners a = moved(corner, Vec3::Zero(), size);
  CHECK(shared_volume(a, a) == Approx(volume(a)).epsilon(1e-14));
  // A corner tet shifted along its axes by s: a corner of size 1 - s remains.
  CHECK(shared_volume(a, moved(a, size * Vec3(0.25, 0, 0))) == Approx(std::pow(0.75 * size, 3) / 6).epsilon(1e-13));
  CHECK(shared_volume(a, moved(a, size * Vec3(0.1, 0.2, 0.3))) == Approx(std::pow(0.4 * size, 3) / 6).epsilon(1e-13));
  // One within the other, and one that only touches.
  CHECK(shared_volume(a, moved(a, size * Vec3(0.1, 0.1, 0.1), 0.5)) == Approx(volume(a) / 8).epsilon(1e-13));
  CHECK(shared_volume(moved(a, size * Vec3(0.1, 0.1, 0.1), 0.5), a) == Approx(volume(a) / 8).epsilon(1e-13));
  CHECK(shared_volume(a, {a[0], a[2], a[1], Vec3(0, 0, -size)}) < 1e-14 * volume(a));
  CHECK(shared_volume(a, moved(a, size * Vec3(2, 0, 0))) == 0);
}

TEST_CASE("the overlaps of two meshes of a box fill its tets", "[tet_overlap]") {
  const std::vector<Corners> one = tets_of(box_tets(Vec3(1, 2, 0.5), {2, 3, 2})), other = tets_of(box_tets(Vec3(1, 2, 0.5), {3, 2, 1}));
  std::vector<double> of_one(one.size(), 0), of_other(other.size(), 0);
  int last = -1;
  for (const TetOverlap& o : tet_overlaps(one, other)) {
    CHECK(o.one >= last);
    last = o.one;
    of_one[o.one] += o.volume;
    of_other[o.other] += o.volume;
  }
  for (size_t t = 0; t < one.size(); ++t) CHECK(of_one[t] == Approx(volume(one[t])).epsilon(1e-12));
  for (size_t t = 0; t < other.size(); ++t) CHECK(of_other[t] == Approx(volume(other[t])).epsilon(1e-12));
}
