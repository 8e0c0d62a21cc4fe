// The other commands, and the files that the program generates.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <set>

#include "framework/output/provenance.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// The names of all files of a folder.
std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

}  // namespace

TEST_CASE("the committed reference pages and schemas are those of the program, none stale, missing or surplus") {
  const TemporaryFolder folder;
  const fs::path docs = fs::path(TACK_SOURCE_DIR) / "docs";
  REQUIRE(run_tack(folder.path(), {"list", "--reference", "pages", "--schema", "schema.json", "--compare-schema",
                                    "compare.json", "--batch-schema", "batch.json", "--calibrate-schema", "calibrate.json", "--plot-schema", "plot.json"}).exit_code == 0);
  INFO("regenerate: ./tack list --reference docs/reference --schema docs/scene.schema.json --compare-schema "
       "docs/compare.schema.json --batch-schema docs/batch.schema.json --calibrate-schema docs/calibrate.schema.json --plot-schema docs/plot.schema.json");
  const std::set<std::string> pages = files_in(folder.path() / "pages");
  CHECK(pages == files_in(docs / "reference"));
  CHECK(pages.size() > 25);
  for (const std::string& page : pages) {
    INFO(page);
    if (fs::exists(docs / "reference" / page)) CHECK((file_text(folder.path() / "pages" / page) == file_text(docs / "reference" / page)));
  }
  CHECK((file_text(folder.path() / "schema.json") == file_text(docs / "scene.schema.json")));
  CHECK((file_text(folder.path() / "compare.json") == file_text(docs / "compare.schema.json")));
  CHECK((file_text(folder.path() / "batch.json") == file_text(docs / "batch.schema.json")));
  CHECK((file_text(folder.path() / "calibrate.json") == file_text(docs / "calibrate.schema.json")));
  CHECK((file_text(folder.path() / "plot.json") == file_text(docs / "plot.schema.json")));
}

TEST_CASE("a reference whose path ends in .md is one page, with the components of the folder") {
  const TemporaryFolder folder;
  REQUIRE(run_tack(folder.path(), {"list", "--reference", "page.md"}).exit_code == 0);
  REQUIRE(run_tack(folder.path(), {"list", "--reference", "pages"}).exit_code == 0);
  const std::string page = file_text(folder.path() / "page.md"), energies = file_text(folder.path() / "pages" / "energy.md");
  CHECK(contains(page, "\n### energy `neo_hookean`\n"));
  CHECK(contains(page, "\n## Calibration files\n"));
  CHECK(contains(page, "[list of energies](#energy)"));
  CHECK(contains(energies, "\n## `neo_hookean`\n"));
  CHECK(contains(energies, "[selection](selection.md)"));
}

TEST_CASE("without its program, a command names the target to build, and other commands work") {
  const TemporaryFolder folder;
  const fs::path alone = folder.path() / "tack";
  fs::copy_file(TACK_PROGRAM, alone);
  const std::vector<Arguments> in_studies = {{"batch", "b.yaml"},   {"calibrate", "c.yaml"}, {"compare", "c.yaml"}, {"list", "--schema", "s.json"}, {"list", "variation"},
                                             {"law", "--type", "fang"}, {"plot", "results"},     {"report", "results"},     {"view", "scene.yaml"}};
  for (const Arguments& arguments : in_studies) {
    CAPTURE(arguments);
    const ProgramResult missing = run_tack(folder.path(), arguments, alone);
    CHECK(missing.exit_code == 2);
    CHECK(contains(missing.err, (folder.path() / "tack_studies").string() + ", cannot be started (No such file or directory)"));
    CHECK(contains(missing.err, "--target tack_studies"));
  }
  CHECK(run_tack(folder.path(), {"list", "integrator"}, alone).exit_code == 0);
}

