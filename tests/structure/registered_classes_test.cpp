// Registered classes have names of their own. Most stand in unnamed namespaces, and programs of
// Clang tell the types of these apart by their names alone.
#include <catch2/catch.hpp>

#include <map>

#include "tests/structure/source_texts.hpp"

using namespace tack;

TEST_CASE("no two registered classes have one name", "[structure]") {
  std::map<std::string, std::string> file_of;
  const std::string macro = "TACK_REGISTER(";
  for (const SourceText& source : source_texts()) {
    if (source.path.starts_with("tests/") || !source.path.ends_with(".cpp")) continue;
    for (size_t at = source.text.find(macro); at != std::string::npos; at = source.text.find(macro, at + 1)) {
      const size_t begin = source.text.find_first_not_of(" \n", source.text.find(',', at) + 1);
      const std::string name = source.text.substr(begin, source.text.find(',', begin) - begin);
      INFO(source.path << ": " << name);
      const auto [known, is_new] = file_of.emplace(name, source.path);
      CHECK(known->second == source.path);
      CHECK(is_new);
    }
  }
  CHECK(file_of.size() > 100);
}
