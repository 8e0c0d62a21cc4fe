// tack profile: the run is that of tack run, and the printed times add up to those that the run
// wrote.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <map>
#include <sstream>

#include "framework/output/csv.hpp"
#include "framework/profile/profile.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// A finer block that slides, and sticks to the floor; each of its faces is near its other faces.
std::string scene() {
  std::string text = tiny_scene_with("size: [0.2, 0.2, 0.2]}", "size: [0.2, 0.05, 0.2], cells: [10, 2, 10]}\n"
                                                               "    velocity: [0.1, -0.2, 0.3]");
  text.replace(text.find("[0, 0.1006, 0]"), 14, "[0, 0.0256, 0]");
  text.replace(text.find("at_least: 0.09"), 14, "at_least: 0.01");
  const std::string adhesion = "critical_strain: 0.001}\n";
  return text.insert(text.find(adhesion) + adhesion.size(), "      friction: {mu: 0.4}\n");
}

constexpr double contact_distance = 1e-3;  // m, of the scene

// By "table,row,quantity"; in the order of the file.
struct Rows {
  explicit Rows(const fs::path& path) {
    std::istringstream in(file_text(path));
    for (std::string line; std::getline(in, line);) {
      size_t at = line.find(',') + 1;  // of the row, which is quoted if it has commas
      at = line[at] == '"' ? line.find("\",", at) + 1 : line.find(',', at);
      at = line.find(',', at + 1) + 1;
      keys.push_back(line.substr(0, at - 1));
      values[keys.back()] = line.substr(at);
    }
  }
  double number(const std::string& key) const { return std::stod(values.at(key)); }
  // Sums a quantity over all rows of a table.
  double sum(const std::string& table, const std::string& quantity) const {
    double all = 0;
    for (const std::string& key : keys)
      if (key.starts_with(table + ",") && key.ends_with("," + quantity)) all += number(key);
    return all;
  }

  std::vector<std::string> keys;
  std::map<std::string, std::string> values;
};

double sum_of(const CsvTable& table, const std::string& name) {
  double sum = 0;
  for (const auto& row : table.rows) sum += row[table.column(name).value()];
  return sum;
}

// Whatever is not measured in seconds.
std::string without_seconds(const CsvTable& table) {
  std::string text;
  for (const auto& row : table.rows)
    for (size_t i = 0; i < row.size(); ++i)
      if (table.columns[i].find("seconds") == std::string::npos) text += fmt::format("{},", row[i]);
  return text;
}

}  // namespace

TEST_CASE("a profiled run has the bits of another one, writes no frames, and its tables add up") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene());
  const ProgramResult run = run_tack(folder.path(), {"run", "scene.yaml", "-o", "run"});
  const ProgramResult profiled = run_tack(folder.path(), {"profile", "scene.yaml", "-o", "profile"});
  INFO(run.err << profiled.out << profiled.err);
  REQUIRE(run.exit_code == 0);
  REQUIRE(profiled.exit_code == 0);
  CHECK(file_text(folder.path() / "run/probes.csv") == file_text(folder.path() / "profile/probes.csv"));
  const CsvTable steps = read_csv(folder.path() / "profile/steps.csv");
  CHECK(without_seconds(steps) == without_seconds(read_csv(folder.path() / "run/steps.csv")));
  CHECK(!fs::exists(folder.path() / "profile/frames"));
  CHECK(!fs::exists(folder.path() / "run/profile.csv"));

  const Rows rows(folder.path() / "profile/profile.csv");
  CHECK(rows.number("run,,steps") == steps.rows.size());
  CHECK(rows.number("run,,iterations") == sum_of(steps, "newton_iterations"));
  CHECK(rows.number("linear,,systems") == sum_of(steps, "linear_solves"));
  CHECK(rows.number("linear,,iterations") == sum_of(steps, "linear_iterations"));
  CHECK(rows.number("linear,,factorizations") > 0);
  CHECK(rows.sum("pair", "candidates") == sum_of(steps, "candidates"));
  CHECK(rows.sum("pair", "points") + rows.sum("pair", "samples") + rows.sum("pair", "guards") +
            rows.sum("pair", "edges") == sum_of(steps, "contacts"));
  CHECK(sum_of(steps, "contacts") > 0);
  double nearness = 0, in_contact = 0;
  for (const auto& row : steps.rows) {
    const double smallest = row[steps.column("min_distance").value()];
    if (row[steps.column("contacts").value()] == 0 || smallest >= contact_distance) continue;
    nearness += smallest / contact_distance, ++in_contact;
  }
  CHECK(rows.number("run,,nearness") == Approx(nearness / in_contact).epsilon(1e-5));
  CHECK(contains(profiled.out, fmt::format("{} steps ended in contact", in_contact)));
  CHECK(rows.number("pair,floor - block,friction") > 0);
  CHECK(rows.number("pair,floor - block,touching_steps") > 0);
  CHECK(rows.number("pair,block - block,touching_steps") == 0);
  for (const char* phase : {"broad_phase", "narrow_phase", "ccd"}) {
    CAPTURE(phase);
    CHECK(rows.sum("pair", std::string("seconds_") + phase) ==
          Approx(rows.number(std::string("phase,") + phase + ",seconds")).epsilon(1e-6));
  }
  for (const char* term : {"neo_hookean of 'block'", "contact", "friction"}) {
    CAPTURE(term);
    const std::string row = std::string("term,") + term + ",";
    CHECK(rows.number(row + "evaluations_hessian") == rows.number("term,gravity,evaluations_hessian"));
    CHECK(rows.number(row + "evaluations_hessian") >= sum_of(steps, "newton_iterations"));
    CHECK(rows.number(row + "evaluations_value") > sum_of(steps, "line_search_evaluations"));
    CHECK(rows.number(row + "seconds_hessian") > 0);
  }
  CHECK(rows.number("term,neo_hookean of 'block',elements") == 6 * 10 * 2 * 10);
}

