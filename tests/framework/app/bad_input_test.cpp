// Bad input ends with 2 before anything is written; the message names the location and the remedy.
#include <sys/stat.h>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

constexpr const char* inverted_tet = R"(# vtk DataFile Version 3.0
one tet inside out
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 4 double
0 1 0  1 1 0  0 2 0  0 1 1
CELLS 1 5
4 0 2 1 3
CELL_TYPES 1
10
)";

constexpr const char* doubled_tet = R"(# vtk DataFile Version 3.0
one tet twice
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 4 double
0 1 0  1 1 0  0 2 0  0 1 1
CELLS 2 10
4 0 1 2 3
4 1 2 0 3
CELL_TYPES 2
10 10
)";

struct Mistake {
  const char* what;
  const char* part;   // of the tiny scene
  const char* wrong;  // replacement
  std::vector<const char*> parts;
};

const char* const cube = "shape: {type: box, size: [0.2, 0.2, 0.2]}";
const char* const strain = "critical_strain: 0.001";

const std::vector<Mistake> mistakes = {
    {"unknown key", "young: 1 MPa", "yong: 1 MPa",
     {"scene.yaml:12:36: unknown key 'yong' in energy 'neo_hookean'", "did you mean 'young'?"}},
    {"duplicate key", "name: tiny", "name: tiny\nname: tiny", {"scene.yaml:2:1: duplicate key 'name'", "keep one"}},
    {"unknown component", "neo_hookean", "neo_hokean",
     {"scene.yaml:12:23: ", "unknown energy 'neo_hokean'", "did you mean 'neo_hookean'?"}},
    {"wrong unit", "young: 1 MPa", "young: 1 mm",
     {"scene.yaml:12:43: young: expects a pressure (Pa), got '1 mm', which is a length"}},
    {"missing mesh", cube, "shape: {type: file, path: nowhere.msh}",
     {"scene.yaml:9:5: ", "nowhere.msh: there is no such mesh file: check the path"}},
    {"inverted tet", cube, "shape: {type: file, path: inverted.vtk}",
     {"scene.yaml:9:5: object 'block': tet 0 (vertices 0 2 1 3) is inverted", "swap two of its vertices"}},
    {"intersecting start", "0.1006", "0.09",
     {"scene.yaml:9:5: the start intersects; move the objects apart (place.translate)",
      "of 'floor' meets triangle (", "of 'block'"}},
    {"doubled tet", cube, "shape: {type: file, path: doubled.vtk}",
     {"scene.yaml:9:5: object 'block': tet 0 (vertices 0 1 2 3) and tet 1 (vertices 1 2 0 3) are the same",
      "1 such pairs", "remove one of them"}},
    {"a body inside of another", "place: {translate: [0, 0.1006, 0]}", "place: {scale: [0.1, 0.1, 0.1], translate: [0.2, -0.1, 0]}",
     {"scene.yaml:9:5: object 'block' is inside of 'floor' at the start (its vertex ", "lies in tet ",
      "move the objects apart (place.translate)"}},
    {"decimal comma", "motion: [fixed]", "motion: [{type: formula, y: '0,02*t'}]",
     {"scene.yaml:8:33: y: ", "formula '0,02*t': a comma makes 2 formulas of it; write numbers with a point"}},
    {"assignment in a formula", "motion: [fixed]", "motion: [{type: formula, y: 't = 1 ? 0.01 : 0'}]",
     {"scene.yaml:8:33: y: ", "formula 't = 1 ? 0.01 : 0': `=` would assign a value (position 2); did you mean `==`?"}},
    {"number beyond squares", "motion: [fixed]", "motion: [{type: formula, y: '1e151*t'}]",
     {"scene.yaml:8:33: y: ", "1e151 is too large, at most 1e+150 may stand there (position 0)"}},
    {"distance in a wrong unit", "distance: 1 mm", "distance: 1 km",
     {"scene.yaml:14:3: contact reaches over 2000 m, and the whole scene is 1.46986 m", "lower contact.distance"}},
    {"cells without end", cube, "shape: {type: box, size: [1, 1, 1], cells: [1000000, 1000, 1]}", {"vertices are too many, at most 1"}},
    {"an endless mesh", cube, "shape: {type: file, path: /dev/zero}", {"/dev/zero: cannot be read: check its kind"}},
    {"range below the given peak", strain, "critical_strain: 0.001, peak_distance: 2 mm, range: 1.5 mm",
     {"scene.yaml:17:82: range: must be larger than peak_distance: raise range or lower peak_distance"}},
    {"range below the default peak", strain, "critical_strain: 0.001, range: 0.9 mm",
     {"scene.yaml:16:7: adhesion fang: range", "must be larger than peak_distance 0.001 m; raise range"}},
    {"peak where the barrier acts", strain, "critical_strain: 0.001, peak_distance: 0.5 mm",
     {"scene.yaml:16:7: adhesion fang: peak_distance 0.0005 m is below the contact distance 0.001 m",
      "lower contact.distance"}},
    {"negative density", "density: 1000", "density: -1000",
     {"scene.yaml:12:73: density: -1000 kg/m^3 must be positive"}},
    {"unknown object in a pair", "between: [block, floor]", "between: [blok, floor]",
     {"scene.yaml:16:7: no object and no group is named 'blok'; did you mean 'block'?"}},
    {"unknown column", "{probe: height,", "{probe: heigth,",
     {"scene.yaml:22:5: ", "unknown column 'heigth'; did you mean 'height'?"}},
    {"expectation of another kind", "at_least: 0.09", "at_least: 90 mN",
     {"scene.yaml:22:5: expectation 'height: min': at_least: expects a length (m), got '90 mN', which is a force"}},
    {"unknown group", "motion: [fixed]", "motion: [{type: fixed, select: {type: tag, name: wall}}]",
     {"scene.yaml:5:5: ", "object 'floor' has no group 'wall'"}},
    {"tangential adhesion alone", "adhesion: {type: fang, critical_strain: 0.001}", "tangential_adhesion: {mu: 1}",
     {"scene.yaml:17:28: tangential_adhesion: takes its strength from the pair's adhesion", "give one"}},
    {"friction without coefficient", "distance: 1 mm", "friction: {eps_v: 1 mm/s}",
     {"scene.yaml:14:13: ", "'mu'"}},
    {"negative friction", "distance: 1 mm", "friction: {mu: -0.5}", {"scene.yaml:14:18: mu: -0.5 must be not negative"}},
    {"probe of friction without friction", "type: contact_force, on: block, from: floor, part: adhesion",
     "type: friction_force, on: block",
     {"scene.yaml:20:5: probe 'stickiness': no pair has friction or tangential adhesion; give one in "
      "contact.pairs"}},
    {"nothing free", "energies: [{type: neo_hookean", "motion: [fixed]\n    energies: [{type: neo_hookean",
     {"scene.yaml:5:3: nothing can move: the motion of every object is prescribed throughout; free one of them"}},
    {"load on no vertex", "energies: [{type: neo_hookean",
     "loads:\n      - {type: traction, value: [0, 1, 0], select: {type: sphere, centre: [9, 9, 9], radius: 1}}\n"
     "    energies: [{type: neo_hookean",
     {"scene.yaml:13:9: selection sphere chooses no vertex of object 'block'"}},
    {"load on no triangle", "energies: [{type: neo_hookean",
     "loads:\n      - {type: traction, value: [0, 1, 0], select: {type: indices, vertices: [0]}}\n"
     "    energies: [{type: neo_hookean",
     {"scene.yaml:13:9: object 'block': its traction's selection holds no whole surface triangle; widen it"}},
    {"line break in a name", "name: height", "name: \"hei\\nght\"",
     {"scene.yaml:19:12: name: expects a text in one line, and this one has a line break"}},
    {"whole number too large", cube, "shape: {type: box, size: [0.2, 0.2, 0.2], cells: [99999999999, 1, 1]}",
     {"scene.yaml:10:55: cells: 99999999999 is too large; whole numbers go from"}},
    {"`on` as libraries for YAML 1.1 read it", "on: block, from: floor", "true: block, from: floor",
     {"scene.yaml:20:45: unknown key 'true' in probe 'contact_force'; did you mean 'on'?", "write it in quotes"}},
    {"name of another program", "young: 1 MPa", "E: 1 MPa", {"scene.yaml:12:36: unknown key 'E' in energy 'neo_hookean'", "did you mean 'young'?"}},
    {"other capitals", "young: 1 MPa", "young: 1 MPA", {"'MPA' is no known unit; did you mean 'MPa'?"}},
    {"decimal comma in braces", "young: 1 MPa", "young: 0,1 MPa", {"unknown key '1 MPa' in energy 'neo_hookean'; a comma ends a value; write numbers with a decimal point"}},
    {"decimal comma", "distance: 1 mm", "distance: 0,5 mm", {"scene.yaml:14:13: distance: ", "write numbers with a point, as 0.1"}},
    {"space missing", "distance: 1 mm", "distance:1 mm", {"scene.yaml:14:11: not valid YAML: a space is missing after the colon of 'distance:'"}},
    {"space missing in braces", "young: 1 MPa", "young:1 MPa", {"a space is missing after the colon of 'young:'"}},
    {"tab", "  distance: 1 mm", "\tdistance: 1 mm", {"this line is indented by a tab; use spaces"}},
    {"number for a map", "distance: 1 mm", "friction: 0.5", {"friction expects a map, got '0.5'; write {mu: 0.5}"}},
    {"no tets", cube, "shape: {type: box, size: [0.2, 0.2, 0.2], surface: true}", {"needs tetrahedra", "steps: [tetrahedralize]"}},
    {"bad syntax", "distance: 1 mm", "distance: [1 mm", {"scene.yaml:15:8: not valid YAML"}},
};

}  // namespace

