// Experiments that show adhesion or friction fail without it: the expectations that name the effect can tell.
#include <catch2/catch.hpp>

#include "tests/support/json.hpp"
#include "tests/support/program.hpp"

namespace tack {
namespace {

// A change that takes away what a scene shows, and the expectations that must fail by it, of which others may fail too.
struct Sabotage {
  std::string scene, change;
  Arguments set;
  std::vector<std::string> fails;
};

const std::vector<Sabotage>& sabotages() {
  static const std::vector<Sabotage> table = {
      {"wall_cube/detaches", "half the adhesion", {"contact.pairs.0.adhesion.peak_traction=4 kPa"}, {"friction holds it up", "so that it falls slowly at first"}},
      {"wall_cube/detaches", "no friction", {"contact.pairs.0.friction.mu=0"}, {"friction holds it up", "it turns", "it detaches"}},
      {"wall_cube/detaches", "no tangential adhesion", {"contact.pairs.0.tangential_adhesion.mu=0"}, {"so that it falls slowly at first"}},
      {"wall_cube/stuck", "half the adhesion", {"contact.pairs.0.adhesion.peak_traction=50 kPa"}, {"it hardly sinks", "it stays attached"}},
      {"wall_cube/stuck", "a twentieth of the tangential adhesion", {"contact.pairs.0.tangential_adhesion.mu=0.05"}, {"tangential adhesion carries it", "it hardly sinks"}},
      {"debonding/pull", "half the adhesion", {"contact.pairs.0.adhesion.critical_strain=0.05"}, {"peak adhesive force", "adhesive force at dhat_p", "work of separation"}},
      {"debonding/peel", "half the adhesion", {"contact.pairs.0.adhesion.critical_strain=0.05"}, {"lower peak than pull.yaml"}},
      {"cleaning_gel/strain_030", "a third of the adhesion", {"contact.pairs.0.adhesion.critical_strain=0.1", "contact.pairs.1.adhesion.critical_strain=0.1"}, {"it takes what is loose, and of what sticks a little"}},
      {"cleaning_gel/strain_050", "three fifths of the adhesion", {"contact.pairs.0.adhesion.critical_strain=0.3", "contact.pairs.1.adhesion.critical_strain=0.3"}, {"it takes of all kinds of dust"}},
      {"wall_cube/stuck_rough", "no friction", {"contact.pairs.0.friction.mu=0"}, {"friction takes its part"}},
      {"spider_web/octopus", "a tenth of the adhesion", {"contact.pairs.0.adhesion.peak_traction=3 kPa"}, {"the octopus hangs in the web", "and adheres to the end", "the ends carry 1.09 N of it and 0.19 N of the web"}},
      {"spider_web/octopus", "a third of the adhesion", {"contact.pairs.0.adhesion.peak_traction=10 kPa"}, {"and tangential adhesion holds it where it hangs"}},
      {"spider_web/octopus", "no friction", {"contact.pairs.0.friction.mu=0"}, {"friction takes part"}},
      {"spider_web/octopus", "no tangential adhesion", {"contact.pairs.0.tangential_adhesion.mu=0"}, {"and tangential adhesion holds it where it hangs"}},
      {"chips_bag/chips_bag", "a third of the adhesion", {"contact.pairs.0.adhesion.peak_traction=0.3 kPa"}, {"and its pressure"}},
      {"sticky_toys/throw", "half the adhesion", {"contact.pairs.1.adhesion.peak_traction=1.5 kPa"}, {"most stick"}},
      {"twist/twisted_cloth", "half the adhesion", {"contact.pairs.0.adhesion.peak_traction=250 Pa"}, {"much of it sticks when it is wound up", "some still sticks"}},
      {"wax_seal/seal", "no adhesion", {"contact.pairs=[]"}, {"the wax lies on the letter", "with all of its foot"}},
  };
  return table;
}

void check_sabotage(const std::string& scene) {
  bool any = false;
  for (const Sabotage& s : sabotages()) {
    if (s.scene != scene) continue;
    any = true;
    CAPTURE(s.change);
    const TemporaryFolder folder;
    Arguments arguments = {"run", TACK_SOURCE_DIR "/experiments/" + scene + ".yaml", "-o", "out", "-q", "--set", "output.frames=false"};
    for (const std::string& change : s.set) arguments.insert(arguments.end(), {"--set", change});
    const ProgramResult result = run_tack(folder.path(), arguments, TACK_PROGRAM, std::chrono::minutes(60));
    INFO(result.out << result.err);
    CHECK(result.exit_code == 1);
    REQUIRE(std::filesystem::exists(folder.path() / "out/summary.json"));
    const nlohmann::json summary = read_json(folder.path() / "out/summary.json");
    for (const std::string& name : s.fails) {
      CAPTURE(name);
      bool found = false;
      for (const auto& e : summary["expect"]) {
        if (e["name"] != name) continue;
        found = true;
        CHECK_FALSE(e["pass"].get<bool>());
      }
      CHECK(found);
    }
  }
  REQUIRE(any);
}

TEST_CASE("sabotage: wall_cube/detaches", "[nightly]") { check_sabotage("wall_cube/detaches"); }
TEST_CASE("sabotage: debonding/pull", "[nightly]") { check_sabotage("debonding/pull"); }
TEST_CASE("sabotage: debonding/peel", "[nightly]") { check_sabotage("debonding/peel"); }
TEST_CASE("sabotage: cleaning_gel/strain_030", "[nightly]") { check_sabotage("cleaning_gel/strain_030"); }
TEST_CASE("sabotage: cleaning_gel/strain_050", "[nightly]") { check_sabotage("cleaning_gel/strain_050"); }
TEST_CASE("sabotage: wall_cube/stuck", "[nightly]") { check_sabotage("wall_cube/stuck"); }
TEST_CASE("sabotage: wall_cube/stuck_rough", "[nightly]") { check_sabotage("wall_cube/stuck_rough"); }
TEST_CASE("sabotage: spider_web/octopus", "[nightly]") { check_sabotage("spider_web/octopus"); }
TEST_CASE("sabotage: chips_bag/chips_bag", "[nightly]") { check_sabotage("chips_bag/chips_bag"); }
TEST_CASE("sabotage: sticky_toys/throw", "[nightly]") { check_sabotage("sticky_toys/throw"); }
TEST_CASE("sabotage: twist/twisted_cloth", "[nightly]") { check_sabotage("twist/twisted_cloth"); }
TEST_CASE("sabotage: wax_seal/seal", "[nightly]") { check_sabotage("wax_seal/seal"); }

}  // namespace
}  // namespace tack
