// Reports of folders as one file: kinds of folders, combinations, errors, and texts that must not
// end a script. See tests/report/ for tests of the page in a browser.
#include "framework/report/report.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

struct ReportFixture {
  ReportFixture() { write_file(page, "<html><!--data of the report--></html>"); }

  fs::path run(const std::string& name, const std::string& scene = "") const {
    fs::create_directories(folder.path() / name);
    write_file(folder.path() / name / "steps.csv", "step,time,min_distance\n1,0.1,0.5\n2,0.2,inf\n");
    if (!scene.empty()) write_file(folder.path() / name / "scene.yaml", scene);
    return folder.path() / name;
  }
  WrittenReport report(const std::vector<fs::path>& folders, const std::vector<std::string>& cases = {}) const {
    ReportSettings settings;
    settings.folders = folders;
    settings.output = folder.path() / "out.html";
    settings.page = page;
    settings.cases = cases;
    return write_report(settings);
  }
  std::string html() const { return file_text(folder.path() / "out.html"); }
  nlohmann::json data() const {
    const std::string text = html(), start = "id=\"data\">";
    const size_t from = text.find(start) + start.size();
    return parse_json(text.substr(from, text.find("</script>", from) - from));
  }
  fs::path batch() const {
    const fs::path root = folder.path() / "batch";
    fs::create_directories(root / "cases/a");
    write_file(root / "cases/a/probes.csv", "time,gap\n0,1\n1,2\n");
    write_file(root / "cases/a/steps.csv", "step,time\n1,0.1\n");
    write_file(root / "batch.json", R"({"name": "b", "keys": ["k"], "cases": [{"name": "a", "folder": "cases/a", "values": {"k": 1}, "status": "done"},
      {"name": "lost", "folder": "cases/lost", "values": {"k": 2}, "status": "failed"}]})");
    write_file(root / "results.csv", "case,k,status,expect:e,gap.max\na,1,done,1,2\n\"lost\",2,failed,,\n");
    return root;
  }

  fs::path calibration() const {
    const fs::path root = folder.path() / "calibration";
    fs::create_directories(root / "fits");
    write_file(root / "calibration.json", R"({"name": "c", "status": "done", "experiments": [{"name": "a", "fit": "fits/a.csv", "run": "fits/a_run.csv"},
      {"name": "b", "fit": "fits/b.csv", "run": "fits/b_run.csv"}]})");
    write_file(root / "fits/a.csv", "way,measured,simulated\n0,1,2\n1,2,3\n");
    write_file(root / "fits/a_run.csv", "way,simulated\n0,damaged\n");
    write_file(root / "evaluations.csv", "number,phase,strength,misfit,status,error\n1,design,5,0.5,done,\n2,design,7,,refused,no\n");
    return root;
  }

  TemporaryFolder folder;
  fs::path page = folder.path() / "page.html";
};

}  // namespace

TEST_CASE("the files of a folder determine its kind: run, comparison or batch") {
  const ReportFixture fixture;
  CHECK(kind_of(fixture.run("run")) == FolderKind::run);
  CHECK(kind_of(fixture.batch()) == FolderKind::batch);
  CHECK(kind_of(fixture.calibration()) == FolderKind::calibration);
  fs::create_directory(fixture.folder.path() / "compared");
  write_file(fixture.folder.path() / "compared/compare.csv", "problem\n");
  CHECK(kind_of(fixture.folder.path() / "compared") == FolderKind::comparison);
  fs::create_directory(fixture.folder.path() / "empty");
  CHECK_THROWS_WITH(kind_of(fixture.folder.path() / "empty"), Catch::Contains("is not a results folder"));
  CHECK_THROWS_WITH(kind_of(fixture.folder.path() / "none"), Catch::Contains("no such folder"));
}

TEST_CASE("an unfinished run has a report of its existing files") {
  const ReportFixture fixture;
  const WrittenReport written = fixture.report({fixture.run("run", tiny_scene)});
  CHECK(written.notes.empty());
  const auto run = fixture.data()["runs"][0];
  CHECK(fixture.data()["kind"] == "run");
  CHECK(run["label"] == "run");
  CHECK(run["status"] == "unfinished");
  CHECK(run["summary"].is_null());
  CHECK(run["frames"].is_null());
  CHECK(run["probes"].is_null());
  CHECK(run["steps"]["rows"] == 2);
  CHECK(run["scene"]["name"] == "tiny");
  CHECK(run["scene"]["up"] == std::vector<double>{0, 1, 0});
  CHECK(run["scene"]["objects"][1]["name"] == "block");
  CHECK(run["scene"]["probes"][1]["column"] == "stickiness_x");
  CHECK(run["scene"]["probes"][1]["unit"] == "N");
  CHECK(run["scene"]["probes"][1]["on"] == "block");
  CHECK(run["scene"]["expect"].size() == 1);
  CHECK(contains(fixture.html(), "<script type=\"text/plain\" id=\"block-0\">"));
}

TEST_CASE("unreadable files are reported, and the others are shown") {
  const ReportFixture fixture;
  const fs::path run = fixture.run("run", "name: [");
  write_file(run / "summary.json", "{\"status\": ");
  write_file(run / "probes.csv", "time,gap\n0,wide\n");
  const WrittenReport written = fixture.report({run});
  CHECK(written.notes.size() == 3);
  CHECK(fixture.data()["runs"][0]["notes"].size() == 3);
  CHECK(fixture.data()["runs"][0]["steps"]["rows"] == 2);
}

