// Transfer of element data between meshes of the same volume.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "framework/remesh/element_transfer.hpp"
#include "framework/remesh/hencky.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/shapes/solids.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

TetCorners tets_of(const Mesh& mesh) {
  TetCorners all;
  for (const Tet& t : mesh.tets) all.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], mesh.vertices[t[3]]});
  return all;
}

double volume(const std::array<Vec3, 4>& x) { return tet_volume(x[0], x[1], x[2], x[3]); }

struct Sums {
  double volume = 0, flow = 0, square = 0;
  Mat3 strain = Mat3::Zero();
};

Sums sums_of(const std::vector<TetContent>& contents) {
  Sums sums;
  for (const TetContent& c : contents) {
    sums.volume += c.volume;
    sums.flow += c.volume * c.flow;
    sums.strain += c.volume * c.strain;
    sums.square += c.volume * c.strain.squaredNorm();
  }
  return sums;
}

}  // namespace

TEST_CASE("the Hencky strain of a stretch is inverted exactly, for any previous rotation", "[remesh]") {
  RandomMotions random(5);
  const Mat3 f = Mat3::Identity() + 0.3 * Mat3::Identity() + 0.2 * Vec3(1, 2, 3).normalized() * Vec3(0, 1, -1).transpose();
  const Mat3 strain = hencky_strain(f);
  CHECK((strain - strain.transpose()).norm() < 1e-15);
  CHECK(strain.trace() == Approx(std::log(f.determinant())).epsilon(1e-12));
  CHECK((hencky_strain(f * random.rotation()) - strain).norm() < 1e-13);
  CHECK((hencky_strain(stretch_of(strain)) - strain).norm() < 1e-13);
}

TEST_CASE("volumes, strains and plastic strains keep their sums and bounds in a transfer", "[remesh]") {
  const TetCorners from = tets_of(box_tets(Vec3(1, 1, 1), {3, 3, 3})), to = tets_of(box_tets(Vec3(1, 1, 1), {2, 4, 3}));
  RandomMotions random(7);
  std::vector<TetContent> contents;
  double most = 0;
  for (const auto& x : from) {
    const Mat3 any = Mat3::NullaryExpr([&] { return random.uniform(-0.01, 0.01); });
    const double flow = random.uniform(0, 2);
    // Strains on the yield surface of a hardening material: |dev e| = 0.01 (1 + flow).
    Mat3 strain = any + any.transpose();
    const double trace = strain.trace();
    strain -= trace / 3 * Mat3::Identity();
    strain *= 0.01 * (1 + flow) / strain.norm();
    contents.push_back({volume(x) * random.uniform(0.98, 1.02), strain + trace / 3 * Mat3::Identity(), flow});
    most = std::max(most, flow);
  }
  const std::vector<TetContent> handed = transfer_contents(from, contents, to);
  const Sums before = sums_of(contents), after = sums_of(handed);
  CHECK(after.volume == Approx(before.volume).epsilon(1e-12));
  CHECK(after.flow == Approx(before.flow).epsilon(1e-12));
  CHECK((after.strain - before.strain).norm() < 1e-12 * before.strain.norm());
  CHECK(after.square < before.square);  // stored energy decreases
  for (const TetContent& c : handed) {
    CHECK(c.flow <= most);
    CHECK((c.strain - c.strain.trace() / 3 * Mat3::Identity()).norm() <= 0.01 * (1 + c.flow) * (1 + 1e-12));
  }
}

TEST_CASE("uniform fields stay uniform", "[remesh]") {
  const TetCorners from = tets_of(box_tets(Vec3(1, 1, 1), {3, 3, 3})), to = tets_of(box_tets(Vec3(1, 1, 1), {2, 4, 3}));
  const Mat3 strain = Vec3(0.01, -0.02, 0.004).asDiagonal();
  std::vector<TetContent> contents;
  for (const auto& x : from) contents.push_back({volume(x) / 1.1, strain, 0.3});
  const std::vector<TetContent> handed = transfer_contents(from, contents, to);
  for (size_t t = 0; t < to.size(); ++t) {
    CHECK(handed[t].volume == Approx(volume(to[t]) / 1.1).epsilon(1e-12));
    CHECK(handed[t].flow == Approx(0.3).epsilon(1e-13));
    CHECK((handed[t].strain - strain).norm() < 1e-15);
  }
}