TEST_CASE("a mistake in a scene is reported with location and remedy, and nothing is written") {
  for (const Mistake& mistake : mistakes) {
    INFO(mistake.what);
    const TemporaryFolder folder;
    const fs::path older = folder.path() / "results" / "tiny";
    fs::create_directories(older);
    write_file(older / ".tack_run", "");
    write_file(older / "summary.json", "of an earlier run");
    write_file(folder.path() / "inverted.vtk", inverted_tet);
    write_file(folder.path() / "doubled.vtk", doubled_tet);
    write_file(folder.path() / "scene.yaml", tiny_scene_with(mistake.part, mistake.wrong));

    const ProgramResult result = run_tack(folder.path(), {"run", "scene.yaml"});
    CHECK(result.exit_code == 2);
    CHECK(result.out == "");
    INFO(result.err);
    CHECK(result.err.starts_with("error: "));
    for (const char* part : mistake.parts) CHECK(contains(result.err, part));
    CHECK(file_text(older / "summary.json") == "of an earlier run");
    const auto entries = fs::directory_iterator(folder.path() / "results");
    CHECK(std::distance(begin(entries), end(entries)) == 1);
  }
}

TEST_CASE("a vertex without mass is reported with the location of its object") {
  const TemporaryFolder folder;
  write_file(folder.path() / "tail.vtk", R"(# vtk DataFile Version 3.0
a tet with a tail
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 1 0  1 1 0  0 2 0  0 1 1  3 1 0
CELLS 2 8
4 0 1 2 3
2 1 4
CELL_TYPES 2
10 3
)");
  const std::string scene = tiny_scene_with(cube, "shape: {type: file, path: tail.vtk}");
  write_file(folder.path() / "scene.yaml", scene.substr(0, scene.find("contact:\n")));
  const ProgramResult result = run_tack(folder.path(), {"run", "scene.yaml"});
  CHECK(result.exit_code == 2);
  CHECK(contains(result.err, "scene.yaml:9:5: object 'block': vertex 4 has no mass; give every part an energy"));
}

