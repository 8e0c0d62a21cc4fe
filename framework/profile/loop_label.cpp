#include "framework/profile/loop_label.hpp"

#include <fmt/format.h>

#include <cctype>
#include <filesystem>
#include <string_view>
#include <vector>

namespace tack {
namespace {

void remove_all(std::string& text, std::string_view word) {
  for (size_t at; (at = text.find(word)) != std::string::npos;) text.erase(at, word.size());
}

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Replaces whole words.
void replace_word(std::string& text, std::string_view word, std::string_view by) {
  for (size_t at = 0; (at = text.find(word, at)) != std::string::npos;) {
    const size_t end = at + word.size();
    const bool whole = (at == 0 || !in_word(text[at - 1])) && (end == text.size() || !in_word(text[end]));
    if (whole) text.replace(at, word.size(), by);
    at += whole ? by.size() : word.size();
  }
}

// Calls found(position) for each character outside <>, () and [], until found returns true.
template <class Found>
void scan(std::string_view text, const Found& found) {
  int depth = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool arrow = text[i] == '>' && i > 0 && text[i - 1] == '-';
    if (depth == 0 && found(i)) return;
    if (text[i] == '<' || text[i] == '(' || text[i] == '[') ++depth;
    if ((text[i] == '>' && !arrow) || text[i] == ')' || text[i] == ']') --depth;
  }
}

// Returns the qualified name of a function without template parameters in brackets.
std::string qualified_name(std::string_view signature) {
  size_t end = signature.size(), begin = 0;
  scan(signature, [&](size_t i) { return signature[i] == '(' ? (end = i, true) : false; });
  scan(signature.substr(0, end), [&](size_t i) {
    if (signature[i] == ' ') begin = i + 1;
    return false;
  });
  while (begin < end && (signature[begin] == '*' || signature[begin] == '&')) ++begin;
  return std::string(signature.substr(begin, end - begin));
}

// Replaces long lists of template arguments by dots.
std::string with_short_arguments(const std::string& name) {
  constexpr int length_max = 40;
  std::string text;
  int depth = 0;
  size_t begin = 0;  // of the outermost list, in `text`
  for (const char c : name) {
    if (c == '<' && depth++ == 0) begin = text.size();
    text += c;
    if (c == '>' && depth > 0 && --depth == 0 && text.size() - begin > length_max) text.replace(begin, std::string::npos, "<...>");
  }
  return text;
}

struct Parameter {
  std::string name, value;
};

// Reads "A = x; B = y".
std::vector<Parameter> parameters(std::string_view list) {
  std::vector<Parameter> all;
  size_t begin = 0;
  const auto take = [&](size_t end) {
    const std::string_view one = list.substr(begin, end - begin);
    if (const size_t equals = one.find(" = "); equals != std::string_view::npos)
      all.push_back({std::string(one.substr(0, equals)), std::string(one.substr(equals + 3))});
    begin = end + 2;
  };
  scan(list, [&](size_t i) {
    if (list[i] == ';') take(i);
    return false;
  });
  if (begin < list.size()) take(list.size());
  return all;
}

}  // namespace

std::string function_label(std::string signature) {
  for (const char* word : {"(anonymous namespace)::", "{anonymous}::", "tack::"}) remove_all(signature, word);
  std::string list;
  if (const size_t with = signature.rfind(" [with "); with != std::string::npos && signature.ends_with(']')) {
    list = signature.substr(with + 7, signature.size() - with - 8);
    signature.erase(with);
  }
  std::string label = qualified_name(signature), made_by;
  for (const Parameter& parameter : parameters(list)) {
    if (parameter.value.find("<lambda") != std::string::npos) made_by = qualified_name(parameter.value);
    else replace_word(label, parameter.name, parameter.value);
  }
  label = with_short_arguments(label);
  return made_by.empty() || made_by == label ? label : label + " of " + with_short_arguments(made_by);
}

std::string loop_label(const SourcePosition& loop) {
  return fmt::format("{}, {}:{}", function_label(loop.function_name()),
                     std::filesystem::path(loop.file_name()).filename().string(), loop.line());
}

}  // namespace tack
