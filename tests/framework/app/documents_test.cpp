// What the documents show is true: the scene in them is a file that runs, and what they link to exists.
#include <catch2/catch.hpp>
#include <regex>

#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

const fs::path source = TACK_SOURCE_DIR;

std::vector<fs::path> documents() {
  std::vector<fs::path> found = {source / "README.md"};
  for (const auto& entry : fs::directory_iterator(source / "docs"))
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

}  // namespace

TEST_CASE("the scene in the documents is the one in experiments, and its run shows what it must") {
  const fs::path scene = source / "experiments/first/hang.yaml";
  CHECK(contains(file_text(source / "docs/scenes.md"), "```yaml\n" + file_text(scene) + "```\n"));
  const TemporaryFolder folder;
  const ProgramResult result = run_tack(folder.path(), {"run", scene.string()});
  INFO(result.out << result.err);
  CHECK(result.exit_code == 0);
}

TEST_CASE("every link and picture of the documents exists, and every file that docs/design.md names") {
  int links = 0;
  const auto check_all = [&](const fs::path& document, const fs::path& folder, const std::regex& name) {
    const std::string text = file_text(document);
    for (std::sregex_iterator it(text.begin(), text.end(), name), end; it != end; ++it, ++links) {
      INFO(document << ": " << (*it)[1]);
      CHECK(fs::exists(folder / (*it)[1].str()));
    }
  };
  // Of a page itself: neither of the web nor of a place within.
  const std::regex link(R"(\]\((?!https?:|#|file:)([^)#\s]+)(#[^)\s]*)?\))");
  for (const fs::path& document : documents())
    if (document.filename() != "reference.md") check_all(document, document.parent_path(), link);
  CHECK(links > 100);
  check_all(source / "docs/design.md", source, std::regex(R"(`((?:framework|solvers|geometry|tests)/[^`]*)`)"));
}

TEST_CASE("the index of the documents names each of them") {
  const std::string index = file_text(source / "docs/README.md");
  for (const fs::path& document : documents())
    if (document.filename() != "README.md") {
      INFO(document);
      CHECK(contains(index, "(" + document.filename().string() + ")"));
    }
}

TEST_CASE("the documents tell every exit code and command") {
  for (const char* code : {"| 0 |", "| 1 |", "| 2 |", "| 3 |", "| 130 |"}) CHECK(contains(file_text(source / "docs/results.md"), code));
  for (const char* command : {"tack run", "tack check", "tack compare", "tack batch", "tack list", "tack mesh info", "tack plot", "tack report",
                              "tack profile", "tack test"})
    CHECK(contains(file_text(source / "README.md"), command));
}
