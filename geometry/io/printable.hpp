// Text of files in messages, without control characters for the terminal.
#pragma once

#include <string>
#include <string_view>

namespace tack {

inline std::string printable(std::string_view text, std::size_t most = 20) {
  std::string clean(text.substr(0, most));
  for (char& c : clean) c = (c >= ' ' && c <= '~') ? c : '?';
  return clean;
}

}  // namespace tack