TEST_CASE("texts of a scene do not end the data of a report") {
  const ReportFixture fixture;
  const std::string evil = "</script><b>\\\"&<!--";
  fixture.report({fixture.run("run", tiny_scene_with("name: tiny", "name: '" + evil + "'\nabout: '" + evil + "'"))});
  CHECK(fixture.data()["runs"][0]["scene"]["name"] == evil);
  const std::string html = fixture.html();
  size_t ends = 0, begins = 0;
  for (size_t at = 0; (at = html.find("</script", at)) != html.npos; ++at) ++ends;
  for (size_t at = 0; (at = html.find("<script", at)) != html.npos; ++at) ++begins;
  CHECK(ends == begins);
  CHECK_FALSE(contains(html, "<b>"));
  CHECK_FALSE(contains(html, "<!--"));
}

TEST_CASE("labels of runs with equal names differ by their folders") {
  const ReportFixture fixture;
  fixture.report({fixture.run("one/x"), fixture.run("two/x/")});
  const auto data = fixture.data();
  CHECK(data["kind"] == "runs");
  CHECK(data["runs"][0]["label"] == "one/x");
  CHECK(data["runs"][1]["label"] == "two/x");
}

TEST_CASE("a batch has its table, the probes of its cases, and the requested runs") {
  const ReportFixture fixture;
  const WrittenReport written = fixture.report({fixture.batch()}, {"a"});
  CHECK(written.notes.empty());
  const auto data = fixture.data();
  CHECK(data["kind"] == "batch");
  const auto& batch = data["batch"];
  CHECK(batch["batch"]["keys"][0] == "k");
  CHECK(batch["table"]["columns"][3] == "expect:e");
  CHECK(batch["table"]["rows"][0] == nlohmann::json::array({"a", 1.0, "done", 1.0, 2.0}));
  CHECK(batch["table"]["rows"][1] == nlohmann::json::array({"lost", 2.0, "failed", nullptr, nullptr}));
  CHECK(batch["curves"][0]["rows"] == 2);
  CHECK(batch["curves"][1].is_null());
  CHECK(data["runs"][0]["label"] == "a");
  CHECK_THROWS_WITH(fixture.report({fixture.batch()}, {"z"}), Catch::Contains("has no case 'z'"));
}

TEST_CASE("long tables keep every k-th row and the last") {
  const ReportFixture fixture;
  const fs::path run = fixture.run("run");
  std::string text = "step,time\n";
  for (int i = 0; i < 50001; ++i) text += std::to_string(i) + ",0.5\n";
  write_file(run / "steps.csv", text);
  fixture.report({run});
  const auto steps = fixture.data()["runs"][0]["steps"];
  CHECK(steps["of"] == 50001);
  CHECK(steps["rows"] == 16668);
}

TEST_CASE("incompatible folders, missing pages and missing files are refused") {
  const ReportFixture fixture;
  CHECK_THROWS_WITH(fixture.report({fixture.batch(), fixture.run("run")}), Catch::Contains("or of one comparison, suite, batch or calibration"));
  CHECK_THROWS_WITH(fixture.report({fixture.run("run")}, {"a"}), Catch::Contains("--case is for a batch"));
  ReportSettings settings;
  settings.folders = {fixture.run("run")};
  settings.page = fixture.page;
  settings.output = fixture.folder.path() / "none/out.html";
  CHECK_THROWS_WITH(write_report(settings), Catch::Contains("cannot be written"));
  settings.page = fixture.folder.path() / "none.html";
  CHECK_THROWS_WITH(write_report(settings), Catch::Contains("is not built"));
  write_file(fixture.folder.path() / "batch/batch.json", "[]");
  CHECK_THROWS_WITH(fixture.report({fixture.folder.path() / "batch"}), Catch::Contains("has no list of cases"));
}

TEST_CASE("tack report on the command line") {
  const ReportFixture fixture;
  CHECK(run_tack(fixture.folder.path(), {"report"}).exit_code == 2);
  const ProgramResult none = run_tack(fixture.folder.path(), {"report", "nowhere"});
  CHECK(none.exit_code == 2);
  CHECK(contains(none.err, "nowhere: there is no such folder"));
}

TEST_CASE("a report of a calibration has its evaluations and curves, and reports unreadable files") {
  const ReportFixture fixture;
  const WrittenReport written = fixture.report({fixture.calibration()});
  REQUIRE(written.notes.size() == 1);
  CHECK(contains(written.notes[0], "a_run.csv"));
  const nlohmann::json data = fixture.data()["calibration"];
  CHECK(fixture.data()["kind"] == "calibration");
  CHECK(data["calibration"]["name"] == "c");
  CHECK(data["table"]["rows"][0][3] == 0.5);
  CHECK(data["table"]["rows"][1][3].is_null());
  CHECK(data["fits"][0]["fit"]["columns"][1] == "measured");
  CHECK(data["fits"][0]["run"].is_null());
  CHECK(data["fits"][1]["fit"].is_null());
  write_file(fixture.folder.path() / "calibration/calibration.json", R"({"name": "c", "status": "running"})");
  CHECK(contains(fixture.report({fixture.folder.path() / "calibration"}).notes[0], "is unfinished"));
  CHECK_THROWS_AS(fixture.report({fixture.folder.path() / "calibration", fixture.batch()}), InputError);
}
