// Files that comments and pages name exist.
#include <catch2/catch.hpp>

#include <regex>
#include <set>

#include "tests/structure/source_texts.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// Files that tack, its build or the reader of a page writes, and placeholders.
const std::set<std::string> written = {"compare.md", "x_test.cpp", "interface_note.cpp"};
// Pages on which the reader writes components of their own.
const std::set<std::string> pages_of_own_files = {"docs/plugins.md"};

// Returns the names of .hpp, .cpp and .md files in a comment or on a line of a page. Absolute paths,
// addresses and patterns are no names.
std::vector<std::string> names_in(const std::string& text) {
  static const std::regex name(R"((^|[^\w./*<>{}-])((?:\.\./)*(?:[\w-]+/)*[\w-]+\.(?:hpp|cpp|md))(?![\w]))");
  std::vector<std::string> names;
  for (std::sregex_iterator i(text.begin(), text.end(), name), end; i != end; ++i)
    names.push_back((*i)[2]);
  return names;
}

class Tree {
 public:
  explicit Tree(const std::vector<SourceText>& sources) {
    for (const SourceText& source : sources) add(source.path);
    const fs::path root = TACK_SOURCE_DIR;
    for (const auto& entry : fs::directory_iterator(root))
      if (entry.is_regular_file()) add(entry.path().filename().string());
    for (const char* more : {"docs/log", "experiments", "packaging", "cmake"})
      if (fs::exists(root / more))
        for (const auto& entry : fs::recursive_directory_iterator(root / more))
          if (entry.is_regular_file()) add(fs::relative(entry.path(), root).generic_string());
  }

  // Returns whether a name in `file` is a path from the root, from the folder of the file, or the end
  // of a path.
  bool has(const std::string& name, const std::string& file) const {
    const std::string relative =
        (fs::path(file).parent_path() / name).lexically_normal().generic_string();
    return ends_.count(name) != 0 || paths_.count(relative) != 0;
  }

 private:
  void add(const std::string& path) {
    paths_.insert(path);
    ends_.insert(path);
    for (size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
      ends_.insert(path.substr(slash + 1));
  }

  std::set<std::string> paths_, ends_;
};

}  // namespace

TEST_CASE("names of files are found in comments", "[structure]") {
  CHECK(names_in("// See a.hpp, (b/c_d.cpp) and `../docs/e.md`.") ==
        std::vector<std::string>{"a.hpp", "b/c_d.cpp", "../docs/e.md"});
  CHECK(names_in("// *.hpp, {a,b}.cpp, /usr/include/x.hpp, a.hppx, a.mdl").empty());
  CHECK(comment_of("int a = 0;  // b.hpp") == "// b.hpp");
  CHECK(comment_of("f(\"http://a.hpp\");").empty());
}

TEST_CASE("every file that a comment or a page names exists", "[structure]") {
  const std::vector<SourceText> sources = source_texts();
  const Tree tree(sources);
  int names = 0;
  for (const SourceText& source : sources) {
    if (!source.page() && !source.code()) continue;
    if (source.path == "tests/structure/named_files_test.cpp") continue;
    if (pages_of_own_files.count(source.path) != 0) continue;
    int number = 0;
    for (const std::string& line : lines_of(source.text)) {
      ++number;
      for (const std::string& name : names_in(source.page() ? line : comment_of(line))) {
        ++names;
        if (written.count(fs::path(name).filename().string()) != 0) continue;
        INFO(source.path << ":" << number << " names " << name);
        CHECK(tree.has(name, source.path));
      }
    }
  }
  CHECK(names > 500);
}
