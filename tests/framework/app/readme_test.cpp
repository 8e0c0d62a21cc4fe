// What the README shows is true: its scene is a file that runs, and the files it names exist.
#include <catch2/catch.hpp>
#include <regex>

#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

const fs::path source = TACK_SOURCE_DIR;

}  // namespace

TEST_CASE("the scene in the README is the one in experiments, and its run shows what it must") {
  const fs::path scene = source / "experiments/first/hang.yaml";
  CHECK(contains(file_text(source / "README.md"), "```yaml\n" + file_text(scene) + "```\n"));
  const TemporaryFolder folder;
  const ProgramResult result = run_tack(folder.path(), {"run", scene.string()});
  INFO(result.out << result.err);
  CHECK(result.exit_code == 0);
}

TEST_CASE("every link of the README and file of docs/design.md exists") {
  int links = 0;
  const auto check_all = [&](const std::string& text, const std::regex& name) {
    for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it, ++links) {
      INFO((*it)[1]);
      CHECK(fs::exists(source / (*it)[1].str()));
    }
  };
  check_all(file_text(source / "README.md"), std::regex(R"(\]\(([a-z][^)]*)\))"));
  check_all(file_text(source / "docs/design.md"), std::regex(R"(`((?:framework|solvers|geometry|tests)/[^`]*)`)"));
  CHECK(links > 20);
}

TEST_CASE("the README tells every exit code and command") {
  const std::string readme = file_text(source / "README.md");
  for (const char* code : {"| 0 |", "| 1 |", "| 2 |", "| 3 |", "| 130 |"}) CHECK(contains(readme, code));
  for (const char* command : {"tack run", "tack check", "tack compare", "tack batch", "tack list", "tack mesh info", "tack test"})
    CHECK(contains(readme, command));
}
