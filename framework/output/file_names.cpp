#include "framework/output/file_names.hpp"

#include <fmt/format.h>

#include <cctype>
#include <string_view>

namespace tack {

std::string file_name(std::string text) {
  const auto kept = [](unsigned char c) { return c >= 0x80 || std::isalnum(c) || std::string_view("-_.").find(static_cast<char>(c)) != std::string_view::npos; };
  for (char& c : text)
    if (!kept(static_cast<unsigned char>(c))) c = '_';
  if (text.starts_with('.')) text.front() = '_';
  return text;
}

const std::string& FileNames::of(const std::string& text) {
  const auto [entry, is_new] = names_.try_emplace(text);
  if (!is_new) return entry->second;
  const std::string name = file_name(text);
  std::string tried = name;
  for (int number = 2; !taken_.insert(tried).second; ++number) tried = fmt::format("{}{}{}", name, before_number_, number);
  return entry->second = tried;
}

}  // namespace tack
