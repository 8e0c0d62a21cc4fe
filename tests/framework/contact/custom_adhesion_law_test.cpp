// An adhesion law is one file: that of docs/extending.md, which the build extracts and calls
// `documented` (documented_law.cmake). The file alone adds the law to scenes, listings, the schema
// and the reference page.
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/config/describe.hpp"
#include "framework/config/parse.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;

namespace {

const std::string fang = "{type: fang, critical_strain: 0.001}";
constexpr const char* documented = "{type: documented, strength: 2 kPa, range: 4 mm}";

LoadedExperiment scene_with(const std::string& adhesion) {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", tiny_scene_with(fang, adhesion));
  return load_experiment((folder.path() / "scene.yaml").string(), {});
}

std::unique_ptr<NormalLaw> prepared_law() {
  const LoadedExperiment scene = scene_with(documented);
  auto law = dynamic_cast<const NormalAdhesion&>(*scene.experiment.contact->pairs[0].adhesion).clone();
  law->prepare({.contact_distance = 1e-3});
  return law;
}

}  // namespace

TEST_CASE("the documented law fits on a page, and a copy may be registered beside it") {
  const std::string page = file_text(TACK_SOURCE_DIR "/docs/extending.md");
  const size_t begin = page.find("```cpp\n"), end = page.find("```\n", begin + 7);
  REQUIRE(end != std::string::npos);
  CHECK(std::count(page.begin() + begin, page.begin() + end, '\n') <= 41);
  // Here it has another name: a second registration would end this program at its start.
  const auto at = page.find("TACK_REGISTER(AdhesionLaw, SmoothAdhesion, \"smooth\"", begin);
  CHECK(at < end);
  const auto names = Registry<AdhesionLaw>::kind().names();
  CHECK(std::count(names.begin(), names.end(), "documented") == 1);
}

TEST_CASE("a law is listed, documented and in the schema because it exists") {
  CHECK(contains(list_kind("adhesion"), "documented"));
  CHECK(contains(list_component("adhesion", "documented"), "documented_law.cpp"));
  const std::string page = reference_page(prototype<Experiment>(), "Scene");
  CHECK(contains(page, "### adhesion `documented`"));
  CHECK(contains(page, "| `strength` |"));
  CHECK(contains(json_schema(prototype<Experiment>(), "scene"), "\"documented\""));
}

TEST_CASE("a scene that names the law gets it") {
  const BuiltExperiment built(scene_with(documented));
  const World* const world = &built.world();
  REQUIRE(world->adhesion.size() == 1);
  CHECK(world->adhesion[0].peak_traction == 2000);
  CHECK(world->adhesion[0].work_of_adhesion == Approx(2000 * 4e-3 * 0.582309));
  CHECK(world->adhesion[0].effective < world->adhesion[0].work_of_adhesion);
}

TEST_CASE("the law's value, slope and curvature agree and vanish at its range") {
  const auto law = prepared_law();
  for (const double d : {1e-5, 5e-4, 1e-3, 4e-3 / std::sqrt(5.0), 2.5e-3, 3.9e-3}) {
    const double h = 1e-7;
    const LawSample at = law->at(d), below = law->at(d - h), above = law->at(d + h);
    CHECK(at.slope == Approx((above.value - below.value) / (2 * h)).epsilon(1e-5));
    CHECK(at.curvature == Approx((above.slope - below.slope) / (2 * h)).epsilon(1e-5).margin(1));
  }
  const LawSample end = law->at(4e-3 * (1 - 1e-9)), beyond = law->at(4e-3);
  CHECK(std::abs(end.value) < 1e-20);
  CHECK(std::abs(end.slope) < 1e-10);
  CHECK(std::abs(end.curvature) < 0.1);  // of up to 4e6 Pa/m
  CHECK(beyond.value == 0);
  CHECK(beyond.slope == 0);
  CHECK(beyond.curvature == 0);
}

TEST_CASE("the law's peak and work are those of its curve") {
  const auto law = prepared_law();
  double peak = 0, work = 0;
  const int n = 4000;
  for (int i = 0; i < n; ++i) {
    const double slope = law->at((i + 0.5) * 4e-3 / n).slope;
    peak = std::max(peak, slope);
    work += slope * 4e-3 / n;
  }
  const auto& adhesion = dynamic_cast<const AdhesionLaw&>(*law);
  CHECK(peak == Approx(adhesion.peak_traction()).epsilon(1e-6));
  CHECK(work == Approx(adhesion.work_of_adhesion()).epsilon(1e-6));
}

TEST_CASE("the law refuses a range that peaks under the barrier, at its place in the scene") {
  CHECK_THROWS_WITH(BuiltExperiment(scene_with("{type: documented, range: 2 mm}")), Catch::Contains("scene.yaml:16:7: adhesion smooth:") &&
                                         Catch::Contains("raise range"));
}