TEST_CASE("components that the program lacks at its start are loaded once one is named") {
  const TemporaryFolder folder;
  const fs::path alone = folder.path() / "bin" / "tack", studies = fs::path(TACK_PROGRAM).parent_path() / "tack_studies";
  fs::create_directories(alone.parent_path());
  fs::copy_file(TACK_PROGRAM, alone);
  const auto kinds = {"energy", "field", "filling", "format", "interaction", "load", "probe", "stepper"};
  // It knows their names without the library, and all of them.
  const std::string known = run_tack(folder.path(), {"completion", "bash"}, alone).out, all = run_tack(folder.path(), {"completion", "bash"}, studies).out;
  for (const char* kind : kinds) {
    CAPTURE(kind);
    const size_t at = all.find(std::string("    ") + kind + ") _tack_words ");
    REQUIRE(at != all.npos);
    CHECK(contains(known, all.substr(at, all.find('\n', at) + 1 - at)));
  }
  CHECK(contains(run_tack(folder.path(), {"list", "energy", "von_mise"}, alone).err, "unknown energy 'von_mise'; did you mean 'von_mises'?"));
  CHECK(run_tack(folder.path(), {"list", "energy", "neo_hookean"}, alone).exit_code == 0);
  for (const Arguments& arguments : {Arguments{"list", "energy", "von_mises"}, {"list", "energy"}}) {
    CAPTURE(arguments);
    const ProgramResult missing = run_tack(folder.path(), arguments, alone);
    CHECK(missing.exit_code == 2);
    CHECK(contains(missing.err, (folder.path() / "bin" / "libtack_further.so").string() + " is not there"));
    CHECK(contains(missing.err, "--target tack_further"));
  }
  write_file(alone.parent_path() / "libtack_further.so", "none");
  CHECK(contains(run_tack(folder.path(), {"list", "energy", "von_mises"}, alone).err, "is no shared library"));
  for (const char* kind : kinds) {
    CAPTURE(kind);
    const ProgramResult listed = run_tack(folder.path(), {"list", kind});
    CHECK(listed.exit_code == 0);
    CHECK(listed.out == run_tack(folder.path(), {"list", kind}, studies).out);
  }
}

TEST_CASE("the script that started the program builds missing libraries, and can be ended meanwhile") {
  const TemporaryFolder folder;
  const fs::path alone = folder.path() / "tack", script = folder.path() / "script";
  fs::copy_file(TACK_PROGRAM, alone);
  write_file(script, "#!/bin/sh\necho \"asked for: $TACK_LIBRARIES with $*\"\ngrep SigBlk /proc/self/status\n");
  fs::permissions(script, fs::perms::owner_all);
  write_file(folder.path() / "scene.yaml", tiny_scene_with("type: neo_hookean", "type: von_mises, yield_stress: 1 MPa"));
  ::setenv("TACK_SCRIPT", script.c_str(), 1);
  const ProgramResult asked = run_tack(folder.path(), {"run", "scene.yaml"}, alone);
  ::setenv("TACK_LIBRARIES", "tack_further", 1);
  const ProgramResult again = run_tack(folder.path(), {"run", "scene.yaml"}, alone);
  ::unsetenv("TACK_LIBRARIES");
  ::unsetenv("TACK_SCRIPT");
  CHECK(contains(asked.out, "asked for: tack_further with run scene.yaml"));
  CHECK(contains(asked.out, "SigBlk:\t0000000000000000"));
  CHECK(again.exit_code == 2);  // not for ever
  CHECK(contains(again.err, "scene.yaml:"));
  CHECK(contains(again.err, "libtack_further.so is not there"));
  CHECK_FALSE(fs::exists(folder.path() / "results"));
}

TEST_CASE("tack check validates without running") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", tiny_scene);
  const ProgramResult good = run_tack(folder.path(), {"check", "scene.yaml"});
  CHECK(good.exit_code == 0);
  CHECK(contains(good.out, "unknowns: 24"));
  CHECK(contains(good.out, " is OK"));
  CHECK_FALSE(fs::exists(folder.path() / "results"));
  const ProgramResult bad =
      run_tack(folder.path(), {"check", "scene.yaml", "--set", "objects.block.place.translate=[0, 0, 0]"});
  CHECK(bad.exit_code == 2);
  CHECK(contains(bad.err, "the start intersects"));
}

TEST_CASE("tack check --gradient says so if the probe does not depend on the key") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml",
             tiny_scene_with("probes:", "probes:\n  - {name: aside, type: centre_of_mass, object: floor, direction: [1, 0, 0]}\n"
                                        "  - {name: floor_height, type: centre_of_mass, object: floor, direction: [0, 1, 0]}"));
  for (const auto& [probe, what] : {std::pair("aside", "zero"), std::pair("floor_height", "the same")}) {
    const ProgramResult result = run_tack(folder.path(), {"check", "scene.yaml", "--gradient", std::string(probe) + ":objects.block.energies.0.young", "--threads", "1"});
    INFO(result.out << result.err);
    CHECK(result.exit_code == 1);
    CHECK(contains(result.out, "nothing to compare: '" + std::string(probe) + "' is " + what + " in the runs with the two values of objects.block.energies.0.young"));
    CHECK_FALSE(contains(result.out, "nan"));
    CHECK_FALSE(contains(result.out, "median error"));
  }
}

