#include "framework/config/words.hpp"

#include <algorithm>

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

}  // namespace tack
