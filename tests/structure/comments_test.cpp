// Form of headers and comments: at most 100 columns, and the subject first.
#include <catch2/catch.hpp>

#include <set>

#include "tests/structure/source_texts.hpp"

using namespace tack;

namespace {

constexpr size_t columns_max = 100;

const std::vector<std::string> folders = {"energies/", "framework/", "geometry/",
                                          "python/",   "solvers/",   "tests/"};

// Comment lines of C++ code that open with "What" or "Of". The bound falls; it never rises.
constexpr int openings_max = 9;

// Returns the number of characters of a line in UTF-8.
size_t columns(const std::string& line) {
  return static_cast<size_t>(std::count_if(line.begin(), line.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
  }));
}

bool opens_with_what_or_of(const std::string& line) {
  const size_t slashes = line.find("//");
  if (slashes == std::string::npos || line.find_first_not_of(' ') != slashes) return false;
  const size_t word = line.find_first_not_of("/ ", slashes);
  if (word == std::string::npos) return false;
  const std::string first = line.substr(word, line.find(' ', word) - word);
  return first == "What" || first == "Of";
}

}  // namespace

TEST_CASE("lines of headers have at most 100 columns", "[structure]") {
  std::set<std::string> found;
  for (const SourceText& source : source_texts()) {
    if (!source.path.ends_with(".hpp")) continue;
    for (const std::string& prefix : folders) {
      if (!source.path.starts_with(prefix)) continue;
      found.insert(prefix);
      int number = 0;
      for (const std::string& line : lines_of(source.text)) {
        ++number;
        if (columns(line) <= columns_max) continue;
        INFO(source.path << ":" << number << "\n" << line);
        CHECK(false);
      }
    }
  }
  for (const std::string& prefix : folders) {
    INFO(prefix << " has no headers");
    CHECK(found.count(prefix) == 1);
  }
}

TEST_CASE("no more comments open with What or Of", "[structure]") {
  CHECK(opens_with_what_or_of("  // Of a pair: what it does"));
  CHECK(opens_with_what_or_of("// What a pair does"));
  CHECK_FALSE(opens_with_what_or_of("// Often"));
  CHECK_FALSE(opens_with_what_or_of("int a;  // Of a pair"));
  int openings = 0;
  for (const SourceText& source : source_texts()) {
    if (!source.code()) continue;
    for (const std::string& line : lines_of(source.text)) openings += opens_with_what_or_of(line);
  }
  CHECK(openings <= openings_max);
}
