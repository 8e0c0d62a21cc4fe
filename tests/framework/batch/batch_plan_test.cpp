#include "framework/batch/batch_plan.hpp"

#include <catch2/catch.hpp>

#include "framework/batch/batch_run.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

struct Files {
  TemporaryFolder folder;
  Files() { write_file(folder.path() / "tiny.yaml", tiny_scene); }
  BatchPlan plan(const std::string& rest) const {
    write_file(folder.path() / "batch.yaml", "name: b\nbase: tiny.yaml\n" + rest);
    return plan_of(load_batch(folder.path() / "batch.yaml", {}), "program");
  }
};

std::vector<std::string> names_of(const BatchPlan& plan) {
  std::vector<std::string> names;
  for (const BatchCase& one : plan.cases) names.push_back(one.name);
  return names;
}

}  // namespace

TEST_CASE("cases are all combinations of the variants, named after them", "[batch]") {
  const Files files;
  const BatchPlan plan = files.plan(
      "set: [time.duration=0.02 s]\n"
      "vary:\n"
      "  - type: grid\n"
      "    keys: {objects.block.energies.0.young: [1 MPa, 2e6], contact.friction.mu: {values: [0.1], as: mu}}\n"
      "  - {type: repeat, count: 2}\n");
  CHECK(names_of(plan) == std::vector<std::string>{"young=1MPa,mu=0.1,repeat=1", "young=1MPa,mu=0.1,repeat=2",
                                                   "young=2e6,mu=0.1,repeat=1", "young=2e6,mu=0.1,repeat=2"});
  CHECK(plan.columns == std::vector<std::string>{"objects.block.energies.0.young", "mu", "repeat"});
  CHECK(plan.cases[0].values.at("objects.block.energies.0.young") == "1000000");
  CHECK(plan.cases[3].values.at("objects.block.energies.0.young") == "2000000");
  CHECK(plan.cases[0].duration == 0.02);
  CHECK(plan.cases[0].digest == plan.cases[1].digest);
  CHECK(plan.cases[0].digest != plan.cases[2].digest);
  CHECK(plan.units.at("objects.block.energies.0.young") == "Pa");
  CHECK(plan.units.count("mu") == 0);
  CHECK(plan.units.at("wall_seconds") == "s");
  CHECK(plan.units.at("seconds_assembly") == "s");
  // A resolved scene resolves to itself.
  const LoadedExperiment again = parse_experiment(plan.cases[2].scene, "again");
  CHECK(contains(plan.cases[2].scene, "young: 2000000"));
  CHECK(again.experiment.time.duration == 0.02);
  check_case(plan, plan.cases[0]);
}

TEST_CASE("without anything that varies a batch has one case of each base", "[batch]") {
  const Files files;
  CHECK(names_of(files.plan("")) == std::vector<std::string>{"case"});
  write_file(files.folder.path() / "other.yaml", "include: tiny.yaml\nname: other\n");
  write_file(files.folder.path() / "batch.yaml", "name: b\nbases: [{file: tiny.yaml}, {name: second, file: other.yaml, set: [time.step=5 ms]}]\n");
  const BatchPlan plan = plan_of(load_batch(files.folder.path() / "batch.yaml", {}), "program");
  CHECK(names_of(plan) == std::vector<std::string>{"base=tiny", "base=second"});
  CHECK(plan.columns == std::vector<std::string>{"base"});
  CHECK(contains(plan.cases[1].scene, "step: 0.005"));
}

TEST_CASE("names differ, and are no longer than file systems like", "[batch]") {
  const Files files;
  CHECK(names_of(files.plan("vary: [{type: grid, keys: {about: ['a/b', 'a_b', a b]}}]\n")) == std::vector<std::string>{"about=a_b", "about=a_b.2", "about=ab"});
  const std::string text(300, 'x'), name = "case_322e0f1f";  // CRC-32 of the long name
  CHECK(names_of(files.plan("vary: [{type: grid, keys: {about: ['" + text + "', y]}}]\n")) == std::vector<std::string>{name, "about=y"});
  CHECK(names_of(files.plan("vary: [{type: grid, keys: {about: [y, '" + text + "z', '" + text + "']}}]\n")).back() == name);
}

TEST_CASE("errors of any case are reported before anything runs", "[batch]") {
  const Files files;
  const auto refused = [&](const std::string& rest, const std::string& message) {
    CHECK_THROWS_WITH(files.plan(rest), Catch::Contains(message));
  };
  refused("vary: [{type: grid, keys: {objects.block.energies.0.yuong: [1 MPa]}}]\n", "batch.yaml:3:");
  refused("vary: [{type: grid, keys: {objects.block.energies.0.yuong: [1 MPa]}}]\n", "did you mean 'young'?");
  refused("vary: [{type: grid, keys: {objects.blok.energies.0.young: [1 MPa]}}]\n", "no list entry is named 'blok'");
  refused("vary: [{type: grid, keys: {time.step: [1 ms, 1 kg]}}]\n", "case 'step=1kg'");
  refused("vary: [{type: grid, keys: {time.step: [1 ms]}}, {type: zip, keys: {time.step: [1 ms]}}]\n", "two entries vary 'time.step'");
  refused("bases: [{file: tiny.yaml}]\n", "either base or bases");
  refused("statistics: [{probe: height, statistic: at}]\n", "needs where");
  const BatchPlan plan = files.plan("statistics: [{name: h, probe: hieght, statistic: max}]\n");
  CHECK_THROWS_WITH(check_case(plan, plan.cases[0]), Catch::Contains("statistic 'h'") && Catch::Contains("did you mean 'height'?"));
  const BatchPlan deep = files.plan("vary: [{type: grid, keys: {objects.block.place.translate: [[0, 0.09, 0]]}}]\n");
  CHECK_THROWS_AS(check_case(deep, deep.cases[0]), InputError);  // the block stands in the floor
}

