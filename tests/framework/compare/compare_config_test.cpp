#include "framework/compare/compare_config.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "framework/compare/comparison.hpp"

using namespace tack;

TEST_CASE("every shipped comparison fits together", "[compare]") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TACK_SOURCE_DIR "/experiments/compare")) {
    INFO(entry.path());
    const CompareConfig config = load_comparison(entry.path().string(), {});
    const std::vector<CompareCase> cases = cases_of(config);
    CHECK(cases.size() == config.problems.size() + config.bases.size() + (config.base.empty() ? 0 : 1));
    for (const CompareCase& c : cases) CHECK(c.size > 0);
    ++files;
  }
  CHECK(files >= 4);
}
