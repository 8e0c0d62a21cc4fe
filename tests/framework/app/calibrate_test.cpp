// tack calibrate from the command line: its results, no repeated runs, no dependence on jobs or
// interruptions, and its errors.
#include <catch2/catch.hpp>
#include <map>
#include <thread>

#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

const fs::path shipped = fs::path(TACK_SOURCE_DIR) / "experiments/calibration";

// The shipped pull with fewer points: enough to be right, few enough to be quick.
std::string pull_fit(const std::string& more = "", const std::string& search = "{design: 12, chains: 2}") {
  return "name: pull_fit\nexperiments:\n  - {base: " + (shipped / "pull.yaml").string() + ", set: [time.step=50 ms], data: " + (shipped / "pull.csv").string() +
         ", x: way, y: force, noise: 2%" + more + "}\nfit:\n"
         "  strength: {keys: contact.pairs.0.adhesion.peak_traction, from: 3 kPa, to: 50 kPa, start: 30 kPa}\n"
         "  work: {keys: contact.pairs.0.adhesion.work_of_adhesion, from: 0.3 J/m^2, to: 3 J/m^2, start: 0.4 J/m^2}\n"
         "search: " + search + "\n";
}

struct Place {
  explicit Place(const std::string& text = pull_fit()) { write_file(path / "fit.yaml", text); }
  ProgramResult run(Arguments more = {}) const {
    Arguments all{"calibrate", "fit.yaml"};
    all.insert(all.end(), more.begin(), more.end());
    return run_tack(path, all);
  }
  std::string error(const std::string& text) const {
    write_file(path / "fit.yaml", text);
    const ProgramResult result = run({"-o", "wrong"});
    CHECK(result.exit_code == 2);
    return result.err;
  }

  TemporaryFolder folder;
  fs::path path = folder.path();
};

nlohmann::json json_of(const fs::path& folder) { return parse_json(file_text(folder / "calibration.json")); }

