#include "framework/config/short_key.hpp"

#include <algorithm>

namespace tack {

std::string short_key(const std::string& key, const std::vector<std::string>& keys) {
  for (size_t dot = key.rfind('.'); dot != key.npos && dot > 0; dot = key.rfind('.', dot - 1)) {
    const std::string tail = key.substr(dot);
    const auto same = [&](const std::string& other) { return other.ends_with(tail) || "." + other == tail; };
    if (std::count_if(keys.begin(), keys.end(), same) == 1) return tail.substr(1);
  }
  return key;
}

}  // namespace tack
