// Words that docs/glossary.md has retired do not come back in identifiers, comments or pages.
#include <catch2/catch.hpp>

#include <cctype>
#include <map>

#include "tests/structure/source_texts.hpp"

using namespace tack;

namespace {

struct RetiredWord {
  std::string text;                // as the table has it
  std::vector<std::string> words;  // lower case; of an identifier: itself
  bool identifier;                 // matches whole identifiers alone
  bool pages;                      // retired on pages too
};

bool alphanumeric(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// Splits a text at all other characters; `underscores` belong to words or not.
std::vector<std::string> words_of(const std::string& text, bool underscores) {
  std::vector<std::string> words;
  std::string word;
  for (size_t i = 0; i <= text.size(); ++i) {
    const char c = i < text.size() ? text[i] : ' ';
    if (alphanumeric(c) || (underscores && c == '_')) word += c;
    else if (!word.empty()) words.push_back(std::exchange(word, ""));
  }
  return words;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// Returns the cells of a row of a table in Markdown.
std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  for (size_t begin = row.find('|'); begin != std::string::npos;) {
    const size_t end = row.find('|', begin + 1);
    if (end == std::string::npos) break;
    cells.push_back(row.substr(begin + 1, end - begin - 1));
    begin = end;
  }
  return cells;
}

// Returns the rows of the table below "## Retired words" of a glossary. Retired words stand in
// backticks in the first column; the last one is `code` or `everywhere`.
std::vector<RetiredWord> retired_words(const std::string& glossary) {
  std::vector<RetiredWord> retired;
  const size_t begin = glossary.find("\n## Retired words\n");
  if (begin == std::string::npos) return retired;
  for (const std::string& row :
       lines_of(glossary.substr(begin + 1, glossary.find("\n## ", begin + 1) - begin - 1))) {
    const std::vector<std::string> cells = cells_of(row);
    if (cells.size() != 3) continue;
    for (size_t open = cells[0].find('`'); open != std::string::npos;) {
      const size_t close = cells[0].find('`', open + 1);
      const std::string text = cells[0].substr(open + 1, close - open - 1);
      const bool identifier = text != lower(text) || contains(text, "_");
      retired.push_back({text, identifier ? std::vector{text} : words_of(text, false), identifier,
                         contains(cells[2], "everywhere")});
      open = cells[0].find('`', close + 1);
    }
  }
  return retired;
}

// Returns the retired words that a text has.
std::vector<std::string> found_in(const std::string& text, const std::vector<RetiredWord>& retired,
                                  bool page) {
  std::multimap<std::string, const RetiredWord*> phrases, identifiers;
  for (const RetiredWord& word : retired)
    if (!page || word.pages)
      (word.identifier ? identifiers : phrases).emplace(word.words.front(), &word);
  std::vector<std::string> found;
  for (std::string name : words_of(text, true)) {
    while (name.size() > 1 && name.back() == '_') name.pop_back();
    for (auto [i, end] = identifiers.equal_range(name); i != end; ++i)
      found.push_back(i->second->text);
  }
  std::vector<std::string> words = words_of(text, false);
  for (std::string& word : words) word = lower(word);
  for (size_t at = 0; at < words.size(); ++at)
    for (auto [i, end] = phrases.equal_range(words[at]); i != end; ++i) {
      const std::vector<std::string>& phrase = i->second->words;
      if (at + phrase.size() <= words.size() &&
          std::equal(phrase.begin(), phrase.end(), words.begin() + static_cast<long>(at)))
        found.push_back(i->second->text);
    }
  return found;
}

}  // namespace

TEST_CASE("retired words are found in identifiers, comments and pages", "[structure]") {
  const std::vector<RetiredWord> retired = retired_words(
      "# Glossary\n\n## Retired words\n\n| retired | name | where |\n| --- | --- | --- |\n"
      "| `kin`, `safe box` | rigid group | everywhere |\n| `old_name`, `OldName` | new | code |\n\n"
      "## Next\n\n| `no` | a | code |\n");
  REQUIRE(retired.size() == 4);
  CHECK(found_in("int but_kin = 0;  // Kin", retired, false) ==
        std::vector<std::string>{"kin", "kin"});
  CHECK(found_in("std::vector<Aabb> safe_box_;", retired, false) ==
        std::vector<std::string>{"safe box"});
  CHECK(found_in("skin, kind, safe boxes", retired, true).empty());
  CHECK(found_in("old_name_ = OldName()", retired, false).size() == 2);
  CHECK(found_in("old.name, old name, OldNames, old_names", retired, false).empty());
  CHECK(found_in("OldName", retired, true).empty());
  CHECK(found_in("no", retired, false).empty());
}

TEST_CASE("no retired word comes back", "[structure]") {
  const std::string glossary = file_text(std::filesystem::path(TACK_SOURCE_DIR) / "docs/glossary.md");
  const std::vector<RetiredWord> retired = retired_words(glossary);
  REQUIRE(retired.size() > 30);
  int files = 0;
  for (const SourceText& source : source_texts()) {
    if (source.path == "docs/glossary.md" || source.path == "tests/structure/vocabulary_test.cpp")
      continue;
    ++files;
    int number = 0;
    for (const std::string& line : lines_of(source.text)) {
      ++number;
      for (const std::string& word : found_in(line, retired, !source.code())) {
        INFO(source.path << ":" << number << ": `" << word
                         << "` is retired; docs/glossary.md has the name\n" << line);
        CHECK(false);
      }
    }
  }
  CHECK(files > 1000);
}
