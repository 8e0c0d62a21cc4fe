// tack law: every registered adhesion law, and errors of command lines.
#include <catch2/catch.hpp>
#include <set>

#include "framework/contact/adhesion_law.hpp"
#include "framework/output/csv.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// Required arguments of each law.
const std::map<std::string, Arguments> least = {
    {"after_dwell", {"law={type: bilinear, peak_traction: 1e4, work_of_adhesion: 1}", "times=[0, 1]", "factors=[1, 1]"}},
    {"bilinear", {"peak_traction=1e4", "work_of_adhesion=1"}},
    {"bonded", {"peak_traction=1e4"}},
    {"damage", {"envelope={type: fang, peak_traction: 10 kPa, peak_distance: 0.1 mm}"}},
    {"dugdale", {"peak_traction=1e4"}},
    {"exponential", {"peak_traction=1e4", "work_of_adhesion=1"}},
    {"expression", {"traction=1e7 * d * exp(1 - d / 1e-3)", "range=20 mm"}},
    {"fang", {"peak_traction=1e4"}},
    {"lennard_jones", {"peak_traction=1e4"}},
    {"over_temperature", {"law={type: bilinear, peak_traction: 1e4, work_of_adhesion: 1}", "temperatures=[300]", "factors=[1]"}},
    {"over_time", {"law={type: bilinear, peak_traction: 1e4, work_of_adhesion: 1}", "factor=1"}},
    {"rcc", {"normal_stiffness=1e8", "work_of_adhesion=1"}},
    {"rcc_explicit", {"normal_stiffness=1e8", "work_of_adhesion=1", "viscosity=0.01"}},
    {"table", {"file=" TACK_TEST_DATA "/laws/six_rows.csv"}},
    {"viscoelastic", {"peak_traction=1e4", "work_of_adhesion=1", "relaxation_time=50 ms"}},
    {"xu_needleman", {"peak_traction=1e4"}},
    {"xu_needleman_coupled", {"peak_traction=1e4", "work_of_adhesion=1"}}};

}  // namespace

TEST_CASE("tack law shows every registered law", "[law]") {
  const TemporaryFolder folder;
  for (const std::string& name : Registry<AdhesionLaw>::kind().names()) {
    if (name.starts_with("documented")) continue;  // of the tests alone
    INFO(name);
    REQUIRE(least.contains(name));
    Arguments arguments = {"law", "--type", name};
    arguments.insert(arguments.end(), least.at(name).begin(), least.at(name).end());
    const ProgramResult result = run_tack(folder.path(), arguments);
    INFO(result.out << result.err);
    CHECK(result.exit_code == 0);
    CHECK(contains(result.out, name + ": a law of "));
    for (const char* part : {"peak traction", "work of adhesion", "process zone per modulus", "depth of the well", "displacement per step",
                             "its derivatives are those of its energy, and it has the peak and the work that it states"})
      CHECK(contains(result.out, part));
  }
}

TEST_CASE("tack law writes tables and pictures with named axes and units", "[law]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_tack(folder.path(), {"law", "--type", "rcc", "normal_stiffness=1e8", "work_of_adhesion=1 J/m^2", "viscosity=0.01",
                                                        "healing=1e-4", "--young", "10 MPa", "--speed", "1 mm/s", "-o", "out"});
  INFO(result.out << result.err);
  CHECK(contains(result.out, "E W / sigma^2 with E = 10 MPa"));
  CHECK(contains(result.out, "at most, at 1 mm/s"));
  const CsvTexts curves = read_csv_texts(folder.path() / "out/curves.csv");
  CHECK(curves.columns == std::vector<std::string>{"path", "angle", "speed", "time", "opening", "slip", "traction", "shear", "intensity", "stored", "dissipated"});
  std::set<std::string> paths;
  for (const auto& row : curves.rows) paths.insert(row[0]);
  CHECK(paths == std::set<std::string>{"slow", "unloading", "rate"});
  CHECK(read_csv(folder.path() / "out/rates.csv").columns == std::vector<std::string>{"speed", "peak", "work"});
  CHECK(read_csv(folder.path() / "out/healing.csv").columns == std::vector<std::string>{"pressure", "time", "strength"});
  const CsvTexts figures = read_csv_texts(folder.path() / "out/figures.csv");
  CHECK(figures.columns == std::vector<std::string>{"figure", "value", "unit", "remark"});
  CHECK(figures.rows.front()[0] == "peak traction");
  CHECK(csv_number(figures.rows.front()[1]) == 1e4);
  if (contains(result.out, "gnuplot is missing")) return;
  CHECK(result.exit_code == 0);
  struct Picture {
    std::string name, along, up;
  };
  for (const auto& [name, along, up] : {Picture{"traction", "opening or slip [µm]", "traction along the displacement [kPa]"}, Picture{"energy", "opening [µm]", "energy per area [J/m²]"},
                                        Picture{"unloading", "opening [µm]", "traction along the displacement [kPa]"}, Picture{"rate", "opening [", "traction [kPa]"},
                                        Picture{"peak_over_speed", "speed [", "peak traction ["}, Picture{"work_over_speed", "speed [", "work ["},
                                        Picture{"healing", "time of pressing [s]", "strength [kPa]"}, Picture{"intensity", "opening or slip [µm]", "intensity"}}) {
    INFO(name);
    const std::string svg = file_text(folder.path() / "out" / (name + ".svg"));
    CHECK(svg.starts_with("<?xml"));
    CHECK(contains(svg, "</svg>"));
    CHECK(contains(svg, along));
    CHECK(contains(svg, up));
    CHECK(fs::file_size(folder.path() / "out" / (name + ".png")) > 1000);
  }
}

