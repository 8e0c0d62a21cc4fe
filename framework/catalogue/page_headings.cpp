#include "framework/catalogue/page_headings.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>

namespace tack {

namespace fs = std::filesystem;

std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ') anchor += '-';
    else if (c == '-' || c == '_' || byte > 127 || std::isalnum(byte)) anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

std::vector<PageHeading> page_headings(const fs::path& folder) {
  std::vector<PageHeading> headings;
  std::error_code none;
  if (!fs::is_directory(folder, none)) return headings;
  std::vector<fs::path> pages;
  for (auto entry = fs::recursive_directory_iterator(folder); entry != fs::recursive_directory_iterator(); ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name == "log" || name == "reference")) entry.disable_recursion_pending();
    if (entry->path().extension() == ".md") pages.push_back(fs::relative(entry->path(), folder));
  }
  std::sort(pages.begin(), pages.end());
  for (const fs::path& page : pages) {
    std::ifstream in(folder / page);
    bool code = false;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with("```")) code = !code;
      const size_t text = line.find_first_not_of('#');
      if (code || text == 0 || text == line.npos || line[text] != ' ') continue;
      const std::string heading = line.substr(text + 1);
      headings.push_back({"docs/" + page.generic_string() + (text == 1 ? "" : "#" + anchor_of(heading)), heading});
    }
  }
  return headings;
}

}  // namespace tack