// Both fall freely, each with its own faces near each other.
TEST_CASE("the object that costs most by itself leads the table of pairs") {
  const TemporaryFolder folder;
  std::string text = scene();
  const std::string small = "  - name: small\n    shape: {type: box, size: [0.1, 0.01, 0.1], cells: [3, 1, 3]}\n"
                            "    place: {translate: [0, 2, 0]}\n"
                            "    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]\n";
  write_file(folder.path() / "scene.yaml", text.insert(text.find("contact:\n"), small));
  const ProgramResult profiled = run_tack(folder.path(), {"profile", "scene.yaml", "--steps", "2", "--set",
                                                          "objects.block.shape={type: box, size: [0.2, 0.01, 0.2], cells: [30, 1, 30]}",
                                                          "objects.block.place.translate=[0, 1, 0]", "-o", "out"});
  INFO(profiled.out << profiled.err);
  REQUIRE(profiled.exit_code == 0);
  const Rows rows(folder.path() / "out/profile.csv");
  CHECK(rows.number("pair,block - block,candidates") > 20 * rows.number("pair,small - small,candidates"));
  CHECK(rows.number("pair,small - small,candidates") > 0);
  const auto first = std::find_if(rows.keys.begin(), rows.keys.end(), [](const auto& key) { return key.starts_with("pair,"); });
  REQUIRE(first != rows.keys.end());
  CHECK(*first == "pair,block - block,candidates");
  CHECK(contains(profiled.out, contact_heading));
  CHECK(contains(profiled.out, "\nblock with itself"));
}

TEST_CASE("a truncated step is reported with its blocker") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene());
  const ProgramResult profiled =
      run_tack(folder.path(), {"profile", "scene.yaml", "-o", "out", "--set", "objects.block.place.translate=[0, 0.035, 0]",
                               "objects.block.velocity=[0, -2, 0]", "time.step=20 ms", "time.duration=0.1 s"});
  INFO(profiled.out << profiled.err);
  REQUIRE(profiled.exit_code == 0);
  const Rows rows(folder.path() / "out/profile.csv");
  CHECK(rows.number("run,,steps_cut") > 0);
  CHECK(contains(profiled.out, " iterations  cut to "));
  CHECK(contains(profiled.out, " of 'floor' and "));
}

TEST_CASE("the speed-up on several cores is predicted, without a change of bits") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene());
  const ProgramResult run = run_tack(folder.path(), {"run", "scene.yaml", "-o", "run", "--threads", "2"});
  const ProgramResult profiled = run_tack(folder.path(), {"profile", "scene.yaml", "-o", "profile", "--cores", "12,64"});
  INFO(run.err << profiled.out << profiled.err);
  REQUIRE(run.exit_code == 0);
  REQUIRE(profiled.exit_code == 0);
  CHECK(file_text(folder.path() / "run/probes.csv") == file_text(folder.path() / "profile/probes.csv"));
  CHECK(without_seconds(read_csv(folder.path() / "run/steps.csv")) == without_seconds(read_csv(folder.path() / "profile/steps.csv")));
  CHECK(contains(profiled.out, "what holds 12 cores back"));
  CHECK(contains(file_text(folder.path() / "profile/profile.csv"), "SolidTerm<NeoHookean>::value, solid_term.hpp"));

  // Loops and the code between them are all of the steps. Other processes may take time of the wall.
  const Rows rows(folder.path() / "profile/profile.csv");
  const double all = rows.sum("loop", "seconds") + rows.sum("between_loops", "seconds");
  CHECK(all == Approx(rows.sum("serial", "seconds_all")).epsilon(1e-4));
  CHECK(all > 0);
  CHECK(all < 1.05 * rows.sum("phase", "seconds"));
  CHECK(rows.sum("serial", "seconds") >= rows.sum("between_loops", "seconds") * (1 - 1e-4));
  double bound = 1;
  for (const int cores : {2, 4, 12, 64}) {
    CAPTURE(cores);
    const double speed_up = rows.number(fmt::format("cores,{},speed_up", cores));
    CHECK(speed_up == Approx(all / (rows.sum("between_loops", "seconds") + rows.sum("loop", fmt::format("seconds_{}", cores)))).epsilon(1e-4));
    CHECK(speed_up >= bound - 1e-6);
    CHECK(speed_up <= 1 / (rows.sum("serial", "seconds") / all + (1 - rows.sum("serial", "seconds") / all) / cores) + 1e-3);
    bound = speed_up;
  }
  const ProgramResult refused = run_tack(folder.path(), {"profile", "scene.yaml", "-o", "no", "--cores", "4", "--threads", "2"});
  CHECK(refused.exit_code != 0);
  CHECK(contains(refused.err, "--cores predicts from a run with one thread"));
  CHECK(!fs::exists(folder.path() / "no"));
}

TEST_CASE("a scene without contact is profiled too") {
  const TemporaryFolder folder;
  std::string text = tiny_scene;
  const size_t contact = text.find("contact:\n"), probes = text.find("probes:");
  text.erase(contact, probes - contact);
  text.erase(text.find("  - {name: stickiness"), text.find("expect:") - text.find("  - {name: stickiness"));
  write_file(folder.path() / "scene.yaml", text);
  const ProgramResult profiled = run_tack(folder.path(), {"profile", "scene.yaml", "-o", "out", "--set", "expect=[]"});
  INFO(profiled.out << profiled.err);
  REQUIRE(profiled.exit_code == 0);
  CHECK_FALSE(contains(profiled.out, contact_heading));
  CHECK(contains(profiled.out, "neo_hookean of 'block'"));
}