TEST_CASE("a batch has no more cases than can be planned, and no column twice", "[batch]") {
  const Files files;
  const auto refused = [&](const std::string& rest, const std::string& message) { CHECK_THROWS_WITH(files.plan(rest), Catch::Contains(message)); };
  refused("vary: [{type: repeat, count: 20000000}]\n", "that makes 2e+07 cases, and 100000 are the most");
  refused("vary: [{type: repeat, count: 1000000000}]\n", "that makes 1e+09 cases");
  refused("vary: [{type: repeat, count: 1000}, {type: sobol, samples: 1000, keys: {time.step: {from: 1 ms, to: 2 ms}}}]\n", "that makes 1e+06 cases");
  refused("vary: [{type: latin_hypercube, samples: 2000000000, keys: {time.step: {from: 1 ms, to: 2 ms}}}]\n", "that makes 2e+09 cases");
  for (const char* taken : {"case", "status", "error", "steps", "wall_seconds", "seconds_solve", "'expect:x'"}) {
    refused(std::string("vary: [{type: grid, keys: {time.step: {values: [5 ms], as: ") + taken + "}}}]\n", "results.csv has a column '");
    refused(std::string("statistics: [{name: ") + taken + ", probe: height, statistic: min}]\n", "give this statistic another name");
  }
  refused("vary: [{type: grid, keys: {time.step: {values: [5 ms], as: h}}}]\nstatistics: [{name: h, probe: height, statistic: min}]\n", "would both be the column 'h'");
  refused("vary: [{type: grid, keys: {time.step: {values: [5 ms], as: \"a\\nb\"}}}]\n", "as: expects a text in one line");
  refused("vary: [{type: cases, cases: [{name: \"a\\nb\"}]}]\n", "name: expects a text in one line");
  refused("slurm: {options: [\"--x\\nrm\"]}\n", "options: expects a text in one line");
  refused("slurm: {partition: \"a\\nrm\"}\n", "partition: expects a text in one line");
  CHECK(names_of(files.plan("vary: [{type: repeat, first: 2147483646, count: 3}]\n")).back() == "repeat=2147483648");
}

TEST_CASE("thousands of cases get names that differ, and the plan tells how far it is", "[batch]") {
  const Files files;
  write_file(files.folder.path() / "batch.yaml", "name: b\nbase: tiny.yaml\nvary: [{type: grid, keys: {about: [a, b]}}, {type: repeat, count: 300, as: n}, "
                                                 "{type: cases, as: m, cases: [{name: 1/2}, {name: 1_2}]}]\n");
  size_t calls = 0, last = 0;
  const BatchPlan plan = plan_of(load_batch(files.folder.path() / "batch.yaml", {}), "program", [&](size_t done, size_t all) {
    CHECK(done == last + 1);
    CHECK(all == 1200);
    last = done;
    ++calls;
  });
  CHECK(calls == 1200);
  std::vector<std::string> names = names_of(plan);
  CHECK(names[1] == "about=a,n=1,m=1_2.2");
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}

TEST_CASE("a case is another one when a file that it reads has changed", "[batch]") {
  const Files files;
  write_file(files.folder.path() / "tet.obj", "v 0 1 0\nv 1 1 0\nv 0 1 1\nv 0 2 0\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  const std::string vary = "vary: [{type: grid, keys: {objects.0.shape: [{type: file, path: tet.obj}]}}]\n";
  const std::string before = files.plan(vary).cases[0].digest;
  CHECK(contains(files.plan(vary).cases[0].scene, (files.folder.path() / "tet.obj").string()));  // relative to the batch's file
  CHECK(files.plan(vary).cases[0].digest == before);
  write_file(files.folder.path() / "tet.obj", "v 0 1 0\nv 1 1 0\nv 0 1 1\nv 0 3 0\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
  CHECK(files.plan(vary).cases[0].digest != before);
}

TEST_CASE("every shipped batch fits together", "[batch]") {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(TACK_SOURCE_DIR "/experiments/batches")) {
    INFO(entry.path());
    CHECK(plan_of(load_batch(entry.path(), {}), "program").cases.size() >= 4);
    ++files;
  }
  CHECK(files >= 4);
}

TEST_CASE("cases side by side fit cores and memory", "[batch]") {
  CHECK(jobs_that_fit(3, 1, {}) == 3);
  CHECK(jobs_that_fit(0, 1000000, {}) == 1);
  CHECK(jobs_that_fit(8, 1, 1e9) == 1);
}
