#include "framework/config/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

bool is_vowel(char c) { return std::string_view("aeiou").find(c) != std::string_view::npos; }

}  // namespace

std::string with_article(std::string_view noun) {
  const bool vowel = !noun.empty() && is_vowel(noun.front());
  return (vowel ? "an " : "a ") + std::string(noun);
}

std::string plural(std::string_view noun) {
  const std::size_t head = std::min(noun.find(" of "), noun.find(" per "));
  if (head != std::string_view::npos) {
    return plural(noun.substr(0, head)) + std::string(noun.substr(head));
  }
  const auto size = noun.size();
  if (size > 1 && noun.back() == 'y' && !is_vowel(noun[size - 2])) {
    return std::string(noun.substr(0, size - 1)) + "ies";
  }
  const bool hissing =
      noun.ends_with('s') || noun.ends_with('x') || noun.ends_with("sh") || noun.ends_with("ch");
  return std::string(noun) + (hissing ? "es" : "s");
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

std::string counted(long count, std::string_view noun) { return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s"); }

std::string duration_text(double seconds) {
  const long s = std::lround(seconds);
  if (s >= 3600) return fmt::format("{}h{:02}m", s / 3600, s / 60 % 60);
  if (s >= 60) return fmt::format("{}m{:02}s", s / 60, s % 60);
  return fmt::format("{}s", s);
}

}  // namespace tack