TEST_CASE("contact at the start is refused with its location") {
  const TemporaryFolder folder;
  const fs::path path = folder.path();
  const auto error_of = [&](const std::string& mesh, const std::string& of_object, const std::string& rest = "") {
    write_file(path / "part.obj", mesh);
    write_file(path / "scene.yaml", "name: touching\ntime: {step: 0.01 s, duration: 0.05 s}\nobjects:\n  - {name: part, shape: {type: file, path: part.obj}, " +
                                        of_object + "}\n" + rest + "contact: {distance: 1 mm}\n");
    const ProgramResult result = run_tack(path, {"run", "scene.yaml"});
    INFO(result.out << result.err);
    CHECK(result.exit_code == 2);
    CHECK_FALSE(fs::exists(path / "results" / "touching"));
    return result.err;
  };
  const std::string rod = "rod: {radius: 5 mm}, contact_offset: 5 mm, energies: [{type: elastic_rod, young: 1 MPa, density: 1000}]";
  const std::string sheet = "shell: {thickness: 1 mm}, energies: [{type: stvk_membrane, young: 1 MPa, density: 1000}, {type: hinge_bending, young: 1 MPa}]";
  const std::string back = error_of("v 0 0 0\nv 1 0 0\nv 0.5 0 0\nl 1 2\nl 2 3\n", rod);
  CHECK(contains(back, "scene.yaml:4:5: the start touches itself; take one of the parts out of the mesh"));
  CHECK(contains(back, "vertex 2 of 'part' and edge (0, 1) of 'part' touch at (0.5, 0, 0) m"));
  const std::string further = error_of("v 0 0 0\nv .3 0 0\nv .6 0 0\nv 1 0 0\nv .8 0 0\nv .5 0 0\nv .1 0 0\nl 1 2 3 4 5 6 7\n", rod);
  CHECK(contains(further, "edge (0, 1) of 'part' and edge (5, 6) of 'part' touch at (0.3, 0, 0) m"));
  CHECK(contains(error_of("v 0 0 0\nv .1 0 0\nv 0 0 .1\nv .02 0 .09\nf 1 2 3\nf 2 1 4\n", sheet),
                 "edge (0, 3) of 'part' and edge (1, 2) of 'part' touch at (0.0181818, 0, 0.0818182) m"));
  CHECK(contains(error_of("v 0 0 0\nv 1 0 0\nl 1 2\nl 2 1\n", rod),
                 "object 'part': edge 0 (vertices 0 1) and edge 1 (vertices 1 0) are the same: remove one of them"));
  // Two rods that cross in one point, without an offset that would tell.
  const std::string bare = "rod: {radius: 5 mm}, energies: [{type: elastic_rod, young: 1 MPa, density: 1000}]";
  const std::string crossed = error_of("v -1 0 0\nv 1 0 0\nl 1 2\n", bare,
                                       "  - {name: other, shape: {type: segment, length: 2}, place: {axis: [0, 1, 0], angle: 90 deg}, " + bare + "}\n");
  CHECK(contains(crossed, "the start touches; move the objects apart (place.translate), have them pushed apart if they overlap a little (contact.overclosure_adjustment: 1 mm)"));
}

