// The status of a run from its results folder.
#include "framework/output/recorded_status.hpp"

#include <catch2/catch.hpp>

#include "framework/output/summary.hpp"
#include "geometry/io/replace_file.hpp"
#include "tests/support/program.hpp"

using namespace tack;

TEST_CASE("a run without a readable summary is unfinished", "[output]") {
  const TemporaryFolder folder;
  CHECK(recorded_status(folder.path()) == unfinished_status);
  for (const char* text : {"", "{\"status\": \"do", "[]", "{}", "{\"status\": null}", "{\"status\": \"\"}"}) {
    replace_file(folder.path() / "summary.json", text);
    CHECK(recorded_status(folder.path()) == unfinished_status);
  }
  RunSummary summary;
  summary.status = RunStatus::interrupted;
  write_summary(folder.path() / "summary.json", summary);
  CHECK(recorded_status(folder.path()) == to_string(RunStatus::interrupted));
  CHECK(recorded_status(nlohmann::ordered_json()) == unfinished_status);
}
