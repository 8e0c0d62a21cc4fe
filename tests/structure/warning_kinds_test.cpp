// Kinds of warnings are provoked by tests and documented.
#include "framework/core/warning_kind.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "tests/support/program.hpp"

using namespace tack;

TEST_CASE("every kind of warning is expected by a test", "[structure]") {
  const std::regex expected(R"((?:first|only)_text\([^;]*?\bWarningKind::([a-z_]+))");
  std::set<std::string> provoked;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(TACK_SOURCE_DIR "/tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = file_text(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), expected), end; at != end; ++at) provoked.insert((*at)[1]);
  }
  for (const WarningKindEntry& entry : warning_kinds) {
    INFO("no test has first_text(..., WarningKind::" << entry.key << ")");
    CHECK(provoked.contains(std::string(entry.key)));
  }
}

TEST_CASE("docs/results.md lists the kinds of warnings with their meanings", "[structure]") {
  const std::string page = file_text(TACK_SOURCE_DIR "/docs/results.md");
  std::string rows;
  for (const WarningKindEntry& entry : warning_kinds) rows += fmt::format("| `{}` | {} |\n", entry.key, entry.meaning);
  INFO("expected:\n" << rows);
  CHECK(contains(page, rows));
}

TEST_CASE("kinds of warnings are found by their keys", "[structure]") {
  for (const WarningKindEntry& entry : warning_kinds) {
    CHECK(warning_kind_of(entry.key) == entry.kind);
    CHECK(&entry_of(entry.kind) == &entry);
  }
  CHECK_FALSE(warning_kind_of("halved step"));
}
