// A bond law is one file: that of docs/extending.md, which the build extracts and calls
// `documented_bond` (documented_law.cmake). The tests of all bond laws (bond_laws_test.cpp) include
// it.
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/config/describe.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "tests/support/bond_laws.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;

TEST_CASE("the documented law with history fits on a page") {
  const std::string page = file_text(TACK_SOURCE_DIR "/docs/extending.md");
  const size_t begin = page.find("```cpp\n", page.find("\n## A cohesive law with history variables\n")), end = page.find("```\n", begin + 7);
  REQUIRE(end != std::string::npos);
  CHECK(std::count(page.begin() + begin, page.begin() + end, '\n') <= 50);
}

TEST_CASE("laws of adhesion are listed with their traits") {
  const std::string list = list_kind("adhesion");
  CHECK(contains(list, "  documented_bond "));
  CHECK_THAT(list_component("adhesion", "documented_bond"), Catch::Contains("\nIrreversible, history-dependent, mixed-mode (normal and tangential)\n") &&
                                                                  Catch::Contains("documented_bond_law.cpp"));
  CHECK_THAT(list_component("adhesion", "fang"), Catch::Contains("\nReversible, history-independent, normal only\n"));
  CHECK_THAT(list_component("adhesion", "xu_needleman_coupled"), Catch::Contains("\nReversible, history-independent, mixed-mode (normal and tangential)\n"));
  CHECK(contains(list, "    Irreversible, history-dependent, mixed-mode (normal and tangential)\n"));
  CHECK(contains(reference_page(prototype<Experiment>(), "Scene"), "Reversible, history-independent, normal only.\n"));
}

TEST_CASE("a scene that names the documented law has bonds of it") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", tiny_scene_with("{type: fang, critical_strain: 0.001}", "{type: documented_bond, work_of_adhesion: 2 J/m^2}"));
  const BuiltExperiment built(load_experiment((folder.path() / "scene.yaml").string(), {}));
  const World& world = built.world();
  REQUIRE(world.adhesion.size() == 1);
  CHECK(world.adhesion[0].work_of_adhesion == 2);
  CHECK(world.adhesion[0].peak_traction == Approx(4 * std::sqrt(2e8 / 27)));
}

TEST_CASE("the documented law with history follows its closed form") {
  const auto law = bond_law("{type: documented_bond}");
  PulledBond bond(*law);
  for (const double d : {2e-5, 1e-4, 1.5e-4}) {
    bond.pull(d, 0, 100, 1e-2);
    CHECK(bond.traction() == Approx(1e8 * d * (1 - 1e8 * d * d / 4)));
    CHECK(bond.dissipated() == Approx(std::pow(1e8 * d * d / 4, 2)));
    CHECK(bond.step(d / 2, 0, 1e-2).by_d == Approx(1e8 * d / 2 * (1 - 1e8 * d * d / 4)));
  }
  bond.pull(2.1e-4, 0, 1000, 1e-2);
  CHECK(bond.change().gone);
  CHECK(bond.dissipated() == Approx(1));
}
