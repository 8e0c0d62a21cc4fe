// Numbers are read and written whatever the locale of an embedding program: with std::from_chars and {fmt}, never by what the C library does by the locale.
#include <catch2/catch.hpp>
#include <filesystem>
#include <regex>

#include "framework/config/number_text.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

TEST_CASE("no number goes by the locale", "[structure]") {
  const std::regex by_locale(R"(\b(strtod|strtof|strtold|stod|stof|stold|atof|sscanf|fscanf|sprintf|snprintf|fprintf)\s*\()");
  int files = 0;
  for (const char* top : {"geometry", "framework", "energies", "solvers", "python"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TACK_SOURCE_DIR) / top)) {
      if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
      INFO(entry.path());
      CHECK_FALSE(std::regex_search(file_text(entry.path()), by_locale));
      ++files;
    }
  CHECK(files > 300);
}

TEST_CASE("numbers at the beginning of a text", "[structure]") {
  const auto is = [](const char* text, double value, size_t length) {
    INFO(text);
    const NumberText number = number_text(text);
    CHECK(number.value == value);
    CHECK(number.length == length);
  };
  is("0.5 * w", 0.5, 3);
  is(".5", 0.5, 2);
  is("5.", 5, 2);
  is("1e3x", 1000, 3);
  is("2 mm", 2, 1);
  is("1,5", 1, 1);
  is("mm", 0, 0);
  is("1e999", std::numeric_limits<double>::infinity(), 5);
  is("1e-999", 0, 6);
}