TEST_CASE("a wrong command line ends with 2 and names the expected arguments") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", tiny_scene);
  const auto error_of = [&](const Arguments& arguments) {
    const ProgramResult result = run_tack(folder.path(), arguments);
    CHECK(result.exit_code == 2);
    return result.err;
  };
  CHECK(contains(error_of({"run"}), "error: FILE is required"));
  CHECK(contains(error_of({"run", "nowhere.yaml"}), "nowhere.yaml"));
  CHECK(contains(error_of({"run", "scene.yaml", "--stepz", "2"}), "--stepz"));
  CHECK(contains(error_of({"run", "scene.yaml", "--plugin", "nowhere.so"}), "there is no library '" + (folder.path() / "nowhere.so").string() + "'"));
  CHECK(contains(error_of({"check", "scene.yaml", "--plugin", "nowhere.so"}), "there is no library"));
  CHECK(contains(error_of({"compare", "compare.yaml", "--plugin", "nowhere.so"}), "there is no library"));
  CHECK(contains(error_of({"run", "scene.yaml", "--steps", "0"}), "--steps: expects a whole number above zero, got '0'"));
  CHECK(error_of({"run", "scene.yaml", "--steps", "0"}).size() < 200);
  CHECK(contains(error_of({"run", "scene.yaml", "--threads", "99999999999"}), "got '99999999999'"));
  CHECK(contains(error_of({"rn", "scene.yaml"}), "error: unknown command 'rn'; did you mean 'run'? (commands: new, run, "));
  CHECK(contains(error_of({"run", "scene.yaml", "--thread", "2"}), "unknown option '--thread' of `tack run`; did you mean '--threads'?"));
  CHECK(contains(error_of({"--vresion"}), "unknown option '--vresion' of `tack`; did you mean '--version'?"));
  CHECK(contains(error_of({"run", "scene.yaml", "--set", "time.stepp=1"}),
                 "--set time.stepp=1: unknown key 'stepp'"));
  CHECK(contains(error_of({"list", "adhesoin"}), "did you mean 'adhesion'?"));
  CHECK(contains(error_of({"mesh", "info", "nowhere.msh"}), "nowhere.msh"));
  write_file(folder.path() / "batch.yaml", "name: b\nbase: scene.yaml\nvary: [{type: repeat, count: 2}]\n");
  write_file(folder.path() / "compare.yaml", "name: c\nbase: scene.yaml\nsolvers: []\n");
  CHECK(contains(error_of({"run", "batch.yaml"}), "batch.yaml:1:1: is a batch, not a scene; call `tack batch batch.yaml`"));
  CHECK(contains(error_of({"check", "compare.yaml"}), "compare.yaml:1:1: is a comparison, not a scene; call `tack compare compare.yaml`"));
  CHECK(contains(error_of({"batch", "scene.yaml"}), "scene.yaml:1:1: is a scene, not a batch; call `tack run scene.yaml`"));
  CHECK(contains(error_of({"compare", "batch.yaml"}), "is a batch, not a comparison; call `tack batch batch.yaml`"));
  CHECK_FALSE(fs::exists(folder.path() / "results"));
}

