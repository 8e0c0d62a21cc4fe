#include "energies/rod/rod_pairs.hpp"

#include <map>

namespace tack {

std::vector<RodPair> rod_pairs(const std::vector<Edge>& edges, const VecX& rest) {
  std::map<int, std::vector<int>> around;
  std::vector<double> lengths;
  for (size_t e = 0; e < edges.size(); ++e) {
    for (const int v : edges[e]) around[v].push_back(static_cast<int>(e));
    lengths.push_back((vertex(rest, edges[e][1]) - vertex(rest, edges[e][0])).norm());
  }
  std::vector<RodPair> pairs;
  for (const auto& [v, at] : around) {
    double sum = 0;
    for (const int e : at) sum += 1 / lengths[e];
    for (size_t i = 0; i < at.size(); ++i)
      for (size_t j = i + 1; j < at.size(); ++j)
        pairs.push_back({at[i], at[j], v, lengths[at[i]] * lengths[at[j]] / 2 * sum, at.size() > 2});
  }
  return pairs;
}

}  // namespace tack