TEST_CASE("tack law reads the laws of scenes and of files", "[law]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", tiny_scene);
  const ProgramResult scene = run_tack(folder.path(), {"law", "scene.yaml", "-o", "scene"});
  INFO(scene.out << scene.err);
  CHECK(contains(scene.out, "fang of '"));
  CHECK(contains(scene.out, "  process zone  "));  // its material has a modulus
  CHECK(read_csv(folder.path() / "scene/curves.csv").columns == std::vector<std::string>{"gap", "traction", "energy", "pair_traction", "pair_energy"});
  write_file(folder.path() / "law.yaml", "type: bilinear\npeak_traction: 10 kPa\nwork_of_adhesion: 1 J/m^2\n");
  CHECK(contains(run_tack(folder.path(), {"law", "law.yaml"}).out, "critical opening along the normal     200 µm"));
  CHECK(contains(run_tack(folder.path(), {"law", "law.yaml", "work_of_adhesion=2"}).out, "critical opening along the normal     400 µm"));
  CHECK(contains(run_tack(folder.path(), {"law", "--set", "work_of_adhesion=2", "law.yaml"}).out, "critical opening along the normal     400 µm"));
}

TEST_CASE("tack law shows each law of a scene once, and keeps their files apart", "[law]") {
  const TemporaryFolder folder;
  std::string scene = tiny_scene_with("contact:\n", R"(  - name: other
    shape: {type: box, size: [0.2, 0.2, 0.2]}
    place: {translate: [0.3, 0.1006, 0]}
    energies: [{type: neo_hookean, young: 2 MPa, poisson: 0.3, density: 1000}]
contact:
)");
  scene.insert(scene.find("    - between: "), "    - {between: [other, floor], adhesion: {type: bilinear, peak_traction: 10 kPa, work_of_adhesion: 1}}\n");
  write_file(folder.path() / "scene.yaml", scene);
  const ProgramResult result = run_tack(folder.path(), {"law", "scene.yaml", "-o", "out"});
  INFO(result.out << result.err);
  CHECK_THAT(result.out, Catch::Contains("fang of 'floor' - 'block': a law of the gap") && Catch::Contains("bilinear of 'floor' - 'other': a law of bonds"));
  CHECK_THAT(result.out, Catch::Contains("E W / sigma^2 with E = 1 MPa") && Catch::Contains("E W / sigma^2 with E = 2 MPa"));
  int tables = 0;
  for (const auto& entry : fs::directory_iterator(folder.path() / "out"))
    if (entry.path().extension() == ".csv") ++tables;
  CHECK(tables == 5);  // curves and figures of both, rates of the bonds
}

TEST_CASE("tack law reports errors and suggests names", "[law]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", tiny_scene);
  write_file(folder.path() / "nothing.yaml", "a: 1\n");
  const auto error = [&](const Arguments& arguments) {
    const ProgramResult result = run_tack(folder.path(), arguments);
    CHECK(result.exit_code == 2);
    return result.err;
  };
  CHECK_THAT(error({"law"}), Catch::Contains("no law given") && Catch::Contains("bilinear, bonded, "));
  CHECK_THAT(error({"law", "--type", "fnag"}), Catch::Contains("did you mean 'fang'?"));
  CHECK_THAT(error({"law", "--type", "rcc", "normal_stifness=1e8"}),
             Catch::Contains("did you mean 'normal_stiffness'?") && Catch::Contains("missing key 'work_of_adhesion'"));
  CHECK_THAT(error({"law", "--type", "rcc"}), Catch::Contains("missing key 'normal_stiffness'"));
  CHECK_THAT(error({"law", "--type", "fang", "peak_traction=1 mm"}), Catch::Contains("expects a pressure (Pa), got '1 mm'"));
  CHECK_THAT(error({"law", "--type", "fang", "peak_traction=1e4", "--young", "5 mm"}), Catch::Contains("--young expects a pressure"));
  CHECK_THAT(error({"law", "--type", "fang", "peak_traction=1e4", "--speed", "0"}), Catch::Contains("--speed expects a velocity above zero"));
  CHECK_THAT(error({"law", "scene.yaml", "--type", "fang"}), Catch::Contains("not both"));
  CHECK_THAT(error({"law", "scene.yaml", "nothing.yaml"}), Catch::Contains("one file"));
  CHECK_THAT(error({"law", "scene.yaml", "--contact-distance", "1 mm"}), Catch::Contains("has its own barrier"));
  CHECK_THAT(error({"law", "nothing.yaml"}), Catch::Contains("neither a scene"));
  CHECK_THAT(error({"law", "--typ", "fang"}), Catch::Contains("did you mean '--type'?"));
}
