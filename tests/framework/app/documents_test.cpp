// Checks the README and docs/: their scenes are files that run, and the files they name exist.
#include <catch2/catch.hpp>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

const fs::path source = TACK_SOURCE_DIR;

// The README and every page below docs/.
std::vector<fs::path> documents() {
  std::vector<fs::path> all = {source / "README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(source / "docs"))
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  return all;
}

// Pages that describe the code as it is. docs/log keeps the file names of its time.
bool describes_the_present(const fs::path& page) {
  const std::string folder = page.parent_path().filename().string();
  return folder == "decisions" || folder == "developer" || page.filename() == "design.md";
}

// Returns the first group of every match of the pattern in a text.
std::vector<std::string> all_matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it) found.push_back((*it)[1].str());
  return found;
}

// The anchor that a heading gets on the web: lower case, without punctuation, hyphens for spaces.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : std::regex_replace(heading, std::regex(R"(\[([^\]]*)\]\([^)]*\))"), "$1")) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') anchor += '-';
    else if (std::isalnum(byte) || c == '_' || c == '-' || byte >= 0x80) anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

// The anchors of a page: its headings, and `<a id="...">`.
std::set<std::string> anchors_of(const std::string& text) {
  const std::vector<std::string> ids = all_matches(text, std::regex(R"re(<a id="([^"]+)")re"));
  std::set<std::string> anchors(ids.begin(), ids.end());
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const size_t level = line.find_first_not_of('#');
    if (level != std::string::npos && level > 0 && line[level] == ' ') anchors.insert(anchor_of(line.substr(level + 1)));
  }
  return anchors;
}

// The fenced blocks of a language.
std::vector<std::string> blocks(const std::string& text, const std::string& language) {
  const std::string fence = "```" + language + "\n";
  std::vector<std::string> found;
  for (size_t at = text.find(fence); at != std::string::npos; at = text.find(fence, at)) {
    at += fence.size();
    const size_t end = text.find("```\n", at);
    found.push_back(text.substr(at, end - at));
    at = end;
  }
  return found;
}

}  // namespace

TEST_CASE("the scene in docs/scenes.md is the one in experiments, and its expectations hold") {
  const fs::path scene = source / "experiments/first/hang.yaml";
  CHECK(contains(file_text(source / "docs/scenes.md"), "```yaml\n" + file_text(scene) + "```\n"));
  const TemporaryFolder folder;
  const ProgramResult result = run_tack(folder.path(), {"run", scene.string()});
  INFO(result.out << result.err);
  CHECK(result.exit_code == 0);
}

TEST_CASE("excerpts of files in the README equal the files") {
  const std::string readme = file_text(source / "README.md");
  std::string experiments;
  for (const auto& entry : fs::recursive_directory_iterator(source / "experiments"))
    if (entry.path().extension() == ".yaml") experiments += file_text(entry.path());
  const std::vector<std::string> yaml = blocks(readme, "yaml"), law = blocks(readme, "cpp");
  CHECK(yaml.size() == 1);
  CHECK(law.size() == 1);
  for (const std::string& block : yaml) {
    INFO(block);
    CHECK(contains(experiments, block));
  }
  for (const std::string& block : law) {
    INFO(block);
    CHECK(contains(file_text(source / "docs/extending.md"), block));
  }
}

TEST_CASE("every link, anchor included, of the README and docs and every file that pages on the code name exists") {
  const std::regex link_to(R"(\]\(([^)\s]+)\))"), code(R"(`((?:framework|solvers|energies|geometry|tests)/[^`\s]*)`)");
  int links = 0, files = 0;
  for (const fs::path& document : documents()) {
    const std::string text = file_text(document);
    for (const std::string& link : all_matches(text, link_to)) {
      if (link.starts_with("http:") || link.starts_with("https:")) continue;
      INFO(document.string() << " links to " << link);
      const size_t hash = link.find('#');
      const fs::path target = hash == 0 ? document : document.parent_path() / link.substr(0, hash);
      REQUIRE(fs::exists(target));
      if (hash != std::string::npos && target.extension() == ".md") CHECK(anchors_of(file_text(target)).contains(link.substr(hash + 1)));
      ++links;
    }
    if (!describes_the_present(document)) continue;
    for (const std::string& file : all_matches(text, code)) {
      INFO(document.string() << " names " << file);
      CHECK(fs::exists(source / file));
      ++files;
    }
  }
  CHECK(links > 300);
  CHECK(files > 200);
}

// Each theory page ends with the files that implement it and the tests that check it, so a file that moves takes its name there along.
TEST_CASE("every file that a page of docs/theory names exists") {
  const std::regex code(R"(`((?:energies|framework|geometry|solvers|tests)/[^`\s]*)`)");
  int pages = 0;
  for (const auto& entry : fs::directory_iterator(source / "docs/theory")) {
    if (entry.path().extension() != ".md") continue;
    for (const std::string& file : all_matches(file_text(entry.path()), code)) {
      INFO(entry.path().string() << " names " << file);
      CHECK(fs::exists(source / file));
    }
    ++pages;
  }
  CHECK(pages >= 10);
}

TEST_CASE("the index of docs names every page and schema") {
  const std::string index = file_text(source / "docs/README.md");
  int named = 0;
  for (const auto& entry : fs::directory_iterator(source / "docs")) {
    const fs::path extension = entry.path().extension();
    const std::string name = entry.path().filename().string();
    if ((extension != ".md" && extension != ".json") || name == "README.md") continue;
    INFO(name);
    CHECK(contains(index, "](" + name + ")"));
    ++named;
  }
  CHECK(named > 15);
}

TEST_CASE("the index of a folder of docs names each of its pages") {
  int named = 0;
  for (const char* folder : {"decisions", "developer", "log", "reference"}) {
    const std::string index = file_text(source / "docs" / folder / "README.md");
    for (const auto& entry : fs::directory_iterator(source / "docs" / folder)) {
      const std::string name = entry.path().filename().string();
      if (entry.path().extension() != ".md" || name == "README.md") continue;
      INFO(folder << "/" << name);
      CHECK(contains(index, "](" + name + ")"));
      ++named;
    }
  }
  CHECK(named > 100);
}

TEST_CASE("the documents tell every exit code and command") {
  const std::string results = file_text(source / "docs/results.md"), readme = file_text(source / "README.md");
  for (const char* code : {"| 0 |", "| 1 |", "| 2 |", "| 3 |", "| 130 |"}) CHECK(contains(results, code));
  for (const char* command : {"tack run", "tack check", "tack profile", "tack compare", "tack batch", "tack calibrate", "tack plot", "tack report", "tack view", "tack list", "tack law",
                              "tack mesh info", "tack completion", "tack test", "tack bench"})
    CHECK(contains(readme, command));
}

// docs/pictures/gallery.sh runs the scene of each, and draws it by its view. Bases NAME_000, NAME_010, ... are one picture.
TEST_CASE("every picture of the gallery is drawn by a view of a run of the scene that it tells of") {
  const std::string gallery = file_text(source / "docs/gallery.md"), batch = file_text(source / "experiments/batches/gallery.yaml");
  CHECK(contains(gallery, "docs/pictures/gallery.sh"));
  CHECK(fs::exists(source / "docs/pictures/gallery.sh"));
  const std::regex row(R"(\| !\[[^\]]*\]\(images/gallery/(\w+)\.png\) \|.*`\./tack run experiments/(\S+\.yaml)`)");
  int pictures = 0;
  std::set<std::string> names;
  for (std::sregex_iterator it(gallery.begin(), gallery.end(), row), end; it != end; ++it, ++pictures) {
    const std::string name = (*it)[1], scene = (*it)[2];
    INFO(name);
    names.insert(name);
    CHECK(std::regex_search(batch, std::regex("  - \\{name: " + name + "(_[0-9]+)?, file: \\.\\./" + std::regex_replace(scene, std::regex("\\."), "\\.") + "\\}\n")));
    CHECK(contains(file_text(source / "docs/pictures" / (name + ".yaml")), "docs/images/gallery/" + name + ".png"));
    CHECK(fs::exists(source / "docs/images/gallery" / (name + ".png")));
  }
  CHECK(pictures == static_cast<int>(all_matches(gallery, std::regex("(images/gallery/)")).size()));
  std::set<std::string> drawn;
  for (const std::string& base : all_matches(batch, std::regex("  - \\{name: (\\w+),"))) drawn.insert(std::regex_replace(base, std::regex("_[0-9]+$"), ""));
  CHECK(drawn == names);
}

TEST_CASE("every picture of the documents has one maker and a document that shows it") {
  const fs::path pictures = source / "docs/pictures", images = source / "docs/images";
  const std::string script = file_text(pictures / "make.sh");
  std::map<std::string, int> makers;
  for (const std::string& made : all_matches(script, std::regex(R"((?:[= ]|\$images/)(\w+\.(?:svg|png)))"))) ++makers[made];
  for (const auto& view : fs::directory_iterator(pictures))
    for (const std::string& drawn : all_matches(file_text(view.path()), std::regex("^# How docs/images/(gallery/\\S+) is drawn"))) ++makers[drawn];
  std::set<std::string> shown;
  for (const fs::path& page : documents())
    for (const std::string& image : all_matches(file_text(page), std::regex(R"(images/([\w/]+\.(?:svg|png))\b)"))) shown.insert(image);
  for (const auto& image : fs::recursive_directory_iterator(images)) {
    if (image.is_directory()) continue;
    const std::string name = fs::relative(image.path(), images).generic_string();
    INFO(name);
    CHECK(makers[name] == 1);
    CHECK(shown.count(name) == 1);
  }
  for (const auto& [name, count] : makers) {
    INFO(name);
    CHECK(fs::exists(images / name));
  }
}

TEST_CASE("the batch in docs/batches.md runs as it stands there") {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "first");
  fs::create_directories(folder.path() / "batches");
  fs::copy(source / "experiments/first/hang.yaml", folder.path() / "first/hang.yaml");
  write_file(folder.path() / "batches/cubes.yaml", blocks(file_text(source / "docs/batches.md"), "yaml").front());
  const ProgramResult result = run_tack(folder.path(), {"batch", "batches/cubes.yaml", "-o", "out"});
  INFO(result.out << result.err);
  CHECK(result.exit_code == 0);
  CHECK(contains(result.out, "cubes: 8 cases: 8 done"));
  CHECK(contains(file_text(folder.path() / "out/results.csv").substr(0, 60), "young"));
}
