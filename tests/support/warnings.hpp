// Checks of warnings by kind.
#pragma once

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "tests/support/json.hpp"

namespace tack {

inline bool warned(const std::vector<Warning>& warnings, WarningKind kind) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const Warning& w) { return w.kind == kind; });
}

// Returns the text of the first warning of a kind; fails the test if there is none.
// tests/structure/warning_kinds_test.cpp looks for a call of it, or of only_text(), for each kind.
inline std::string first_text(const std::vector<Warning>& warnings, WarningKind kind) {
  INFO("expected: " << entry_of(kind).key << "; given: " << Catch::Detail::stringify(warnings));
  const auto found = std::find_if(warnings.begin(), warnings.end(),
                                  [&](const Warning& w) { return w.kind == kind; });
  REQUIRE(found != warnings.end());
  return found->text;
}

// Returns the text of the only warning; fails the test unless it is of that kind.
inline std::string only_text(const std::vector<Warning>& warnings, WarningKind kind) {
  const std::string text = first_text(warnings, kind);
  INFO(Catch::Detail::stringify(warnings));
  CHECK(warnings.size() == 1);
  return text;
}

// Returns the warnings of a summary.json.
inline std::vector<Warning> warnings_in(const std::filesystem::path& summary) {
  std::vector<Warning> warnings;
  const nlohmann::json json = read_json(summary);
  for (const auto& w : json["warnings"]) {
    const auto kind = warning_kind_of(w["kind"].get<std::string>());
    REQUIRE(kind);
    warnings.emplace_back(*kind, w["text"].get<std::string>());
  }
  return warnings;
}

}  // namespace tack
