#include "framework/view/run_news.hpp"

#include <catch2/catch.hpp>

#include "framework/output/csv.hpp"
#include "framework/output/vtu.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

struct Written {
  Written() : steps(folder.path() / "steps.csv", {{"step", "time"}, {}}), list(folder.path() / "run.pvd") { fs::create_directory(folder.path() / "frames"); }

  void step(int number) { steps.add(std::vector<double>{double(number), 0.1 * number}); }
  void frame(int number) {
    FrameGeometry geometry;
    geometry.vertices = 3;
    geometry.triangles = {{0, 1, 2}};
    geometry.cell_object = {0};
    VecX x(9);
    x << 0, 0, 0, 1, 0, 0, 0, 1, 0.1 * number;
    const std::string name = "frames/f" + std::to_string(number) + ".vtu";
    write_vtu(folder.path() / name, geometry, x, 0.1 * number, {{"speed", 1, VecX::Constant(3, number), "m/s"}});
    list.add(0.1 * number, name);
  }

  TemporaryFolder folder;
  CsvFile steps;
  PvdFile list;
};

}  // namespace

TEST_CASE("news of a run are the rows and frames that the page lacks, with the elements in the first") {
  Written run;
  RunNews news(run.folder.path());
  CHECK(news.generation() == 0);
  auto first = news.since({}, true);
  CHECK_FALSE(first.contains("steps"));
  CHECK_FALSE(first.contains("frames"));
  CHECK_FALSE(first.contains("end"));

  run.frame(0);
  run.step(1);
  run.frame(1);
  first = news.since({}, true);
  CHECK(first["steps"]["next"] == 1);
  CHECK(first["steps"]["rows"].dump() == "[[1.0,0.1]]");
  CHECK(first["frames"]["times"].dump() == "[0.0,0.1]");
  CHECK(first["frames"]["written"] == 2);
  CHECK(first["frames"].contains("triangles"));
  CHECK(first["frames"]["positions"].is_string());

  run.step(2);
  run.step(3);
  run.frame(2);
  const auto next = news.since({1, 0, 2, false}, true);
  CHECK(next["steps"]["rows"].size() == 2);
  CHECK(next["frames"]["times"].dump() == "[0.2]");
  CHECK_FALSE(next["frames"].contains("triangles"));
  CHECK(next["frames"]["fields"][0]["lowest"] == 2);
  CHECK(news.since({3, 0, 3, false}, true).size() == 1);
}

TEST_CASE("the end has the summary once; a damaged frame is left out; another run begins a new generation") {
  Written run;
  RunNews news(run.folder.path());
  run.step(1);
  run.frame(0);
  run.frame(1);
  write_file(run.folder.path() / "frames/f1.vtu", "cut off");
  const auto damaged = news.since({1, 0, 1, true}, false);
  CHECK_FALSE(damaged.contains("frames"));
  run.frame(2);
  CHECK(news.since({1, 0, 1, true}, false)["frames"]["times"].dump() == "[0.2]");

  write_file(run.folder.path() / "summary.json", R"({"status": "done"})");
  CHECK_FALSE(news.since({}, true).contains("end"));
  CHECK(news.since({}, false)["end"]["status"] == "done");
  CHECK_FALSE(news.since({0, 0, 0, true}, false).contains("end"));
  write_file(run.folder.path() / "summary.json", "{");
  CHECK(news.since({}, false)["end"]["status"] == "unfinished");

  const CsvFile another(run.folder.path() / "steps.csv", {{"step", "time"}, {}});
  CHECK(news.generation() == 1);
  CHECK(news.since({}, true)["generation"] == 1);
}
