#include "framework/config/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tack {

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size() + 1;
  std::vector<int> d((a.size() + 1) * n);  // d[i * n + j]: first i of a against first j of b
  for (std::size_t i = 0; i <= a.size(); ++i) d[i * n] = static_cast<int>(i);
  for (std::size_t j = 0; j < n; ++j) d[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j < n; ++j) {
      const int replace = d[(i - 1) * n + j - 1] + (a[i - 1] != b[j - 1]);
      int best = std::min({d[(i - 1) * n + j] + 1, d[i * n + j - 1] + 1, replace});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) best = std::min(best, d[(i - 2) * n + j - 2] + 1);
      d[i * n + j] = best;
    }
  }
  return d.back();
}

std::string nearest(std::string_view word, const std::vector<std::string>& names) {
  int best = std::max(2, static_cast<int>(word.size()) / 2);  // further away is a different word
  std::string found;
  for (const std::string& name : names) {
    const int distance = edit_distance(word, name);
    const bool nothing_shared = distance >= static_cast<int>(std::max(word.size(), name.size()));
    if (distance > best || nothing_shared || (distance == best && !found.empty())) continue;
    best = distance;
    found = name;
  }
  for (const std::string& name : names) {
    if (found.empty() && word.size() > 2 && name.find(word) != name.npos) found = name;
  }
  return found;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& names,
                       std::string_view label) {
  const std::string near = nearest(word, names);
  const std::string hint = near.empty() ? "" : fmt::format("did you mean '{}'? ", near);
  if (names.empty()) return fmt::format("; there are no {}", label);
  return fmt::format("; {}({}: {})", hint, label, fmt::join(names, ", "));
}

}  // namespace tack