TEST_CASE("tack list names kinds, components and their parameters") {
  const TemporaryFolder folder;
  CHECK(contains(run_tack(folder.path(), {"list"}).out, "adhesion "));
  CHECK(contains(run_tack(folder.path(), {"list", "adhesion"}).out, "fang "));
  const std::string fang = run_tack(folder.path(), {"list", "adhesion", "fang"}).out;
  // Components of batches are in another program.
  const ProgramResult variations = run_tack(folder.path(), {"list", "variation"});
  CHECK(variations.exit_code == 0);
  CHECK(contains(variations.out, "variation: Scene keys that vary in a batch"));
  CHECK(contains(variations.out, "  grid "));
  CHECK(contains(run_tack(folder.path(), {"list", "variation", "grid"}).out, "variation 'grid'"));
  CHECK(contains(run_tack(folder.path(), {"list"}).out, "variation"));
  CHECK(contains(fang, "file: energies/adhesion/fang.cpp"));
  CHECK(contains(fang, "critical_strain"));
}

TEST_CASE("tack list searches for several words, also if the first one is a kind") {
  const TemporaryFolder folder;
  const auto tack = [&](const Arguments& arguments) { return run_tack(folder.path(), arguments); };
  CHECK(contains(tack({"list", "probe", "tack"}).out, "docs/protocols.md#a-probe-tack-test-in-five-steps"));
  CHECK(contains(tack({"list", "work", "of", "debonding"}).out, "docs/protocols.md#the-numbers-of-a-curve"));
  CHECK(contains(tack({"list", "spherical", "probe"}).out, "shape sector"));
  CHECK(contains(tack({"list", "energy", "neohookean"}).err, "did you mean 'neo_hookean'?"));
  CHECK(contains(tack({"list", "energy", "gel"}).err, "`tack list gel` searches for a word of the field"));
}

TEST_CASE("tack mesh info reports the contents of a file") {
  const TemporaryFolder folder;
  const ProgramResult result =
      run_tack(folder.path(), {"mesh", "info", TACK_TEST_DATA "/meshes/two_tets_41_ascii.msh"});
  CHECK(result.exit_code == 0);
  CHECK(contains(result.out, "vertices 7, tets 2"));
}

TEST_CASE("messages and help of an installation name tack, not the script of the source tree") {
  const TemporaryFolder folder;
  const fs::path installed = folder.path() / "usr" / "bin" / "tack";
  fs::create_directories(installed.parent_path());
  fs::create_directories(folder.path() / "usr" / "share" / "tack");
  fs::copy_file(TACK_PROGRAM, installed);
  const ProgramResult missing = run_tack(folder.path(), {"compare", "c.yaml"}, installed);
  CHECK(missing.exit_code == 2);
  CHECK(contains(missing.err, "cannot be started (No such file or directory); install tack again"));
  const ProgramResult further = run_tack(folder.path(), {"list", "energy", "von_mises"}, installed);
  CHECK(contains(further.err, "install tack again"));
  for (const Arguments& arguments : {Arguments{"--help"}, {"export", "--help"}, {"law", "--help"}, {"mesh", "--help"}, {"run", "nowhere.yaml"}, {"list", "adhesoin"}}) {
    const ProgramResult result = run_tack(folder.path(), arguments, installed);
    INFO(result.out << result.err);
    CHECK_FALSE(contains(result.out + result.err, "./tack"));
  }
  CHECK_FALSE(contains(missing.err + further.err, "./tack"));
}

TEST_CASE("help and version end with 0") {
  const TemporaryFolder folder;
  CHECK(contains(run_tack(folder.path(), {"--version"}).out, this_build().sources()));
  CHECK(run_tack(folder.path(), {"--version"}).exit_code == 0);
  const ProgramResult help = run_tack(folder.path(), {"--help"});
  CHECK(help.exit_code == 0);
  for (const char* command : {"run", "view", "check", "compare", "batch", "calibrate", "list", "law", "mesh", "tack test"})
    CHECK(contains(help.out, command));
}

TEST_CASE("help, version and components are found by the words that other programs have for them") {
  const TemporaryFolder folder;
  const auto tack = [&](const Arguments& arguments) { return run_tack(folder.path(), arguments); };
  CHECK(tack({"help"}).out == tack({"--help"}).out);
  CHECK(tack({"help", "run"}).out == tack({"run", "--help"}).out);
  CHECK(tack({"version"}).out == tack({"--version"}).out);
  const ProgramResult nothing = tack({});
  CHECK(nothing.exit_code == 2);
  CHECK(contains(nothing.err, "calibrate"));
  CHECK(tack({"list", "neo_hookean"}).out == tack({"list", "energy", "neo_hookean"}).out);
  const std::string chambers = tack({"list", "pressure"}).out;  // of two kinds
  CHECK(contains(chambers, "load 'pressure'"));
  CHECK(contains(chambers, "filling 'pressure'"));
  CHECK(tack({"list", "energy"}).out != tack({"list", "probe", "energy"}).out);
  CHECK(contains(tack({"list", "neo_hokean"}).err, "nothing is found for 'neo_hokean'"));
}

