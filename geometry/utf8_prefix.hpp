// Beginnings of UTF-8 texts that end between characters.
#pragma once

#include <cstddef>
#include <string_view>

namespace tack {

// Returns the beginning of a text, at most `bytes` long, without a part of a character at its end.
inline std::string_view utf8_prefix(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
  while (bytes > 0 && continues(text[bytes])) --bytes;
  return text.substr(0, bytes);
}

}  // namespace tack
