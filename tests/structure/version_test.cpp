// CMakeLists.txt has the version. The changelog and the citation repeat it, because releases and readers need it there; documents name it in file names.
#include <catch2/catch.hpp>
#include <regex>

#include "framework/output/provenance.hpp"
#include "tests/support/program.hpp"

using namespace tack;

namespace {

// Returns the first match of a group in a file of the tree, "" without one.
std::string first_match(const std::string& path, const std::string& pattern) {
  const std::string text = file_text(std::string(TACK_SOURCE_DIR) + "/" + path);
  std::smatch match;
  return std::regex_search(text, match, std::regex(pattern)) ? match[1].str() : "";
}

}  // namespace

TEST_CASE("one version everywhere", "[structure]") {
  const std::string version = this_build().version;
  CHECK(first_match("CMakeLists.txt", R"(project\(tack VERSION ([0-9.]+) )") == version);
  CHECK(first_match("CHANGELOG.md", R"(\n## ([0-9.]+) - [0-9]{4}-[0-9]{2}-[0-9]{2}\n)") == version);
  CHECK(first_match("CITATION.cff", R"(\nversion: ([0-9.]+)\n)") == version);
  CHECK(first_match("CITATION.cff", R"(\ndate-released: ([0-9-]+)\n)") == first_match("CHANGELOG.md", R"(\n## [0-9.]+ - ([0-9-]+)\n)"));
  CHECK(first_match("docs/installing.md", R"(tack_([0-9.]+)_amd64\.deb)") == version);
  CHECK(first_match("docs/plugins.md", R"(find_package\(tack ([0-9.]+) )") == version.substr(0, version.rfind('.')));
}