TEST_CASE("meshes of files have the unit that the scene gives them") {
  const TemporaryFolder folder;
  write_file(folder.path() / "corner.obj", "v 0 0 0\nv 20 0 0\nv 0 20 0\nv 0 0 20\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const auto check = [&](const std::string& more) {
    write_file(folder.path() / "scene.yaml", "name: corner\nobjects:\n  - {name: corner, shape: {type: file, path: corner.obj" + more + "}, body: {type: affine, density: 1000}}\n");
    return run_tack(folder.path(), {"check", "scene.yaml"});
  };
  CHECK(contains(check(", unit: mm").out, "object 'corner': 20 x 20 x 20 mm, 0.001333 kg"));
  CHECK(contains(check(", unit: inch").out, "object 'corner': 508 x 508 x 508 mm"));
  CHECK(contains(check("").out, "object 'corner': 20 x 20 x 20 m, 1.333e+06 kg"));
  CHECK(contains(check(", unit: kg").err, "expects a unit of length, as m, mm, um or inch, got 'kg'"));
  write_file(folder.path() / "corner.obj", "v 0 0 0\nv 20 0 0\nv 0 20 0\nv 0 0 20\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
  CHECK(contains(check("").err, "its surface is not closed (edge") );
  CHECK(contains(check("").err, "close it (`tack mesh repair MESH -o NEW`, or `repair` among the steps of a shape `processed`)"));
}

TEST_CASE("misspelt operations on meshes are told from all of their names") {
  const TemporaryFolder folder;
  CHECK(contains(run_tack(folder.path(), {"mesh", "infos", "a.obj"}).err, "tack mesh: unknown operation 'infos'; did you mean 'info'? (operations: convert, cut, "));
  CHECK(contains(run_tack(folder.path(), {"mesh", "remsh", "a.obj"}).err, "did you mean 'remesh'?"));
}

TEST_CASE("a run makes no folders that stay empty") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", tiny_scene);
  REQUIRE(run_tack(folder.path(), {"run", "scene.yaml", "-q", "-o", "bare", "--set", "output.frames=false"}).exit_code == 0);
  CHECK_FALSE(fs::exists(folder.path() / "bare/frames"));
  CHECK_FALSE(fs::exists(folder.path() / "bare/checkpoints"));
  REQUIRE(run_tack(folder.path(), {"run", "scene.yaml", "-q", "-o", "full", "--set", "output.frames=true", "output.checkpoint_interval=10 ms"}).exit_code == 0);
  CHECK(fs::exists(folder.path() / "full/frames/frame_000000.vtu"));
  CHECK_FALSE(fs::is_empty(folder.path() / "full/checkpoints"));
}

TEST_CASE("check says how large, heavy and fast objects are, and how long the run is") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", tiny_scene);
  const std::string out = run_tack(folder.path(), {"check", "scene.yaml"}).out;
  CHECK(contains(out, "object 'block': 200 x 200 x 200 mm, 8 kg; 8 vertices"));
  CHECK(contains(out, "time: 5 steps of 10 ms, to 50 ms"));
  CHECK(contains(out, "; waves cross it in 6.325 ms (0.63 steps)"));  // 0.2 m sqrt(1000 / 1e6) s
  CHECK_FALSE(contains(out, "warning: "));
  CHECK(contains(run_tack(folder.path(), {"check", "scene.yaml", "--set", "time.adaptive={error: 1 mm, smallest: 1 us, largest: 20 ms}"}).out, "time: steps of 1 us to 20 ms, to 50 ms"));
  CHECK_FALSE(contains(run_tack(folder.path(), {"check", "scene.yaml", "--set", "time.integrator=quasi_static", "gravity=[0, 0, 0]"}).out, "waves"));
  CHECK(contains(run_tack(folder.path(), {"check", "scene.yaml", "--picture", "a.jpg"}).err, "a.jpg: names of pictures end in .png"));
  const std::string large = run_tack(folder.path(), {"check", "scene.yaml", "--set", "objects.block.shape.size=[200, 200, 200]", "objects.block.place.translate=[0, 100.1, 0]"}).out;
  CHECK(contains(large, "warning: object 'block' is 200 m large, and the largest other one 1 m: lengths without a unit are metres"));
}
