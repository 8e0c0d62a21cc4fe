#include "energies/interactions/nearest_ends.hpp"

#include <algorithm>

#include "geometry/errors.hpp"

namespace tack {

std::vector<Edge> nearest_ends(const std::vector<int>& from, const std::vector<int>& to, const VecX& rest, const std::string& who) {
  std::vector<Edge> pairs;
  for (const int v : from) {
    const int nearest = *std::min_element(to.begin(), to.end(), [&](int a, int b) { return length_of({v, a}, rest) < length_of({v, b}, rest); });
    if (nearest == v) throw InputError(who + " would tie a vertex to itself; choose other ends");
    pairs.push_back({v, nearest});
  }
  return pairs;
}

}  // namespace tack
