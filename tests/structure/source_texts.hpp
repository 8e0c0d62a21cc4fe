// Texts of the source tree for tests of its structure: code, comments and pages. Logs
// (docs/log/), which quote old names, are left out.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/program.hpp"

namespace tack {

struct SourceText {
  std::string path;  // relative to the source tree, with slashes
  std::string text;
  bool page() const { return path.ends_with(".md"); }
  bool code() const { return path.ends_with(".hpp") || path.ends_with(".cpp"); }
};

// Returns the C++ files, Python files and pages of the source tree, sorted by path.
inline std::vector<SourceText> source_texts() {
  namespace fs = std::filesystem;
  const fs::path source = TACK_SOURCE_DIR;
  std::vector<SourceText> all;
  const auto add = [&](const fs::path& path) {
    const std::string relative = fs::relative(path, source).generic_string();
    const fs::path extension = path.extension();
    if (extension != ".hpp" && extension != ".cpp" && extension != ".md" && extension != ".py")
      return;
    if (relative.starts_with("docs/log/")) return;
    all.push_back({relative, file_text(path)});
  };
  for (const char* top :
       {"geometry", "framework", "energies", "solvers", "python", "report", "tests", "docs"})
    for (const auto& entry : fs::recursive_directory_iterator(source / top))
      if (entry.is_regular_file()) add(entry.path());
  add(source / "README.md");
  std::sort(all.begin(), all.end(),
            [](const SourceText& a, const SourceText& b) { return a.path < b.path; });
  return all;
}

// Returns the lines of a text, without their newlines.
inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return lines;
}

// Returns the comment of a line of code ("" without one), from its slashes on.
inline std::string comment_of(const std::string& line) {
  bool quoted = false;
  for (size_t i = 0; i + 1 < line.size(); ++i) {
    if (line[i] == '\\') ++i;
    else if (line[i] == '"') quoted = !quoted;
    else if (!quoted && line[i] == '/' && line[i + 1] == '/') return line.substr(i);
  }
  return "";
}

}  // namespace tack
