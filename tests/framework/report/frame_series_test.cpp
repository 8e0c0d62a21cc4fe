#include "framework/report/frame_series.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "framework/output/pvd.hpp"
#include "framework/output/vtu.hpp"
#include "tests/support/program.hpp"

using namespace tack;

namespace {

// Two tets that share a face, of different objects, a sheet, a rod and a particle.
FrameGeometry geometry() {
  FrameGeometry g;
  g.vertices = 11;
  g.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  g.triangles = {{5, 6, 7}};
  g.edges = {{8, 9}};
  g.points = {10};
  g.cell_object = {0, 1, 2, 3, 4};
  return g;
}

VecX places(double t) {
  VecX x = VecX::Zero(33);
  const std::vector<Vec3> at = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {3, 0, 0}, {4, 0, 0}, {3, 1, 0}, {5, 0, 0}, {6, 0, 0}, {7, 0, 0}};
  for (size_t v = 0; v < at.size(); ++v) x.segment<3>(3 * static_cast<Eigen::Index>(v)) = at[v] + Vec3(0, t, 0);
  return x;
}

struct Run {
  explicit Run(int frames) {
    std::filesystem::create_directory(folder.path() / "frames");
    PvdFile list(folder.path() / "run.pvd");
    for (int i = 0; i < frames; ++i) {
      const std::string name = "frames/f" + std::to_string(i) + ".vtu";
      VecX velocity = VecX::Zero(33);
      velocity.segment<3>(30) = Vec3(0, 3, 4) * i;
      write_vtu(folder.path() / name, geometry(), places(0.1 * i), 0.5 * i, {{"velocity", 3, velocity, "m/s"}},
                {{"stress", VecX::LinSpaced(5, 1, 5), "Pa"}});
      list.add(0.5 * i, name);
    }
  }
  TemporaryFolder folder;
};

}  // namespace

TEST_CASE("a page shows outer faces, sheets, rods and particles, each with its object") {
  const Run run(2);
  const FrameSeries series = read_frames(run.folder.path(), 0);
  REQUIRE(series.triangles.size() == 3 * 7);  // 2 x 3 outer faces, and the sheet
  CHECK(series.edges.size() == 2);
  CHECK(series.points.size() == 1);
  CHECK(series.object == std::vector<int>{0, 0, 0, 1, 1, 1, 2, 3, 4});
  CHECK(series.vertices() == 11);
  CHECK(series.times == std::vector<double>{0, 0.5});
  CHECK(series.written == 2);
  CHECK(series.notes.empty());
  // No face has the opposite vertices of both tets, which the inner face separates.
  const auto place = [&](int v, int frame) {
    const auto& x = series.positions[frame];
    return Vec3(series.origin + Vec3(x[v], x[11 + v], x[22 + v]));
  };
  std::set<std::pair<double, double>> rod;
  for (const int v : series.edges) rod.emplace(place(v, 1).x(), place(v, 1).y());
  CHECK(rod.begin()->first == Approx(5));
  CHECK(rod.rbegin()->first == Approx(6));
  CHECK(rod.begin()->second == Approx(0.1).margin(1e-6));
}

TEST_CASE("fields of frames are unchanged, vectors are replaced by their magnitude") {
  const Run run(3);
  const FrameSeries series = read_frames(run.folder.path(), 0);
  REQUIRE(series.fields.size() == 2);
  const auto& speed = series.fields[0];
  CHECK(speed.name == "velocity");
  CHECK(speed.unit == "m/s");
  CHECK(speed.magnitude);
  REQUIRE(speed.frames.size() == 3);
  CHECK(speed.frames[2][static_cast<size_t>(series.points[0])] == 10.0f);
  const auto& stress = series.fields[1];
  CHECK_FALSE(stress.of_vertices);
  CHECK(stress.unit == "Pa");
  CHECK(stress.frames[0] == std::vector<float>{1, 1, 1, 2, 2, 2, 3, 4, 5});
}