TEST_CASE("results do not go where something else lies") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", tiny_scene);
  fs::create_directories(folder.path() / "thesis");
  write_file(folder.path() / "thesis" / "chapter", "1");
  const ProgramResult result = run_tack(folder.path(), {"run", "scene.yaml", "-o", "thesis"});
  CHECK(result.exit_code == 2);
  CHECK(contains(result.err, "choose another results folder with -o"));
  CHECK(file_text(folder.path() / "thesis" / "chapter") == "1");
}

TEST_CASE("devices, pipes and enormous files are refused, not read") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", "include: /dev/zero\n");
  write_file(folder.path() / "huge.yaml", "");
  fs::resize_file(folder.path() / "huge.yaml", std::uintmax_t(1) << 40);  // holes only
  REQUIRE(::mkfifo((folder.path() / "pipe.yaml").c_str(), 0600) == 0);
  const auto error_of = [&](const Arguments& arguments) {
    const ProgramResult result = run_tack(folder.path(), arguments);
    CHECK(result.exit_code == 2);
    return result.err;
  };
  CHECK(contains(error_of({"check", "/dev/zero"}), "/dev/zero: cannot read this file: it is a device or a pipe"));
  CHECK(contains(error_of({"check", "scene.yaml"}), "scene.yaml:1:10: include: /dev/zero: cannot read this file"));
  CHECK(contains(error_of({"compare", "/dev/zero"}), "/dev/zero: cannot read this file"));
  CHECK(contains(error_of({"check", "pipe.yaml"}), "it is a device or a pipe"));
  CHECK(contains(error_of({"check", "huge.yaml"}), "it has 1099511627776 bytes, and 67108864 is the most"));
}