// When the runs that are done were written.
std::map<std::string, fs::file_time_type> done_runs(const fs::path& folder) {
  std::map<std::string, fs::file_time_type> times;
  if (!fs::exists(folder / "evaluations/state")) return times;
  for (const auto& entry : fs::directory_iterator(folder / "evaluations/state")) {
    if (entry.path().extension() != ".json") continue;  // one that is being written
    const std::string state = file_text(entry.path()), name = entry.path().stem();
    if (contains(state, "\"status\": \"done\"") || contains(state, "\"status\": \"expectation failed\""))
      times[name] = fs::last_write_time(folder / "evaluations/cases" / name / "summary.json");
  }
  return times;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  REQUIRE(at != text.npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("a calibration finds strength and work, writes its results, and evaluates the same points with any number of jobs", "[calibrate]") {
  const Place place;
  const ProgramResult found = place.run({"-o", "one", "--jobs", "1"});
  INFO(found.out << found.err);
  REQUIRE(found.exit_code == 0);
  CHECK(contains(found.out, "strength"));
  CHECK(contains(found.out, "times the noise"));
  const fs::path one = place.path / "one";
  const nlohmann::json result = json_of(one);
  CHECK(result["status"] == "done");
  CHECK(result["numbers"][0]["name"] == "strength");
  CHECK(result["numbers"][0]["value"].get<double>() == Approx(1e4).epsilon(0.03));
  CHECK(result["numbers"][1]["value"].get<double>() == Approx(1).epsilon(0.03));
  for (const auto& number : result["numbers"]) {
    CHECK(number["determined"] == true);
    CHECK(number["low"].get<double>() < number["value"].get<double>());
    CHECK(number["high"].get<double>() > number["value"].get<double>());
  }
  CHECK(result["numbers"][0]["unit"] == "Pa");
  // Steps of 50 ms are an error of the model, beside the noise of the data.
  CHECK(result["fits"] == false);
  CHECK(result["warning_kinds"] == nlohmann::json{entry_of(WarningKind::model_misfit).key});
  CHECK(result["warnings"].size() == 1);
  CHECK(result["runs"]["started"] == result["runs"]["points"]);
  CHECK(result["runs"]["with_derivatives"].get<int>() > 0);
  CHECK(contains(found.out, "sensitivities to strength"));
  CHECK(contains(file_text(one / "evaluations.csv"), "number,phase,strength,work,misfit,derivatives,status,error\n1,design,30000,0.4,"));
  CHECK(contains(file_text(one / "calibration.csv"), "\nstrength,Pa,"));
  CHECK(contains(file_text(one / "fits/pull.csv"), "way,measured,simulated\n"));
  CHECK(contains(file_text(one / "evaluations/results.csv"), "case,strength,work,status"));
  for (const char* picture : {"plots/fit_pull.gp", "plots/misfit.gp"}) CHECK(fs::exists(one / picture));

  // The scene with the fitted parameters loads and runs.
  CHECK(run_tack(place.path, {"run", "one/scenes/pull.yaml", "-q", "-o", "again"}).exit_code == 0);
  CHECK(contains(file_text(place.path / "again/scene.yaml"), "peak_traction: " + result["numbers"][0]["value"].dump().substr(0, 4)));

  REQUIRE(place.run({"-o", "two", "--jobs", "3", "-q"}).exit_code == 0);
  CHECK(file_text(place.path / "two/evaluations.csv") == file_text(one / "evaluations.csv"));
  CHECK(file_text(place.path / "two/calibration.csv") == file_text(one / "calibration.csv"));

  // A second call runs nothing; with other data of the experiment, it runs only new points.
  const auto times = done_runs(one);
  REQUIRE(place.run({"-o", "one", "-q"}).exit_code == 0);
  CHECK(json_of(one)["runs"]["started"] == 0);
  CHECK(done_runs(one) == times);
  CHECK(json_of(one)["numbers"] == result["numbers"]);
}

TEST_CASE("a calibration that is killed and called again repeats no run that was done", "[calibrate]") {
  const Place place;
  REQUIRE(place.run({"-o", "whole", "-q"}).exit_code == 0);
  std::map<std::string, fs::file_time_type> before;
  const size_t all = done_runs(place.path / "whole").size();
  for (const size_t runs : {size_t{3}, size_t{14}, size_t{25}, all - 1}) {  // in the design, in chains, in the polish
    Program program(place.path, {"calibrate", "fit.yaml", "-o", "parts", "-q"});
    for (int i = 0; i < 12000 && done_runs(place.path / "parts").size() < runs; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    program.kill();
    program.wait();
    for (const auto& [name, time] : before) CHECK(done_runs(place.path / "parts").at(name) == time);
    before = done_runs(place.path / "parts");
    CHECK(before.size() >= runs);
  }
  REQUIRE(place.run({"-o", "parts", "-q"}).exit_code == 0);
  const auto after = done_runs(place.path / "parts");
  for (const auto& [name, time] : before) CHECK(after.at(name) == time);
  CHECK(after.size() == done_runs(place.path / "whole").size());
  CHECK(json_of(place.path / "parts")["runs"]["started"].get<size_t>() == after.size() - before.size());
  CHECK(file_text(place.path / "parts/evaluations.csv") == file_text(place.path / "whole/evaluations.csv"));
}

// Which expressions of them need, and tables say.
TEST_CASE("parameters of a scene and of its laws are fitted in their units", "[calibrate]") {
  const std::string pull = file_text(shipped / "pull.yaml");
  const std::string law = "adhesion: {type: bilinear, peak_traction: 10 kPa, work_of_adhesion: 1 J/m^2}";
  const auto fit = [](const std::string& key) {
    return replaced(replaced(pull_fit("", "{design: 2, chains: 1, evaluations: 4}"), (shipped / "pull.yaml").string(), "scene.yaml"), "contact.pairs.0.adhesion.peak_traction", key);
  };
  const Place place(fit("peak"));
  write_file(place.path / "scene.yaml", replaced(pull, law, "adhesion: {type: bilinear, peak_traction: 0.5 * peak + s, work_of_adhesion: 1 J/m^2}") +
                                            "parameters: {peak: 10 kPa, s: 5 kPa}\n");
  const ProgramResult found = place.run({"-o", "found"});
  INFO(found.out << found.err);
  REQUIRE(found.exit_code == 0);
  CHECK(contains(file_text(place.path / "found/calibration.csv"), "strength,Pa,"));
  CHECK(contains(file_text(place.path / "found/scenes/pull.yaml"), "kg m^-1 s^-2"));

  write_file(place.path / "scene.yaml", replaced(replaced(replaced(pull, "      bond_distance: 1.1 mm\n", ""), "distance: 1 mm", "distance: 0.05 mm"), law, "adhesion: {type: expression, traction: s * d / l * exp(1 - d / l), "
                                                                                                       "parameters: {s: 10 kPa, l: 0.2 mm}, range: 4 mm}"));
  write_file(place.path / "fit.yaml", replaced(fit("contact.pairs.0.adhesion.parameters.s"), "work: {keys: contact.pairs.0.adhesion.work_of_adhesion, from: 0.3 J/m^2, to: 3 J/m^2, start: 0.4 J/m^2}",
                                               "l: {keys: contact.pairs.0.adhesion.parameters.l, from: 0.1 mm, to: 0.5 mm}"));
  const ProgramResult dry = place.run({"--dry-run"});
  INFO(dry.out << dry.err);
  CHECK(contains(dry.out, "strength from 3000 to 50000 Pa"));
  CHECK(contains(dry.out, "l from 0.0001 to 0.0005 m"));
}

TEST_CASE("an interrupted calibration ends with 130 and can be continued", "[calibrate]") {
  const Place place(pull_fit("", "{design: 6, chains: 0, polish: false}"));
  Program program(place.path, {"calibrate", "fit.yaml", "-o", "parts"});
  for (int i = 0; i < 12000 && done_runs(place.path / "parts").empty(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  program.interrupt();
  const ProgramResult result = program.wait();
  INFO(result.out << result.err);
  if (result.exit_code != 0) {  // it may have been done
    CHECK(result.exit_code == 130);
    CHECK(contains(result.out, "call it again to continue"));
    CHECK(contains(file_text(place.path / "parts/calibration.json"), "\"running\""));
  }
  CHECK(place.run({"-o", "parts"}).exit_code == 0);
}

TEST_CASE("two experiments share a number; runs that fail count as bad, and as the end only if all do", "[calibrate]") {
  const std::string pull = (shipped / "pull.yaml").string();
  const std::string two = "name: both\nexperiments:\n"
      "  - {name: strong, base: " + pull + ", set: [time.step=50 ms], data: " + (shipped / "pull.csv").string() + ", x: way, y: force, noise: 2%}\n"
      "  - {name: weak, base: " + pull + ", set: [time.step=50 ms, \"contact.pairs.0.adhesion.peak_traction=5 kPa\"], data: " + (shipped / "pull_weak.csv").string() +
      ", x: way, y: force, noise: 20 mN}\nfit:\n"
      "  contact.pairs.0.adhesion.work_of_adhesion: {from: 0.3, to: 3}\n"
      "  strength: {keys: {strong: contact.pairs.0.adhesion.peak_traction}, from: 5 kPa, to: 20 kPa}\n"
      "search: {design: 6, chains: 1, evaluations: 30}\n";
  const Place place(two);
  const ProgramResult found = place.run({"-o", "both"});
  INFO(found.out << found.err);
  REQUIRE(found.exit_code == 0);
  const nlohmann::json result = json_of(place.path / "both");
  CHECK(result["numbers"][0]["name"] == "work_of_adhesion");
  CHECK(result["numbers"][0]["value"].get<double>() == Approx(1).epsilon(0.03));
  CHECK(result["numbers"][1]["value"].get<double>() == Approx(1e4).epsilon(0.03));
  CHECK(result["numbers"][1]["keys"]["weak"].empty());
  CHECK(contains(file_text(place.path / "both/evaluations.csv"), "misfit,misfit:strong,misfit:weak,derivatives,status"));
  CHECK(fs::exists(place.path / "both/scenes/weak.yaml"));

  // Work and strength that do not go together are refused by the law, and cost nothing but their points.
  const std::string wide = replaced(pull_fit("", "{design: 8, chains: 1, evaluations: 12, polish: false}"), "to: 50 kPa", "to: 200 kPa");
  write_file(place.path / "fit.yaml", replaced(wide, "time.step=50 ms]", "time.step=50 ms, contact.pairs.0.adhesion.onset=20 um]"));
  const ProgramResult some = place.run({"-o", "some"});
  INFO(some.out << some.err);
  CHECK(some.exit_code == 0);
  CHECK(contains(file_text(place.path / "some/evaluations.csv"), ",refused,"));
  CHECK(contains(some.out, "evaluations failed; evaluations.csv"));
  write_file(place.path / "fit.yaml", pull_fit("", "{design: 3, chains: 1}") + "time_limit: 1 ms\n");
  const ProgramResult none = place.run({"-o", "none"});
  CHECK(none.exit_code == 3);
  CHECK(contains(none.err, "all 3 evaluations of the initial design failed; the first one: timed out"));
}

TEST_CASE("errors of a calibration are reported before anything runs", "[calibrate]") {
  const Place place;
  const std::string good = pull_fit();
  const auto error = [&](const std::string& what, const std::string& by) { return place.error(replaced(good, what, by)); };
  CHECK_THAT(error("y: force", "y: forse"), Catch::Contains("experiment 'pull': y: the experiment has no probe 'forse'; did you mean 'force'?"));
  CHECK_THAT(error("x: way", "x: gap"), Catch::Contains("x: the experiment has no probe 'gap'"));
  CHECK_THAT(error("pull.csv", "lost.csv"), Catch::Contains("lost.csv"));
  CHECK_THAT(error("adhesion.peak_traction", "adhesion.peak_tracton"), Catch::Contains("fit 'strength': the scene has no key 'contact.pairs.0.adhesion.peak_tracton' "
                                                                                       "(it has 'contact.pairs.0.adhesion')"));
  CHECK_THAT(error("contact.pairs.0.adhesion.peak_traction", "contact.pairs.0.adhesion"), Catch::Contains("and not a number"));
  CHECK_THAT(error("from: 3 kPa", "from: 3 N"), Catch::Contains("fit 'strength': from: ") && Catch::Contains("'3 N'"));
  CHECK_THAT(error("from: 3 kPa", "from: 60 kPa"), Catch::Contains("must be below to"));
  CHECK_THAT(error("start: 30 kPa", "start: 60 kPa"), Catch::Contains("the start is not between from and to"));
  CHECK_THAT(error("noise: 2%", "noise: 2 mm"), Catch::Contains("experiment 'pull': ") && Catch::Contains("'2 mm'"));
  CHECK_THAT(error("noise: 2%", "noise: 2"), Catch::Contains("noise: '2' is 2 N, and the largest measured value is") && Catch::Contains("written with %"));
  const std::string same = ", base: " + (shipped / "pull.yaml").string() + ", data: " + (shipped / "pull.csv").string() + ", x: way, y: force, noise: 2%}\n";
  CHECK_THAT(error("experiments:\n", "experiments:\n  - {name: pul<l" + same + "  - {name: pul>l" + same), Catch::Contains("the files of the experiments 'pul<l' and 'pul>l' would have the same names"));
  CHECK_THAT(error("experiments:\n", "experiments:\n  - {name: pull_run" + same), Catch::Contains("the files of the experiments 'pull_run' and 'pull' would have the same names"));
  CHECK_THAT(error("work: {", "strength: {"), Catch::Contains("strength"));
  CHECK_THAT(error("work: {", "work: {as: strength, "), Catch::Contains("two parameters are named 'strength'"));
  CHECK_THAT(error("keys: contact.pairs.0.adhesion.work_of_adhesion", "keys: {pul: a}"), Catch::Contains("there is no experiment 'pul'; did you mean 'pull'?"));
  CHECK_THAT(error("design: 12", "desing: 12"), Catch::Contains("design"));
  write_file(place.path / "units.csv", "way [mm], force [mm]\n0.1, 2\n");
  CHECK_THAT(error((shipped / "pull.csv").string(), "units.csv"), Catch::Contains("units.csv:1: ") && Catch::Contains("column 'force'"));
  write_file(place.path / "late.csv", "time [s], force [N]\n0.1, 2\n1.5, 1\n");
  CHECK_THAT(place.error(replaced(replaced(good, (shipped / "pull.csv").string(), "late.csv"), "x: way", "x: time")),
             Catch::Contains("late.csv:3: was measured at 1.5 s, and the run goes from 0 to 1 s"));
  CHECK_FALSE(fs::exists(place.path / "wrong"));
  write_file(place.path / "fit.yaml", good);
  CHECK(contains(run_tack(place.path, {"run", "fit.yaml"}).err, "is a calibration, not a scene; call `tack calibrate"));
  const ProgramResult dry = place.run({"--dry-run"});
  CHECK(dry.exit_code == 0);
  CHECK(contains(dry.out, "strength from 3000 to 50000 Pa, first 30000, logarithmic"));
  CHECK(contains(dry.out, "nothing was run yet"));
}