TEST_CASE("frames are thinned evenly and keep both ends") {
  const Run run(11);
  CHECK(read_frames(run.folder.path(), 3).times == std::vector<double>{0, 2.5, 5});
  CHECK(read_frames(run.folder.path(), 1).times == std::vector<double>{5});
  CHECK(read_frames(run.folder.path(), 100).times.size() == 11);
  CHECK(read_frames(run.folder.path(), 4).written == 11);
}

TEST_CASE("a damaged frame ends the series with a note") {
  const Run run(4);
  write_file(run.folder.path() / "frames/f2.vtu", "no frame");
  const FrameSeries series = read_frames(run.folder.path(), 0);
  CHECK(series.times == std::vector<double>{0, 0.5});
  REQUIRE(series.notes.size() == 1);
  CHECK(contains(series.notes[0], "f2.vtu"));
}

TEST_CASE("a frame of another mesh ends the series with a note") {
  const Run run(2);
  FrameGeometry other = geometry();
  other.triangles = {{5, 6, 8}};
  write_vtu(run.folder.path() / "frames/f1.vtu", other, places(0), 0.5, {{"velocity", 3, VecX::Zero(33), "m/s"}}, {{"stress", VecX::Zero(5), "Pa"}});
  const FrameSeries series = read_frames(run.folder.path(), 0);
  CHECK(series.times.size() == 1);
  REQUIRE(series.notes.size() == 1);
  CHECK(contains(series.notes[0], "differs from that of the first frame"));
}

TEST_CASE("the series continues for an object that is remeshed inside, with an equal surface") {
  // A tet of four, around a vertex inside, and a particle; then one tet alone.
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "frames");
  PvdFile list(folder.path() / "run.pvd");
  const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto write = [&](int number, const std::vector<Vec3>& inside, std::vector<Tet> tets) {
    FrameGeometry g;
    std::vector<Vec3> at = corners;
    at.insert(at.end(), inside.begin(), inside.end());
    at.push_back(Vec3(5, 0, number));
    g.vertices = static_cast<int>(at.size());
    g.cell_object.assign(tets.size(), 0);
    g.cell_object.push_back(1);
    g.tets = std::move(tets);
    g.points = {g.vertices - 1};
    VecX x(3 * g.vertices);
    for (int v = 0; v < g.vertices; ++v) vertex(x, v) = at[v];
    const std::string name = "frames/f" + std::to_string(number) + ".vtu";
    write_vtu(folder.path() / name, g, x, number, {{"mass", 1, VecX::LinSpaced(g.vertices, 1, g.vertices), "kg"}},
              {{"stress", VecX::LinSpaced(g.cells(), 1, g.cells()), "Pa"}});
    list.add(number, name);
  };
  write(0, {Vec3(0.2, 0.2, 0.2)}, {{4, 1, 2, 3}, {0, 4, 2, 3}, {0, 1, 4, 3}, {0, 1, 2, 4}});
  write(1, {}, {{0, 1, 2, 3}});
  const FrameSeries series = read_frames(folder.path(), 0);
  CHECK(series.notes.empty());
  REQUIRE(series.times == std::vector<double>{0, 1});
  CHECK(series.vertices() == 5);
  CHECK(series.triangles.size() == 3 * 4);
  const int n = series.vertices();
  for (int v = 0; v < n - 1; ++v)
    for (int c = 0; c < 3; ++c) CHECK(series.positions[1][c * n + v] == series.positions[0][c * n + v]);
  CHECK(series.positions[1][2 * n + series.points[0]] - series.positions[0][2 * n + series.points[0]] == Approx(1));
  CHECK(series.fields[0].frames[0][static_cast<size_t>(series.points[0])] == 6.0f);
  CHECK(series.fields[0].frames[1][static_cast<size_t>(series.points[0])] == 5.0f);
  CHECK(series.fields[1].frames[0] == std::vector<float>{1, 2, 3, 4, 5});
  CHECK(series.fields[1].frames[1] == std::vector<float>{1, 1, 1, 1, 2});
}
