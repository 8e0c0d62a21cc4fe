#include <catch2/catch.hpp>

#include "framework/export/run_shapes.hpp"
#include "framework/output/pvd.hpp"
#include "framework/output/vtu.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"

using namespace tack;

namespace {

// Writes a frame of a tetrahedron that is divided at an inner vertex. moved: whether the inner vertex comes first, as after remeshing.
void write_frame(const std::filesystem::path& run, PvdFile& list, double time, bool moved, double shift) {
  FrameGeometry g;
  g.vertices = 5;
  std::vector<Vec3> x = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int first = moved ? 1 : 0, inner = moved ? 0 : 4;
  x.insert(x.begin() + inner, Vec3::Constant(0.25));
  const auto v = [&](int i) { return i + first; };
  g.tets = {{v(0), v(1), v(2), inner}, {v(0), v(3), v(1), inner}, {v(0), v(2), v(3), inner}, {v(1), v(3), v(2), inner}};
  for (Tet& t : g.tets) std::swap(t[0], t[1]);
  g.cell_object = {0, 0, 0, 0};
  VecX all(15);
  for (int i = 0; i < 5; ++i) all.segment<3>(3 * i) = x[i] + Vec3(shift, 0, 0);
  const auto file = std::filesystem::path("frames") / (moved ? "b.vtu" : "a.vtu");
  write_vtu(run / file, g, all, time, {});
  list.add(time, file);
}

}  // namespace

TEST_CASE("an object that was meshed anew keeps its outer vertices in their order") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "frames");
  write_file(folder.path() / "scene.yaml", "name: flow\ntime: {step: 1 s, duration: 1 s}\nobjects: [{name: tet, shape: {type: box, size: [1, 1, 1]}, motion: [fixed]}]\n");
  PvdFile list(folder.path() / "run.pvd");
  write_frame(folder.path(), list, 0, false, 0);
  write_frame(folder.path(), list, 1, true, 2);
  ShapeSelection half;
  half.fps = 2;
  const RunShapes run(folder.path(), half, [](const std::vector<std::string>& names) { CHECK(names == std::vector<std::string>{"tet"}); });
  REQUIRE(run.objects().size() == 1);
  CHECK(run.objects()[0].vertices == 4);
  CHECK(run.objects()[0].face_sizes == std::vector<int>{3, 3, 3, 3});
  REQUIRE(run.times().size() == 3);
  int samples = 0;
  run.visit([&](int sample, const ObjectPositions& x) {
    CHECK(sample == samples++);
    const Vec3 shift(sample, 0, 0);  // 2 m in two samples
    REQUIRE(x[0].size() == 4);
    CHECK(x[0][0] == shift);
    CHECK(x[0][1] == Vec3(1, 0, 0) + shift);
    CHECK(x[0][2] == Vec3(0, 1, 0) + shift);
    CHECK(x[0][3] == Vec3(0, 0, 1) + shift);
  });
  CHECK(samples == 3);
}

TEST_CASE("a frame of another surface ends an export with its name, and nothing is left behind") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "frames");
  write_file(folder.path() / "scene.yaml", "name: flow\ntime: {step: 1 s, duration: 1 s}\nobjects: [{name: tet, shape: {type: box, size: [1, 1, 1]}, motion: [fixed]}]\n");
  PvdFile list(folder.path() / "run.pvd");
  write_frame(folder.path(), list, 0, false, 0);
  FrameGeometry g;
  g.vertices = 3;
  g.triangles = {{0, 1, 2}};
  g.cell_object = {0};
  VecX x(9);
  x << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  write_vtu(folder.path() / "frames" / "c.vtu", g, x, 1, {});
  list.add(1, std::filesystem::path("frames") / "c.vtu");
  const ProgramResult result = run_tack(folder.path(), {"export", ".", "--to", "pc2"});
  CHECK(result.exit_code == 2);
  CHECK(contains(result.err, "c.vtu: object 'tet' has 3 outer vertices, and 4 in the first frame"));
  CHECK(std::filesystem::is_empty(folder.path() / "export" / "pc2"));
}
